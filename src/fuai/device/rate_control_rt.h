// Sticks and 3D mice give speeds: from how far one is pushed to where the hand is.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "fuai/core/types.h"
#include "fuai/device/device.h"
#include "fuai/device/input_events_rt.h"

namespace fuai {

/// x' = v d, kept in a box; d = 0 within the dead zone.
class RateControl {
 public:
  static constexpr double kSpeed = 0.15;     ///< at full deflection [m/s]: through the box in two seconds
  static constexpr double kDeadZone = 0.06;  ///< of the deflection: sticks do not quite return
  static constexpr double kReach = 0.15;     ///< half an edge of the box [m]
  static constexpr double kLongest = 0.05;   ///< a pause of the loop moves no further than so long [s]

  /// @param deflection of each axis, -1 to 1; what is beyond, or no number, is cut @param now [s]
  /// Thread class: real-time.
  void update(const Vec3& deflection, double now) noexcept {
    const double dt = started_ ? std::clamp(now - time_, 0.0, kLongest) : 0.0;
    time_ = now;
    started_ = true;
    for (int i = 0; i < 3; ++i) {
      const double d = std::isfinite(deflection[i]) ? std::clamp(deflection[i], -1.0, 1.0) : 0.0;
      const double beyond = std::max(0.0, std::abs(d) - kDeadZone) / (1.0 - kDeadZone);
      velocity_[i] = std::copysign(kSpeed * beyond, d);
      const double place = position_[i] + dt * velocity_[i];
      position_[i] = std::clamp(place, -kReach, kReach);
      if (position_[i] != place) velocity_[i] = 0.0;
    }
  }
  /// update(), and what a device of this kind reads. Thread class: real-time.
  DeviceSample sample(const InputState& state, double now, bool connected) noexcept {
    update(state.deflection, now);
    DeviceSample sample;
    sample.time = now;
    sample.position = position_;
    sample.velocity = velocity_;
    sample.buttons = state.buttons;
    sample.pinch = state.pinch;
    sample.status = connected ? kDeviceReady : kDeviceDisconnected;
    return sample;
  }
  const Vec3& position() const noexcept { return position_; }  ///< [m]
  const Vec3& velocity() const noexcept { return velocity_; }  ///< [m/s]

  /// What an input of this kind can do. Thread class: set-up.
  static DeviceInfo info(const char* driver, const std::string& model) {
    DeviceInfo info;
    info.driver = driver;
    info.model = model;
    info.sources = "chosen: a speed of 0.15 m/s in a box of 0.3 m";
    info.workspace_low = Vec3::Constant(-kReach);
    info.workspace_high = Vec3::Constant(kReach);
    info.resolution = 1e-6;
    info.force_freedoms = 0;
    return info;
  }

 private:
  Vec3 position_ = Vec3::Zero(), velocity_ = Vec3::Zero();
  double time_ = 0.0;
  bool started_ = false;
};

}  // namespace fuai
