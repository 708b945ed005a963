// A fingertip yanks a hanging sheet and stops dead.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {
namespace {

constexpr double kSpeed = 5.0, kBegin = 0.1, kLasts = 0.02;  // [m/s], [s], [s]

class Yank : public SceneMotion {
 public:
  explicit Yank(const Vec3& start) : start_(start) {}
  HandMoment hand(std::size_t, double time) const noexcept override {
    HandMoment moment;
    moment.holds = true;
    moment.position = start_ - kSpeed * std::clamp(time - kBegin, 0.0, kLasts) * Vec3::UnitY();
    return moment;
  }

 private:
  Vec3 start_;
};

}  // namespace

EngineScene make_yank(const FabricLaws& laws, const SceneOptions& options) {
  EngineScene scene = make_clamped_sheet("yank", laws, options);
  scene.motion = std::make_unique<Yank>(start_position(scene, scene.hands.front().centre));
  scene.about_speed = true;
  scene.seconds = 0.5;
  return scene;
}

}  // namespace fuai
