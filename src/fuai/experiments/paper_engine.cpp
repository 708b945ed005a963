// Runs the paper's drape and strip on the cloth engine.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/paper_engine.h"

#include <algorithm>
#include <cmath>

#include "fuai/cloth/cloth_piece.h"
#include "fuai/experiments/paper_context.h"
#include "fuai/io/fabric_library.h"
#include "fuai/scenes/paper_bending.h"
#include "fuai/scenes/paper_drape.h"
#include "fuai/sim/simulation.h"
#include "fuai/solver/cloth_energy.h"

namespace fuai {
namespace {

/// The strip has no weight to measure its rest by; its reaction is 1e-5 N to 1e-2 N.
constexpr double kStripRest = 2e-7;  // [N]
/// Drapes take some 200 to 700 steps.
constexpr int kDrapeSteps = 1500;
/// The grip moves at most this far [m] before the strip follows.
constexpr double kLargestMove = 0.002;

ClothMaterial material_of(const FabricLaws& laws) {
  ClothMaterial material = make_cloth_material(laws);
  // At rest only the laws count.
  material.mass_drag = material.air_normal = material.air_tangential = material.viscosity_time = 0.0;
  return material;
}

/// Sheet and block of the paper at a spacing.
ClothModel drape_model(double areal_mass, double spacing) {
  const PaperDrapeOptions paper;
  ClothPieceSpec spec;
  spec.outline = make_rectangle_outline(paper.edge, paper.edge);
  spec.spacing = spacing;
  spec.areal_mass = areal_mass;
  const double block = paper.fixed_edge;
  spec.clamps.push_back({make_rectangle_region(Vec2(-paper.edge, -paper.edge), Vec2(block, block)), true});
  return make_cloth_model(spec);
}

double mobile_weight(const ClothModel& model) {
  double area = 0.0;
  for (std::size_t i = 0; i < model.node_area.size(); ++i)
    area += model.fixed[i] != 0 ? 0.0 : model.node_area[i];
  return area * model.areal_mass * kStandardGravity;
}

}  // namespace

EngineDrape drape_on_engine(const std::string& fabric_id, double spacing, const Progress& progress) {
  const Fabric fabric = load_fabric(fabric_id);
  const FabricLaws laws = make_fabric_laws(fabric);
  EngineDrape drape;
  drape.id = fabric_id;
  drape.name = fabric.name;
  drape.spacing = spacing;
  drape.model = drape_model(laws.areal_mass, spacing);
  drape.state = make_cloth_state(drape.model);
  const ClothMaterial material = material_of(laws);
  EquilibriumOptions options;
  options.most_steps = kDrapeSteps;
  // Whole steps leap between the shapes that a drape can rest in, and rounding decides in which they end, if
  // in any; a search along each step stays in the valley it started down.
  options.guards = true;
  std::vector<ClothModel> levels;
  if (const double coarse = PaperDrapeOptions{}.spacing; spacing < coarse)
    levels.push_back(drape_model(laws.areal_mass, coarse));
  levels.push_back(drape.model);
  const Stopwatch watch;
  drape.report = find_equilibrium_nested(levels, material, drape.state, options, progress);
  drape.seconds = watch.seconds();
  const ClothModel& model = drape.model;
  const auto height = [&](int column, int row) {
    return drape.state.positions[static_cast<std::size_t>(model.slot(column, row))].z();
  };
  drape.corner_z = height(model.columns - 1, model.rows - 1);
  drape.side_z = height(model.columns - 1, 0);
  drape.max_strain = max_edge_strain(model, drape.state);
  const double node_weight = model.areal_mass * spacing * spacing * kStandardGravity;
  drape.residual = drape.report.residual * mobile_weight(model) / node_weight;
  return drape;
}

EngineStrip bend_on_engine(const std::string& fabric_id, double spacing, std::span<const double> curvatures,
                           const Progress& progress) {
  const PaperBendingOptions paper;
  const Fabric fabric = load_fabric(fabric_id);
  const FabricLaws laws = make_fabric_laws(fabric);
  const double held = paper.spacing;  // two of the paper's columns
  ClothPieceSpec spec;
  spec.outline = make_rectangle_outline(paper.length, paper.width);
  spec.spacing = spacing;
  spec.areal_mass = laws.areal_mass;
  spec.clamps.push_back({HalfPlaneRegion{Vec2::UnitX(), held}, true});
  spec.pins.emplace_back(paper.length, 0.5 * paper.width);
  EngineStrip strip;
  strip.id = fabric_id;
  strip.name = fabric.name;
  strip.spacing = spacing;
  strip.model = make_cloth_model(spec);
  strip.grip = strip.model.slot(strip.model.columns - 1, strip.model.rows / 2);
  const auto grip = static_cast<std::size_t>(strip.grip);
  const ClothMaterial material = material_of(laws);
  ClothState state = make_cloth_state(strip.model);
  EquilibriumOptions options;
  options.gravity = Vec3::Zero();
  options.least_force = kStripRest;
  const auto arc_point = [&](double curvature) -> Vec3 {
    return Vec3(held, 0.5 * paper.width, 0.0) + paper_arc_point(paper.length - held, curvature);
  };
  const Stopwatch watch;
  double from = 0.0;
  for (double curvature : curvatures) {
    const double way = (arc_point(curvature) - arc_point(from)).norm();
    const int moves = std::max(1, static_cast<int>(std::ceil(way / kLargestMove)));
    EngineBendingStage stage;
    for (int move = 1; move <= moves; ++move) {
      state.positions[grip] = arc_point(from + (curvature - from) * move / moves);
      const EquilibriumReport report = find_equilibrium(strip.model, material, state, options);
      stage.report.steps += report.steps;
      stage.report.iterations += report.iterations;
      stage.report.residual = report.residual;
      stage.report.converged = report.converged;
    }
    from = curvature;
    std::vector<Vec3> forces(state.positions.size());
    evaluate_cloth(strip.model, material, state, state.positions, {}, forces);
    stage.arc_curvature = curvature;
    stage.reaction = forces[grip];
    stage.max_strain = max_edge_strain(strip.model, state);
    stage.positions = state.positions;
    strip.stages.push_back(std::move(stage));
    if (progress)
      progress("", static_cast<double>(strip.stages.size()) / static_cast<double>(curvatures.size()));
  }
  strip.seconds = watch.seconds();
  return strip;
}

}  // namespace fuai
