// A square sheet that swings down from level, held by two corners.
// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {
namespace {

constexpr double kCloser = 0.1, kCloserWithin = 0.5;  // part of the width; [s]

class CornersComeCloser : public SceneMotion {
 public:
  explicit CornersComeCloser(double width) : width_(width) {}
  HandMoment hand(std::size_t, double) const noexcept override { return {}; }
  Vec3 fixed_move(const Vec3& start, double time) const noexcept override {
    const double way = 0.5 * kCloser * width_ * smooth_rise(time, 0.0, kCloserWithin);
    return {start.x() < 0.5 * width_ ? way : -way, 0.0, 0.0};
  }
  bool moves_fixed() const noexcept override { return true; }

 private:
  double width_;
};

}  // namespace

EngineScene make_hanging_sheet(const FabricLaws& laws, const SceneOptions& options) {
  const SceneOptions o = fill_scene_options(options, 33);
  const double side = (o.size - 1) * o.spacing;
  ClothPieceSpec spec = make_sheet_spec(laws, o.size, o.size, o.spacing);
  spec.pins = {Vec2(0.0, side), Vec2(side, side)};
  EngineScene scene = make_sheet_scene("hanging_sheet", laws, spec);
  for (Vec3& x : scene.start.positions) x.y() -= side;  // the held edge at y = 0
  scene.motion = std::make_unique<CornersComeCloser>(side);
  scene.seconds = 5.0;
  scene.view.azimuth = -65.0 * std::numbers::pi / 180.0;
  scene.view.elevation = 12.0 * std::numbers::pi / 180.0;
  scene.view.low = Vec3(0.0, -0.3 * side, -side);
  scene.view.high = Vec3(side, 0.1 * side, 0.0);
  return scene;
}

}  // namespace fuai
