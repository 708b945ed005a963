// A square sheet without gravity, bent at the middle of its free edge.
// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/lift_motion.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {
namespace {

constexpr double kLift = 0.04, kLiftOfLength = 0.15;  // 4 cm for a free length of 15 cm [m]
constexpr double kUp = 1.0, kBack = 2.0;              // [s]

}  // namespace

EngineScene make_bending(const FabricLaws& laws, const SceneOptions& options) {
  const SceneOptions o = fill_scene_options(options, 17);
  const double side = (o.size - 1) * o.spacing;
  ClothPieceSpec spec = make_sheet_spec(laws, o.size, o.size, o.spacing);
  // Two rows: up to the second, as the study's test holds them.
  spec.clamps.push_back({HalfPlaneRegion{Vec2::UnitY(), 1.25 * o.spacing}, false});
  EngineScene scene = make_sheet_scene("bending", laws, spec);
  scene.options.implicit.gravity = Vec3::Zero();
  GraspSpec finger;
  finger.centre = Vec2(0.5 * side, side);
  scene.hands.push_back(finger);
  LiftPath path;
  path.start = start_position(scene, finger.centre);
  path.cantilever = side - o.spacing;
  path.height = kLift * path.cantilever / kLiftOfLength;
  path.ends = path.back_begins = kUp;
  path.back_ends = kBack;
  scene.motion = make_lift_motion(path);
  scene.seconds = 1.0;  // at the highest point
  scene.view.azimuth = -25.0 * std::numbers::pi / 180.0;
  scene.view.elevation = 18.0 * std::numbers::pi / 180.0;
  scene.view.low = Vec3(0.0, 0.0, -0.01);
  scene.view.high = Vec3(side, side, 0.3 * side);
  scene.view.blocks.push_back({Vec3(-0.01, -0.02, -0.016), Vec3(side + 0.01, o.spacing, -0.001)});
  return scene;
}

}  // namespace fuai
