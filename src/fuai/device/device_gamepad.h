// A gamepad by the kernel's joystick nodes: input without force.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/devices.md, "Gamepad".
#pragma once

#include <string>

#include "fuai/device/device.h"
#include "fuai/device/device_clock.h"
#include "fuai/device/input_events_rt.h"
#include "fuai/device/rate_control_rt.h"
#include "fuai/device/registry.h"

namespace fuai {

/// How far the sticks are pushed is how fast the hand goes. A gamepad that is gone is looked for once a
/// second.
class DeviceGamepad final : public Device {
 public:
  /// @param path of its node, "/dev/input/js0"; empty: the first that may be read
  /// @throws Error (kNoDevice) with the system's words. Thread class: set-up.
  explicit DeviceGamepad(const std::string& path, DeviceClock clock = steady_seconds);
  ~DeviceGamepad() override;

  const DeviceInfo& info() const noexcept override { return info_; }
  DeviceSample read() noexcept override;
  void write(const DeviceCommand&) noexcept override {}

 private:
  bool open_node() noexcept;
  void close_node() noexcept;

  std::string path_;
  JoystickReader reader_;
  RateControl hand_;
  DeviceClock clock_;
  DeviceInfo info_;
  RetryTimer retry_;
  int descriptor_ = -1;
};

}  // namespace fuai
