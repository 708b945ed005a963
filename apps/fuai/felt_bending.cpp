// Bends the paper's cloth with a simulated hand.
// SPDX-License-Identifier: Apache-2.0
#include "felt_bending.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "felt_setup.h"
#include "fuai/cloth/cloth_piece.h"
#include "fuai/core/smooth_rise.h"
#include "fuai/device/device_simulated.h"
#include "fuai/haptics/cloth_hand.h"
#include "fuai/haptics/virtual_session.h"
#include "fuai/io/fabric_library.h"
#include "fuai/scenes/paper_bending.h"
#include "fuai/sim/felt_options.h"
#include "fuai/units/constants.h"

namespace fuai_app {

using namespace fuai;

namespace {

/// The hand rests while the force ramps up, goes out slowly, so that it feels the cloth and not its inertia,
/// and comes back [s].
constexpr double kRest = 0.6, kOut = 4.0;
/// Of the arc, at the turn [1/m]: 0.18 /cm, as far as Figures 7 and 8 reach less a tenth.
constexpr double kTurn = 18.0;
constexpr int kMean = 100;  ///< ticks of a moment: device friction and encoder steps shake light cloth
/// Curvatures of the shapes [1/m].
constexpr double kShapes[] = {4.0, 9.0, 14.0, 17.5};

/// The strip of section 4.2, between its clamp and the hand.
struct Strip {
  PaperBendingOptions paper;
  double held = paper.spacing;  ///< the clamp's edge: the second column
  double free_length() const { return paper.length - held; }
  Vec3 place(double curvature) const { return paper_arc_point(free_length(), curvature); }
  /// Along the way of the hand, from flat.
  Vec3 onward(double curvature) const {
    const double d = 0.01;  // [1/m]; the way is smooth
    return (place(curvature + d) - place(curvature - d)).normalized();
  }
  /// Of the arc that ends in a place: its chord has half of its angle.
  double curvature_at(const Vec3& tool) const {
    return 2.0 * std::atan2(tool.z(), tool.x() - held) / free_length();
  }
};

ClothModel make_model(const FabricLaws& laws, const Strip& strip) {
  ClothPieceSpec spec;
  spec.outline = make_rectangle_outline(strip.paper.length, strip.paper.width);
  spec.spacing = strip.paper.spacing;
  spec.areal_mass = laws.areal_mass;
  spec.clamps.push_back({HalfPlaneRegion{Vec2::UnitX(), strip.held}, true});
  return make_cloth_model(spec);
}

ClothHand make_hand(const ClothModel& model, const FabricLaws& laws, const Strip& strip,
                    const DeviceInfo& device) {
  ImplicitOptions options;
  options.gravity = Vec3::Zero();
  GraspSpec grasp;  // one particle, as the paper holds it
  grasp.centre = Vec2(strip.paper.length, 0.5 * strip.paper.width);
  grasp.radius = 0.0;
  grasp.stiffness = std::min(grasp.stiffness, device.stable_stiffness);
  return {model, make_cloth_material(laws),
          ClothSolverOptions{SolverKind::kImplicit, make_felt_options(options), 0}, make_cloth_state(model),
          grasp};
}

/// From flat to the turn and back, against where the hand begins.
std::vector<Vec3> hand_way(const Strip& strip) {
  std::vector<Vec3> way;
  for (double t = 0.0; t <= kRest + 2.0 * kOut; t += kTick) {
    const double out = smooth_rise(t, kRest, kRest + kOut) - smooth_rise(t, kRest + kOut, kRest + 2.0 * kOut);
    way.push_back(strip.place(kTurn * out) - strip.place(0.0));
  }
  return way;
}

/// Eq. (7) as printed, on the shape that the engine's cloth has.
class PaperForce {
 public:
  PaperForce(const FabricLaws& laws, const Strip& strip) : scene_(make(laws, strip)) {}
  Vec3 bend(const ClothSimulation& cloth) {
    std::vector<Vec3>& positions = scene_.state.positions;
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = cloth.position(static_cast<int>(i));
    return evaluate_grasp(scene_.solver, scene_.state, scene_.grip).printed_bending;
  }

 private:
  static PaperBending make(const FabricLaws& laws, const Strip& strip) {
    PaperBendingOptions options = strip.paper;
    options.relaxation.mode = PaperMode::kAsPrinted;
    return make_paper_bending(laws, options);
  }
  PaperBending scene_;
};

BendingShape shape_of(const ClothHand& cloth, const BendingMoment& moment) {
  BendingShape shape;
  const ClothModel& model = cloth.simulation().model();
  for (int column = 0; column < model.columns; ++column)
    shape.yarn.push_back(cloth.simulation().position(model.slot(column, model.rows / 2)));
  shape.moment = moment;
  return shape;
}

/// Adds a share of a tick to a moment.
void add(BendingMoment& moment, const Strip& strip, const ClothHand& cloth, const VirtualSession& session,
         const Vec3& paper) {
  constexpr double share = 1.0 / kMean;
  const TickRecord& record = session.records().back();
  moment.time += share * (record.time - kRest);
  moment.tool += share * record.tool;
  moment.curvature += share * strip.curvature_at(record.tool);
  moment.reaction += share * cloth.reading(0).force;
  moment.felt += share * record.tick.force;
  moment.paper_bend += share * paper;
}

}  // namespace

FeltBending bend_in_hand(const std::string& fabric_name) {
  const Strip strip;
  const Fabric fabric = load_fabric(fabric_name);
  const FabricLaws laws = make_fabric_laws(fabric);
  SimulatedDeviceSpec spec = find_device_preset("premium");
  spec.info.rate = 1.0 / kTick;
  const ClothModel model = make_model(laws, strip);
  ClothHand cloth = make_hand(model, laws, strip, spec.info);
  const std::vector<Vec3> way = hand_way(strip);
  SimulatedDevice device(spec, find_hand_model("stylus"), make_path_motion(way, kTick));
  ForcePathOptions options = make_force_path_options(spec.info);
  options.map.cloth_centre = cloth.patch();
  ForcePath path(options);
  VirtualSession session(device, path, cloth, {0.0, 0.0, way.size()});
  PaperForce paper(laws, strip);
  FeltBending run;
  run.id = fabric.id;
  run.name = fabric.name;
  run.weft_rigidity = fabric.bending[static_cast<std::size_t>(Direction::kWeft)].B.value;
  std::size_t shape = 0;
  for (std::size_t i = 0; i + kMean <= way.size(); i += kMean) {
    BendingMoment moment;
    for (int k = 0; k < kMean; ++k) {
      session.tick(kTick);
      add(moment, strip, cloth, session, paper.bend(cloth.simulation()));
    }
    const Vec3 onward = strip.onward(moment.curvature);
    moment.pushes = -onward.dot(moment.reaction);
    moment.paper_pushes = -onward.dot(moment.paper_bend);
    if (moment.time < 0.0) continue;
    run.moments.push_back(moment);
    if (shape < std::size(kShapes) && moment.curvature >= kShapes[shape]) {
      run.shapes.push_back(shape_of(cloth, moment));
      ++shape;
    }
  }
  return run;
}

double FeltBending::top() const {
  double most = 0.0;
  for (const BendingMoment& moment : moments) most = std::max(most, moment.curvature);
  return most;
}

double FeltBending::push_at(double curvature, bool back, bool paper) const {
  const auto turn = std::max_element(
      moments.begin(), moments.end(),
      [](const BendingMoment& a, const BendingMoment& b) { return a.curvature < b.curvature; });
  const auto begin = back ? turn : moments.begin(), end = back ? moments.end() : turn;
  double least = std::numeric_limits<double>::infinity(), push = 0.0;
  for (auto moment = begin; moment != end; ++moment) {
    const double off = std::abs(moment->curvature - curvature);
    if (off >= least) continue;
    least = off;
    push = paper ? moment->paper_pushes : moment->pushes;
  }
  return push;
}

}  // namespace fuai_app
