// A force path without limits, brake and ramp: what sampling alone does to a wall.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "fuai/device/device_simulated.h"
#include "fuai/haptics/force_path_rt.h"

namespace fuai_test {

inline constexpr double kTick = 1e-3;  ///< [s]

inline fuai::ForcePathOptions wide_open() {
  fuai::ForcePathOptions options;
  options.passivity.control = false;
  options.safety.most_force = options.safety.continuous_force = 1e9;
  options.safety.absurd_force = 1e9;
  options.safety.most_rate = options.safety.most_step = options.safety.most_power = 1e15;
  options.safety.most_speed = 1e9;
  options.safety.reach_low = fuai::Vec3::Constant(-1e6);
  options.safety.reach_high = fuai::Vec3::Constant(1e6);
  options.safety.ramp = 1e-9;
  options.stable_stiffness = 1e12;
  return options;
}

/// A device of 45 g without friction, encoder and ends.
inline fuai::SimulatedDeviceSpec bare_device(double damping, double delay = 0.0) {
  fuai::SimulatedDeviceSpec spec;
  spec.info.mass = 0.045;
  spec.info.peak_force = spec.info.continuous_force = 1e12;
  spec.info.workspace_low = fuai::Vec3::Constant(-1e5);
  spec.info.workspace_high = fuai::Vec3::Constant(1e5);
  spec.damping = damping;
  spec.delay = delay;
  return spec;
}

inline fuai::SimulatedDevice still_device(const fuai::SimulatedDeviceSpec& spec,
                                          const fuai::HandModel& hand = {}) {
  return fuai::SimulatedDevice(spec, hand, fuai::make_still_motion(fuai::Vec3::Zero()));
}

}  // namespace fuai_test
