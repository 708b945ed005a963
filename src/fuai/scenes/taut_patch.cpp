// A fingertip pulls and trembles at a sheet that hangs in waves.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {
namespace {

constexpr double kPullRate = 2.0, kTremorRate = 8.0;  // [Hz]
constexpr double kTremor = 0.001;                     // [m]
constexpr double kPullOfSheet = 0.32;                 // the pull below is that of 32 nodes at 1 cm [m]
const Vec3 kPull(0.06, -0.02, -0.004);                // aside, forward, down [m]

class PullAndTremble : public SceneMotion {
 public:
  PullAndTremble(const Vec3& start, double scale) : start_(start), pull_(scale * kPull) {}
  HandMoment hand(std::size_t, double time) const noexcept override {
    const double turn = 2.0 * std::numbers::pi * time;
    HandMoment moment;
    moment.holds = true;
    moment.position = start_ + 0.5 * (1.0 - std::cos(kPullRate * turn)) * pull_ +
                      kTremor * std::sin(kTremorRate * turn) * Vec3::UnitZ();
    return moment;
  }

 private:
  Vec3 start_, pull_;
};

}  // namespace

EngineScene make_taut_patch(const FabricLaws& laws, const SceneOptions& options) {
  EngineScene scene = make_clamped_sheet("taut_patch", laws, options);
  const double side = scene.model.columns * scene.model.spacing;
  scene.motion = std::make_unique<PullAndTremble>(start_position(scene, scene.hands.front().centre),
                                                  side / kPullOfSheet);
  scene.seconds = 2.25;  // at the farthest point of the pull
  return scene;
}

}  // namespace fuai
