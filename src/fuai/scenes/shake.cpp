// A fingertip shakes a hanging sheet as hard as an arm can, and harder.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {
namespace {

constexpr double kSpeed = 5.0, kBox = 0.3, kDwell = 0.02;  // [m/s], [m], [s]

/// Corners of the cube in the order of the zig-zag: edges, diagonals of faces and of the cube; the first
/// again at the end.
const std::array<Vec3, 9> kCorners{Vec3(-1, -1, -1), Vec3(1, 1, 1),   Vec3(-1, 1, 1),
                                   Vec3(1, -1, 1),   Vec3(1, -1, -1), Vec3(-1, 1, -1),
                                   Vec3(1, 1, -1),   Vec3(-1, -1, 1), Vec3(-1, -1, -1)};

class ZigZag : public SceneMotion {
 public:
  explicit ZigZag(const Vec3& start) : start_(start) {
    for (std::size_t leg = 0; leg + 1 < kCorners.size(); ++leg) {
      lasts_[leg] = 0.5 * kBox * (kCorners[leg + 1] - kCorners[leg]).norm() / kSpeed + kDwell;
      round_ += lasts_[leg];
    }
  }
  HandMoment hand(std::size_t, double time) const noexcept override {
    double left = std::fmod(time, round_);
    std::size_t leg = 0;
    while (leg + 2 < kCorners.size() && left >= lasts_[leg]) left -= lasts_[leg++];
    const double way = std::clamp(left / (lasts_[leg] - kDwell), 0.0, 1.0);
    HandMoment moment;
    moment.holds = true;
    // The first corner is where the hand starts, lowest, nearest and leftmost: the cube lies above and
    // behind.
    moment.position =
        start_ + 0.5 * kBox * (kCorners[leg] + way * (kCorners[leg + 1] - kCorners[leg]) - kCorners.front());
    return moment;
  }

 private:
  Vec3 start_;
  std::array<double, 8> lasts_{};  // of each leg with its rest [s]
  double round_ = 0.0;             // of all legs [s]
};

}  // namespace

EngineScene make_shake(const FabricLaws& laws, const SceneOptions& options) {
  EngineScene scene = make_clamped_sheet("shake", laws, options);
  scene.motion = std::make_unique<ZigZag>(start_position(scene, scene.hands.front().centre));
  scene.about_speed = true;
  scene.seconds = 2.0;
  scene.view.low -= Vec3(0.0, 0.0, 0.1 * kBox);
  scene.view.high += Vec3(0.3 * kBox, 0.3 * kBox, 0.0);
  return scene;
}

}  // namespace fuai
