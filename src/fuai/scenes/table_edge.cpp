// A sheet that lies on a table, pinned, and falls over its edge.
// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {
namespace {

constexpr double kOnTable = 0.4;  // part of the sheet

}  // namespace

EngineScene make_table_edge(const FabricLaws& laws, const SceneOptions& options) {
  const SceneOptions o = fill_scene_options(options, 33);
  const double side = (o.size - 1) * o.spacing, table = kOnTable * side;
  ClothPieceSpec spec = make_sheet_spec(laws, o.size, o.size, o.spacing);
  spec.clamps.push_back({HalfPlaneRegion{Vec2::UnitY(), table}, true});
  EngineScene scene = make_sheet_scene("table_edge", laws, spec);
  scene.seconds = 3.0;
  scene.view.azimuth = 55.0 * std::numbers::pi / 180.0;
  scene.view.elevation = 22.0 * std::numbers::pi / 180.0;
  scene.view.low = Vec3(0.0, 0.2 * side, -0.6 * side);
  scene.view.high = Vec3(side, 0.7 * side, 0.0);
  scene.view.blocks.push_back(
      {Vec3(-0.1 * side, -0.1 * side, -0.8 * side), Vec3(1.1 * side, table, -0.0015)});
  return scene;
}

}  // namespace fuai
