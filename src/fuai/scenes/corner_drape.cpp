// The founding paper's corner drape on the engine.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", section 4.1 (Fig. 4).
#include <cmath>
#include <numbers>

#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/paper_drape.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {

EngineScene make_corner_drape(const FabricLaws& laws, const SceneOptions& options) {
  const PaperDrapeOptions paper;
  // Without a size, the paper's sheet at any spacing; a spacing that does not divide it cuts cells.
  SceneOptions o = fill_scene_options(options, 18, paper.spacing);
  if (options.size == 0) {
    o.size = static_cast<int>(std::ceil(paper.edge / o.spacing - 1e-6)) + 1;
    o = fill_scene_options(o, o.size);
  }
  const double edge = options.size == 0 ? paper.edge : (o.size - 1) * o.spacing;
  const double block = edge * (paper.fixed_edge / paper.edge);
  ClothPieceSpec spec = make_sheet_spec(laws, o.size, o.size, o.spacing);
  spec.outline = make_rectangle_outline(edge, edge);
  spec.clamps.push_back({make_rectangle_region(Vec2(-edge, -edge), Vec2(block, block)), true});
  EngineScene scene = make_sheet_scene("corner_drape", laws, spec);
  scene.seconds = 3.0;
  scene.view.azimuth = 30.0 * std::numbers::pi / 180.0;
  scene.view.elevation = 18.0 * std::numbers::pi / 180.0;
  scene.view.low = Vec3(0.1 * edge, 0.1 * edge, -1.1 * edge);
  scene.view.high = Vec3(0.6 * edge, 0.6 * edge, 0.0);
  // A board and no table: nothing keeps the cloth out of it, and a table would hide what hangs inside.
  scene.view.blocks.push_back({Vec3(-0.18 * edge, -0.18 * edge, -0.1 * edge), Vec3(block, block, -0.0015)});
  return scene;
}

}  // namespace fuai
