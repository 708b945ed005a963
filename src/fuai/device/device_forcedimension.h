// Force Dimension's devices and the Novint Falcon, through the vendor's library loaded at run time.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/devices.md, "Force Dimension and Falcon".
//
//   device:  x towards the user, y right, z up      ours:  x right, y away from the user, z up
//
//   A call that fails takes the force off, closes the device and opens it again after half a second at the
//   earliest; the read() that does so lasts as long as the vendor's open call. Nothing is lost by it: there
//   is no force meanwhile.
#pragma once

#include <string>

#include "fuai/device/device.h"
#include "fuai/device/device_clock.h"
#include "fuai/device/dhd_api.h"
#include "fuai/device/registry.h"

namespace fuai {

/// Path of libdhd or libdrd in the environment, instead of the names that are tried.
inline constexpr const char* kDhdLibraryVariable = "FUAI_DHD_LIBRARY";

/// One device of the vendor's.
class DeviceForceDimension final : public Device {
 public:
  /// @param model "omega.3", "falcon", ... or the vendor's number of the device, "0"; empty: the first
  /// @throws Error (kNoDevice) without library or device, with the vendor's text; (kUsage) for an unknown
  /// model. Thread class: set-up.
  explicit DeviceForceDimension(const std::string& model, DeviceClock clock = steady_seconds);
  ~DeviceForceDimension() override;

  const DeviceInfo& info() const noexcept override { return info_; }
  DeviceSample read() noexcept override;
  void write(const DeviceCommand& command) noexcept override;

 private:
  bool open_index(int index) noexcept;
  bool start() noexcept;
  bool open_again() noexcept;
  void close() noexcept;
  void lose() noexcept;
  void look_at_status() noexcept;
  bool read_pose() noexcept;

  DhdApi api_;
  DeviceClock clock_;
  DeviceInfo info_;
  RetryTimer retry_;
  int index_ = 0, type_ = 0;
  char id_ = 0;
  bool open_ = false, saturated_ = false, has_wrist_ = false, has_gripper_ = false;
  std::uint32_t slow_status_ = kDeviceReady;  // of what is asked only now and then
  unsigned reads_ = 0;
  DeviceSample last_;
};

}  // namespace fuai
