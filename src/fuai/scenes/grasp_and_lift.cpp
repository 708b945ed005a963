// A hand lifts a corner of a sheet whose far edge is held, and lets it go.
// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/lift_motion.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {
namespace {

constexpr double kLift = 0.15, kLiftOfSheet = 0.32;                  // 15 cm for a sheet of 32 cm [m]
constexpr double kLiftBegins = 0.5, kLiftEnds = 1.5, kLetsGo = 2.5;  // [s]

}  // namespace

EngineScene make_grasp_and_lift(const FabricLaws& laws, const SceneOptions& options) {
  const SceneOptions o = fill_scene_options(options, 33);
  const double side = (o.size - 1) * o.spacing;
  ClothPieceSpec spec = make_sheet_spec(laws, o.size, o.size, o.spacing);
  spec.clamps.push_back(make_top_edge_clamp(side, o.spacing));
  EngineScene scene = make_sheet_scene("grasp_and_lift", laws, spec);
  GraspSpec hand;
  hand.centre = Vec2(0.9 * side, 0.1 * side);
  scene.hands.push_back(hand);
  LiftPath path;
  path.start = start_position(scene, hand.centre);
  path.height = kLift * side / kLiftOfSheet;
  // Toward the held edge as it rises, as an arm does, so that the cloth is lifted rather than pulled.
  path.direction = Vec3(0.0, 0.5, 1.0);
  path.begins = kLiftBegins;
  path.ends = kLiftEnds;
  path.lets_go = kLetsGo;
  scene.motion = make_lift_motion(path);
  scene.seconds = 4.0;
  scene.picture_time = 0.5 * (kLiftEnds + kLetsGo);  // while it is held up
  scene.view.azimuth = -105.0 * std::numbers::pi / 180.0;
  scene.view.elevation = 20.0 * std::numbers::pi / 180.0;
  scene.view.low = Vec3(0.0, 0.3 * side, -0.95 * side);
  scene.view.high = Vec3(side, side, 0.35 * side);
  scene.view.blocks.push_back(
      {Vec3(-0.02, side - 0.25 * o.spacing, -0.012), Vec3(side + 0.02, side + 0.02, 0.012)});
  return scene;
}

}  // namespace fuai
