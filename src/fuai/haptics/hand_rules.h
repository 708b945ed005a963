// Hands of flesh on a device: when they hold, how far they reach, how the workspace lies.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/haptics.md.
#pragma once

#include <algorithm>

#include "fuai/device/device.h"
#include "fuai/sim/grasp.h"

namespace fuai {

/// It grips cloth that is no farther from the tool [m]: two fingertips.
inline constexpr double kHandReach = 0.02;
/// Part of the device's workspace that what happens is to fill.
inline constexpr double kWorkspaceFill = 0.8;

/// Whether a hand can hold cloth at all: one whose device is away, or switched off, lets go. Thread class:
/// real-time.
inline bool can_hold(const DeviceSample& sample) noexcept {
  return (sample.status & (kDeviceDisconnected | kDeviceUncalibrated | kDeviceForceOff)) == 0;
}
/// Whether it wants to: any button is down, or the gripper more than half closed. Thread class: real-time.
inline bool wants_to_hold(const DeviceSample& sample) noexcept {
  return can_hold(sample) && (sample.buttons != 0 || sample.pinch > 0.5);
}

/// Metres of the tool to a metre of the device, so that a box fits into its workspace; at least 1: nobody
/// wants a small motion of the hand made smaller. @param box edges along the device's axes [m]. Thread class:
/// any.
inline double fitting_scale(const Vec3& box, const DeviceInfo& info) noexcept {
  const Vec3 room = kWorkspaceFill * (info.workspace_high - info.workspace_low);
  return std::max(1.0, box.cwiseQuotient(room).maxCoeff());
}

/// Most that a hold may have [N/m]: it is the coupling of cloth and tool, felt gain times scale stiffer than
/// it is, and the device must render that. An input without force takes any. Thread class: any.
inline double most_hold_stiffness(const DeviceInfo& info, double scale, double force_gain) noexcept {
  if (!(info.peak_force > 0.0)) return GraspSpec{}.stiffness;
  return info.stable_stiffness / (force_gain * scale);
}

}  // namespace fuai
