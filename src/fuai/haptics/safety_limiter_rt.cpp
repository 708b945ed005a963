// The last gate before the device.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/safety_limiter_rt.h"

#include <algorithm>
#include <cmath>

namespace fuai {

SafetyOptions make_safety_options(const DeviceInfo& info) {
  SafetyOptions options;
  options.most_force = info.peak_force;
  options.continuous_force = info.continuous_force;
  options.thermal_time = info.thermal_time;
  const Vec3 size = info.workspace_high - info.workspace_low;
  options.reach_low = info.workspace_low - 0.5 * size;
  options.reach_high = info.workspace_high + 0.5 * size;
  return options;
}

SafetyLimiter::SafetyLimiter(const SafetyOptions& options) noexcept
    : options_(options), heat_(options.most_force, options.continuous_force, options.thermal_time) {}

bool SafetyLimiter::is_good(const DeviceSample& sample, const Vec3& last, double dt) const noexcept {
  if (!sample.position.allFinite()) return false;
  if ((sample.position - options_.reach_low).minCoeff() < 0.0) return false;
  if ((options_.reach_high - sample.position).minCoeff() < 0.0) return false;
  // A device that measures its velocity gives a number or not-a-number; infinity and more than a hand can are
  // bad.
  if (!sample.velocity.hasNaN() && !(sample.velocity.norm() <= options_.most_speed)) return false;
  return !last.allFinite() || (sample.position - last).norm() <= options_.most_speed * dt;
}

double SafetyLimiter::gain(double age, double dt, std::uint32_t& status) noexcept {
  if (age > options_.old_model) status |= kForceModelOld;
  const double fade =
      std::clamp((options_.fade_ends - age) / (options_.fade_ends - options_.fade_begins), 0.0, 1.0);
  if (!(fade >= 1.0)) status |= kForceStalled;
  if (!(fade > 0.0))
    restart();  // from nothing it comes back slowly
  else
    ramp_ = std::min(1.0, ramp_ + dt / options_.ramp);
  if (ramp_ < 1.0) status |= kForceRamping;
  return faults_ != 0 || !(fade > 0.0) ? 0.0 : std::min(ramp_, fade);
}

Vec3 SafetyLimiter::limit(const Vec3& force, const Vec3& velocity, double gain, double dt,
                          std::uint32_t& status) noexcept {
  if (!force.allFinite() || !velocity.allFinite()) {
    latch(kForceFaultOutput);
    cut(dt);
    return last_;
  }
  Vec3 f = force;
  const auto shorten = [&](double most, std::uint32_t bit) {
    const double size = f.norm();
    if (!(size > most)) return;
    f *= most / size;
    status |= bit;
  };
  shorten(options_.most_force, kForceCut);
  shorten(heat_.most_force(), kForceWarm);
  // Power into the hand: only the part along the motion gives any.
  const double power = f.dot(velocity);
  if (power > options_.most_power) {
    f -= (power - options_.most_power) / velocity.squaredNorm() * velocity;
    status |= kForcePowerCut;
  }
  const Vec3 step = f - last_;
  const double size = step.norm(), most_step = std::min(options_.most_rate * dt, options_.most_step);
  if (size > most_step) {
    f = last_ + most_step / size * step;
    status |= kForceRateCut;
  }
  // The way back may be slower than the limits above; both ends of a step lie within the force limit, but the
  // thermal budget and the fading force have the last word.
  shorten(std::min(gain * options_.most_force, heat_.most_force()), kForceCut);
  last_ = f;
  heat_.advance(f.norm(), dt);
  return f;
}

void SafetyLimiter::cut(double dt) noexcept {
  last_ = Vec3::Zero();
  heat_.advance(0.0, std::isfinite(dt) && dt > 0.0 ? dt : 0.0);
}

}  // namespace fuai
