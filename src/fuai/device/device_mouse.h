// The mouse of a window as a device: the window's thread hands in where the hand is.
// SPDX-License-Identifier: Apache-2.0
//
//   window's thread: set()  --mailbox-->  loop's thread: read()
#pragma once

#include "fuai/core/mailbox_rt.h"
#include "fuai/device/device.h"
#include "fuai/device/device_clock.h"
#include "fuai/device/registry.h"

namespace fuai {

/// What a window knows of the hand.
struct MouseInput {
  Vec3 position = Vec3::Zero();  ///< [m], in the device's axes; cut to its box
  std::uint32_t buttons = 0;
  double pinch = 0.0;  ///< 0 open to 1 closed
};

/// Input without force. set() by one thread, read() and write() by another.
class DeviceMouse final : public Device {
 public:
  static constexpr double kReach = 0.15;  ///< half an edge of its box [m]

  explicit DeviceMouse(DeviceClock clock = steady_seconds);

  /// The window's. A position that is not finite is forgotten. Thread class: real-time.
  void set(const MouseInput& input) noexcept;

  const DeviceInfo& info() const noexcept override { return info_; }
  DeviceSample read() noexcept override;
  void write(const DeviceCommand&) noexcept override {}

 private:
  Mailbox<MouseInput> inputs_;
  DeviceClock clock_;
  DeviceInfo info_;
};

}  // namespace fuai
