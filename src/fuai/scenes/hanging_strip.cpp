// A strip that hangs from its top edge.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>

#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {

EngineScene make_hanging_strip(const FabricLaws& laws, const SceneOptions& options) {
  const SceneOptions o = fill_scene_options(options, 64);
  const int columns = std::max(3, o.size / 8 + 1);
  const double width = (columns - 1) * o.spacing, height = (o.size - 1) * o.spacing;
  ClothPieceSpec spec = make_sheet_spec(laws, columns, o.size, o.spacing);
  spec.clamps.push_back(make_top_edge_clamp(height, o.spacing));
  EngineScene scene = make_sheet_scene("hanging_strip", laws, spec);
  hang_upright(scene);
  scene.seconds = 2.0;
  scene.view.azimuth = -60.0 * std::numbers::pi / 180.0;
  scene.view.elevation = 10.0 * std::numbers::pi / 180.0;
  scene.view.low = Vec3(0.0, 0.0, -1.02 * height);
  scene.view.high = Vec3(width, 0.0, 0.02);
  scene.view.blocks.push_back({Vec3(-0.02, -0.01, 0.0), Vec3(width + 0.02, 0.01, 0.015)});
  return scene;
}

}  // namespace fuai
