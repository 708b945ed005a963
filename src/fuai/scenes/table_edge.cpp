// A sheet that lies on a table, pinned, and falls over its edge.
// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {
namespace {

constexpr double kOnTable = 0.4;  // part of the sheet

/// A board on two side walls, open below: the cloth meets nothing but its pins, and swings through under the
/// edge.
/// @param front y of the edge [m]
void add_table(SceneView& view, double side, double front) {
  const double left = -0.1 * side, right = 1.1 * side, back = -0.1 * side, floor = -0.8 * side;
  const double board = 0.03 * side, wall = 0.035 * side;
  const double top = -0.0015;  // [m] so that the cloth is seen
  view.blocks.push_back({Vec3(left, back, top - board), Vec3(right, front, top)});
  view.blocks.push_back({Vec3(left, back, floor), Vec3(left + wall, front, top - board)});
  view.blocks.push_back({Vec3(right - wall, back, floor), Vec3(right, front, top - board)});
}

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
  scene.view.low = Vec3(-0.08 * side, 0.1 * side, -0.7 * side);
  scene.view.high = Vec3(1.08 * side, 0.6 * side, 0.0);
  add_table(scene.view, side, table);
  return scene;
}

}  // namespace fuai
