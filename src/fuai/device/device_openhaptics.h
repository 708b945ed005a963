// 3D Systems' devices (PHANToM, Touch, Touch X) through OpenHaptics' HDAPI, loaded at run time.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/devices.md, "PHANToM and Touch".
//
//   device:  x right, y up, z towards the user, mm      ours:  x right, y away from the user, z up, m
//
//   1. The vendor's scheduler has a thread of its own, which calls tick() a thousand times a second.
//   2. tick() puts a sample into one mailbox, takes the command from the other, sets the force. A command
//   that is
//      older than 0.1 s counts as none: so nobody pulls when our loop stands still.
//   3. read() and write() only look into the mailboxes; neither thread waits.
//   4. Warm motors or a limit exceeded: half a second without force, and samples say so.
//   5. Any other error, or no tick for 0.1 s: disconnected. read() opens the device again, half a second
//   later at
//      the earliest; that one call lasts as long as the vendor's.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "fuai/core/mailbox_rt.h"
#include "fuai/device/device.h"
#include "fuai/device/device_clock.h"
#include "fuai/device/registry.h"

namespace fuai {

/// Path of libHD in the environment, instead of the names that are tried.
inline constexpr const char* kHdLibraryVariable = "FUAI_HD_LIBRARY";

class HdSession;

/// One device of the vendor's.
class DeviceOpenHaptics final : public Device {
 public:
  /// @param name as in the vendor's configuration ("Default Device"); empty: the usual names
  /// @param clock must be callable from the vendor's thread
  /// @throws Error (kNoDevice) without library or device, with the vendor's text. Thread class: set-up.
  explicit DeviceOpenHaptics(const std::string& name, DeviceClock clock = steady_seconds);
  ~DeviceOpenHaptics() override;

  const DeviceInfo& info() const noexcept override { return info_; }
  DeviceSample read() noexcept override;
  void write(const DeviceCommand& command) noexcept override;

 private:
  /// A command and when it was given.
  struct Timed {
    DeviceCommand command;
    double time = -1e9;  // [s]
  };
  static unsigned scheduled(void* self) noexcept;
  unsigned tick() noexcept;
  void read_state(DeviceSample& sample) noexcept;
  Vec3 wanted_force(double now, DeviceSample& sample) noexcept;
  bool take_errors(DeviceSample& sample) noexcept;
  std::string open_device_named(const char* name);
  bool start() noexcept;
  void open_again() noexcept;
  void stop() noexcept;
  void make_info();

  std::shared_ptr<HdSession> session_;
  DeviceClock clock_;
  DeviceInfo info_;
  std::string name_;
  const char* used_name_ = nullptr;  // of the device that was opened; nullptr: the vendor's default
  RetryTimer retry_;
  Mailbox<DeviceSample> samples_;
  Mailbox<Timed> commands_;
  // Between start() and stop() these belong to the vendor's thread.
  unsigned handle_ = 0xFFFFFFFF;
  unsigned long callback_ = 0;
  int silent_ticks_ = 0, ticks_ = 0;
  std::uint32_t silent_reason_ = 0;
  bool calibrated_ = false;
  // These to the thread that reads.
  bool running_ = false;
  double started_ = 0.0;  // [s]
  DeviceSample last_;
};

}  // namespace fuai
