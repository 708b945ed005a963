// A 3D mouse by the daemon spacenavd: input without force.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/devices.md, "3D mouse".
#pragma once

#include <string>

#include "fuai/device/device.h"
#include "fuai/device/device_clock.h"
#include "fuai/device/input_events_rt.h"
#include "fuai/device/rate_control_rt.h"
#include "fuai/device/registry.h"
#include "fuai/device/stream_socket.h"

namespace fuai {

/// Path of the daemon's socket in the environment, instead of /var/run/spnav.sock.
inline constexpr const char* kSpacenavVariable = "FUAI_SPNAV_SOCKET";

/// How far it is pushed is how fast the hand goes. A daemon that is gone is looked for once a second.
class DeviceSpacenav final : public Device {
 public:
  /// @param path of the socket; empty: as usual
  /// @throws Error (kNoDevice) without the daemon. Thread class: set-up.
  explicit DeviceSpacenav(const std::string& path, DeviceClock clock = steady_seconds);

  const DeviceInfo& info() const noexcept override { return info_; }
  DeviceSample read() noexcept override;
  void write(const DeviceCommand&) noexcept override {}

 private:
  StreamAddress address_;
  StreamSocket socket_;
  SpacenavReader reader_;
  RateControl hand_;
  DeviceClock clock_;
  DeviceInfo info_;
  RetryTimer retry_;
};

}  // namespace fuai
