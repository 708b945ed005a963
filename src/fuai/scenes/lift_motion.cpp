// Lifts cloth.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/scenes/lift_motion.h"

#include "fuai/core/error.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {
namespace {

class LiftMotion : public SceneMotion {
 public:
  explicit LiftMotion(const LiftPath& path) : path_(path) {}
  HandMoment hand(std::size_t, double time) const noexcept override {
    const bool comes_back = path_.back_ends > path_.back_begins;
    const double up = smooth_rise(time, path_.begins, path_.ends);
    const double back = comes_back ? smooth_rise(time, path_.back_begins, path_.back_ends) : 0.0;
    const double lift = path_.height * (up - back);
    HandMoment moment;
    moment.holds = time < path_.lets_go;
    moment.position = path_.start + lift * path_.direction;
    if (path_.cantilever > 0.0) moment.position.y() += -0.6 * lift * lift / path_.cantilever;
    return moment;
  }

 private:
  LiftPath path_;
};

}  // namespace

std::unique_ptr<const SceneMotion> make_lift_motion(const LiftPath& path) {
  if (!(path.ends > path.begins)) throw Error(ErrorKind::kUsage, "a lift must end after it begins");
  return std::make_unique<LiftMotion>(path);
}

}  // namespace fuai
