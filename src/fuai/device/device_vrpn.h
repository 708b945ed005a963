// A device behind a VRPN server, by a client of our own.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/devices.md, "VRPN"; docs/theory/device-protocols.md.
//
//   server's axes:  x right, y up, z towards the user (as its PHANToM and Falcon servers have)
//
//   A remote force is always a field about a point: each write() sends one with the force and no stiffness
//   about the last position, 10 mm wide, so that a force that nobody renews ends where the hand leaves.
//   Nothing heard: after 0.25 s of a force device samples say disconnected and the field is taken away; after
//   10 s, or when the connection ends, it is made again, once a second. read() and write() never wait.
#pragma once

#include <functional>
#include <string>

#include "fuai/device/device.h"
#include "fuai/device/device_clock.h"
#include "fuai/device/registry.h"
#include "fuai/device/stream_socket.h"
#include "fuai/device/vrpn_client.h"

namespace fuai {

/// "host:port" in the environment, where --diagnose looks for a server and names without a host are looked
/// for.
inline constexpr const char* kVrpnAddressVariable = "FUAI_VRPN_ADDRESS";

/// What a remote device is, and how to wait for it.
struct VrpnOptions {
  std::string name = "Phantom0";  ///< on the server
  std::string host = "localhost";
  std::string port = "3883";
  double patience = 2.0;  ///< for the first answer, at opening [s]
  DeviceClock clock = steady_seconds;
  std::function<void()> idle;  ///< called instead of waiting while it opens; for tests
};
/// "Phantom0", "Phantom0@host", "Phantom0@tcp:host:port"; the rest from the environment or the defaults.
/// @throws Error (kUsage). Thread class: set-up.
VrpnOptions parse_vrpn_name(const std::string& text);

/// One remote device.
class DeviceVrpn final : public Device {
 public:
  /// @throws Error (kNoDevice) when there is no server, another version, no such device, or no position
  /// comes. Thread class: set-up.
  explicit DeviceVrpn(const VrpnOptions& options);
  ~DeviceVrpn() override;

  const DeviceInfo& info() const noexcept override { return info_; }
  DeviceSample read() noexcept override;
  void write(const DeviceCommand& command) noexcept override;

 private:
  void listen(double now) noexcept;
  void keep_alive(double now) noexcept;
  bool trusted(double now) const noexcept;
  std::string problem() const;

  VrpnOptions options_;
  StreamAddress address_;
  StreamSocket socket_;
  VrpnClient client_;
  DeviceInfo info_;
  RetryTimer retry_, ping_;
  bool greeted_ = false, has_force_ = false, saturated_ = false, refused_ = false;
  double heard_ = 0.0, posed_ = 0.0;  // when there was something, and a position [s]
  double troubled_ = -1e9;            // when the server told of an error of force [s]
  std::uint32_t pose_count_ = 0, error_count_ = 0;
  DeviceSample last_;
};

}  // namespace fuai
