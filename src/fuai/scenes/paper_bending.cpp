// Builds and runs the paper's bending experiment.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/scenes/paper_bending.h"

#include <algorithm>
#include <cmath>

#include "fuai/core/assertion.h"
#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Columns that are clamped: two of them hold position and slope.
constexpr int kClampedColumns = 2;

/// Where the grip lies when the free length is an arc [m].
Vec3 arc_point(const PaperBending& scene, double curvature) {
  const LatticeModel& model = *scene.model;
  const Vec3& rest = model.rest_positions[static_cast<std::size_t>(scene.grip)];
  const double start = (kClampedColumns - 1) * model.spacing;
  return Vec3(start, rest.y(), 0.0) + paper_arc_point(rest.x() - start, curvature);
}

/// The weft triple with this middle node: index into the model's triples.
std::size_t weft_triple(const LatticeModel& model, int middle) {
  const auto found = std::find_if(model.triples.begin(), model.triples.end(), [&](const LatticeTriple& t) {
    return t.direction == Direction::kWeft && t.middle == middle;
  });
  FUAI_ASSERT(found != model.triples.end());
  return static_cast<std::size_t>(found - model.triples.begin());
}

}  // namespace

Vec3 paper_arc_point(double length, double curvature) {
  const double angle = curvature * length;
  // sin(a)/a and (1 - cos a)/a without loss at a = 0
  const double half = 0.5 * angle;
  const double sinc = angle != 0.0 ? std::sin(angle) / angle : 1.0;
  const double versine = angle != 0.0 ? std::sin(half) * std::sin(half) / half : 0.0;
  return {length * sinc, 0.0, length * versine};
}

PaperBending make_paper_bending(const FabricLaws& laws, const PaperBendingOptions& options) {
  LatticeSpec spec;
  spec.spacing = options.spacing;
  spec.columns = lattice_nodes_on_side(options.length, options.spacing, "length");
  spec.rows = lattice_nodes_on_side(options.width, options.spacing, "width");
  spec.areal_mass = laws.areal_mass;
  if (spec.rows % 2 == 0 || spec.columns < kClampedColumns + 2) {
    throw Error(ErrorKind::kUsage, "the strip needs a middle thread and at least four columns", {},
                "give a width that is an even multiple of the spacing");
  }
  if (!(options.largest_move > 0.0) || options.steps_per_move < 1) {
    throw Error(ErrorKind::kUsage, "the grip needs a positive largest move and steps after it",
                {"", 0, 0, "largest_move"});
  }
  PaperBending scene;
  scene.grip = spec.rows / 2 * spec.columns + spec.columns - 1;
  for (int row = 0; row < spec.rows; ++row) {
    for (int column = 0; column < kClampedColumns; ++column) {
      spec.fixed_nodes.push_back(row * spec.columns + column);
    }
  }
  spec.fixed_nodes.push_back(scene.grip);
  scene.options = options;
  scene.model = std::make_unique<const LatticeModel>(make_lattice_model(spec));
  scene.laws = std::make_unique<const FabricLaws>(laws);
  scene.state = make_lattice_state(*scene.model);
  scene.solver.prepare(*scene.model, *scene.laws, options.relaxation);
  return scene;
}

void impose_cylinder(PaperBending& scene, double curvature) {
  const LatticeModel& model = *scene.model;
  const double h = model.spacing, turn = 2.0 * std::asin(0.5 * curvature * h);  // K = (2/h) sin(turn/2)
  scene.state = make_lattice_state(model);
  for (int row = 0; row < model.rows; ++row) {
    Vec3 here(0.0, row * h, 0.0);
    for (int column = 0; column < model.columns; ++column) {
      scene.state.positions[static_cast<std::size_t>(model.node(column, row))] = here;
      const double heading = (column + 0.5) * turn;
      here += h * Vec3(std::cos(heading), 0.0, std::sin(heading));
    }
  }
  for (std::size_t t = 0; t < model.triples.size(); ++t) {
    if (model.triples[t].direction != Direction::kWeft) continue;
    scene.laws->bending[static_cast<std::size_t>(Direction::kWeft)].commit(curvature, scene.state.memory[t]);
  }
  scene.arc_curvature = curvature;
}

PaperBendingStage bend_to(PaperBending& scene, double curvature, const Progress& progress) {
  const LatticeModel& model = *scene.model;
  const PaperBendingOptions& options = scene.options;
  Vec3& grip = scene.state.positions[static_cast<std::size_t>(scene.grip)];
  const double from = scene.arc_curvature;
  const double way = (arc_point(scene, curvature) - arc_point(scene, from)).norm();
  const int moves = std::max(1, static_cast<int>(std::ceil(way / options.largest_move)));
  RelaxationStop follow = options.stop;
  follow.max_steps = options.steps_per_move;
  for (int move = 1; move <= moves; ++move) {
    grip = arc_point(scene, from + (curvature - from) * move / moves);
    if (move < moves) scene.solver.run(scene.state, follow);
  }
  PaperBendingStage stage;
  stage.relaxation = scene.solver.run(scene.state, options.stop, progress);
  scene.arc_curvature = curvature;

  stage.arc_curvature = curvature;
  const PlayLaw& law = scene.laws->bending[static_cast<std::size_t>(Direction::kWeft)];
  stage.arc_moment = law.elastic().evaluate(curvature).value + law.friction().evaluate(curvature).value;
  const int middle_row = model.rows / 2;
  const TripleReading at_grip =
      scene.solver.read_triple(scene.state, weft_triple(model, model.node(model.columns - 2, middle_row)));
  stage.grip_curvature = at_grip.curvature;
  stage.grip_moment = at_grip.moment;
  stage.mid_curvature =
      scene.solver.read_triple(scene.state, weft_triple(model, model.node(model.columns / 2, middle_row)))
          .curvature;
  stage.force = evaluate_grasp(scene.solver, scene.state, scene.grip);
  stage.positions = scene.state.positions;
  return stage;
}

std::vector<PaperBendingStage> run_paper_bending(const FabricLaws& laws, std::span<const double> curvatures,
                                                 const PaperBendingOptions& options,
                                                 const Progress& progress) {
  PaperBending scene = make_paper_bending(laws, options);
  std::vector<PaperBendingStage> stages;
  for (double curvature : curvatures) {
    stages.push_back(bend_to(scene, curvature));
    if (progress) {
      progress("bending", static_cast<double>(stages.size()) / static_cast<double>(curvatures.size()));
    }
  }
  return stages;
}

}  // namespace fuai
