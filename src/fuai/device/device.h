// A thing that a hand holds: where it is, and what force it is to give. Devices know no cloth.
// SPDX-License-Identifier: Apache-2.0
//
//   open -> info() -> [read() -> write() -> advance()]* at info().rate -> close by destruction, which leaves
//   no force on
//
//   Every driver is one file with a DeviceDriver (registry.h). Coordinates are those of the device's stand:
//   x right, y away from the user, z up; a driver turns its own into these.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "fuai/core/types.h"

namespace fuai {

/// What a device can do. Numbers that nobody states are assumed, and `sources` says so.
struct DeviceInfo {
  std::string driver;                 ///< as in the registry
  std::string model;                  ///< name of the device
  std::string sources;                ///< where the numbers come from, what is assumed
  Vec3 workspace_low = Vec3::Zero();  ///< corners of the box it reaches [m]
  Vec3 workspace_high = Vec3::Zero();
  double peak_force = 0.0;        ///< for a moment [N]; 0: no force feedback
  double continuous_force = 0.0;  ///< for ever [N]
  double thermal_time = 10.0;     ///< time constant of its motors' warming [s]
  double stable_stiffness = 0.0;  ///< of a virtual wall that it renders without buzzing [N/m]
  double stable_damping = 0.0;    ///< of the same [N s/m]
  double resolution = 0.0;        ///< step of the position it reports [m]
  double rate = 1000.0;           ///< of the force loop [Hz]
  double mass = 0.0;              ///< that the hand moves [kg]
  double command_timeout = 0.0;   ///< it drops its force by itself so long after a command [s]; 0: never
  int position_freedoms = 3;
  int force_freedoms = 3;
};

/// What a device says about itself; bits.
enum DeviceStatus : std::uint32_t {
  kDeviceReady = 0,
  kDeviceDisconnected = 1,   ///< unplugged or powered off: samples are stale, commands go nowhere
  kDeviceSaturated = 2,      ///< the last command was larger than it gives
  kDeviceWarm = 4,           ///< its motors are at their limit: it gives less than asked
  kDeviceTimedOut = 8,       ///< no command came in time: it gives no force
  kDeviceUncalibrated = 16,  ///< positions are not to be trusted yet
  kDeviceForceOff = 32       ///< it gives no force until its user or its maker's program switches it on
};

/// Where the hand is.
struct DeviceSample {
  double time = 0.0;             ///< of the device's clock [s]
  Vec3 position = Vec3::Zero();  ///< [m]
  /// As the device measures it [m/s]; not a number when it does not.
  Vec3 velocity = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Mat3 orientation = Mat3::Identity();
  std::uint32_t buttons = 0;            ///< bit i: button i is down
  double pinch = 0.0;                   ///< of a gripper, 0 open to 1 closed
  std::uint32_t status = kDeviceReady;  ///< DeviceStatus bits
};

/// What the device is to do until the next command.
struct DeviceCommand {
  Vec3 force = Vec3::Zero();  ///< on the hand [N]
};

/// What a device gives of a command: nothing of one that is not finite, no more than `peak` [N].
/// @param cut whether it was larger. Thread class: real-time.
inline Vec3 force_within(const DeviceCommand& command, double peak, bool& cut) noexcept {
  cut = false;
  if (!command.force.allFinite()) return Vec3::Zero();
  const double size = command.force.norm();
  cut = size > peak;
  return cut ? Vec3(command.force * (peak / size)) : command.force;
}

/// A device. One thread calls read() and write().
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  /// Constant while it is open. Thread class: any.
  virtual const DeviceInfo& info() const noexcept = 0;
  /// The newest sample; of an unplugged device the last one, with kDeviceDisconnected. Thread class:
  /// real-time.
  virtual DeviceSample read() noexcept = 0;
  /// A force that is not finite counts as none. Thread class: real-time.
  virtual void write(const DeviceCommand& command) noexcept = 0;
  /// Lets time pass in a device that is computed; others know it themselves. @param dt [s], > 0. Thread
  /// class: real-time.
  virtual void advance(double /*dt*/) noexcept {}
};

}  // namespace fuai
