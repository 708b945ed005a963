// A device that is computed, and the hand that holds it: what a force loop is tried on without hardware.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "The simulated device"; numbers of the presets: docs/haptics.md.
//
//   (m + m_h) x'' = F(t - t_d) - b x' - f_c x'/|x'| + k_h (x_t - x) + b_h (x_t' - x')
//
//   F is what was written last, cut to what the device gives and held until the next command; the program
//   sees x rounded to the encoder's step. Equal substeps of at most 50 us: the
//   dampers are implicit, a force that is held is integrated exactly. The same input gives the same bits.
//
//   [read -> write -> advance(dt)]* ; time passes in advance() only.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "fuai/device/device.h"
#include "fuai/device/hand_model.h"
#include "fuai/device/motor_heat_rt.h"

namespace fuai {

/// What a simulated device is made of besides what info says.
struct SimulatedDeviceSpec {
  DeviceInfo info;        ///< mass, resolution, forces, workspace, timeout
  double damping = 0.1;   ///< b [N s/m]
  double friction = 0.0;  ///< f_c [N]
  double delay = 0.0;     ///< t_d from write() to the motor [s], at most kMostDelay
};

inline constexpr double kMostDelay = 0.02;  ///< [s]

/// A device in the list of presets.
struct DevicePreset {
  std::string_view name;  ///< "touch"
  SimulatedDeviceSpec spec;
};

/// PHANToM Premium 1.5, Touch, Touch X, omega.3, Falcon, Inverse3. Thread class: any.
std::span<const DevicePreset> device_presets();
/// @throws Error (kUsage) with all names for one that does not exist. Thread class: set-up.
const SimulatedDeviceSpec& find_device_preset(std::string_view name);

/// The device and the hand.
class SimulatedDevice final : public Device {
 public:
  /// @param motion where the hand wants to be; the device starts there at rest
  /// @throws Error (kUsage) for numbers out of range. Thread class: set-up.
  SimulatedDevice(const SimulatedDeviceSpec& spec, const HandModel& hand,
                  std::unique_ptr<const HandMotion> motion);

  const DeviceInfo& info() const noexcept override { return spec_.info; }
  DeviceSample read() noexcept override;
  void write(const DeviceCommand& command) noexcept override;

  void advance(double dt) noexcept override;
  /// Plugs it out and in: without the plug it gives no force and its samples stay as they were.
  /// Thread class: real-time.
  void set_connected(bool connected) noexcept;
  /// Puts the device somewhere at rest, as by another hand. Thread class: real-time.
  void place(const Vec3& position) noexcept;
  /// A push on top of hand and motors, until the next call [N]. Thread class: real-time.
  void push(const Vec3& force) noexcept { push_ = force; }

  double time() const noexcept { return time_; }                    ///< [s]
  const Vec3& true_position() const noexcept { return position_; }  ///< before rounding [m]
  const Vec3& true_velocity() const noexcept { return velocity_; }  ///< [m/s]
  const Vec3& given_force() const noexcept { return given_; }       ///< of the motors, last substep [N]
  /// Energy that the hand and the device's mass put into the motors since the beginning [J]: the port's true
  /// balance, - integral of F.v. Thread class: real-time.
  double work_received() const noexcept { return work_; }

 private:
  struct Queued {
    double time = 0.0;
    Vec3 force = Vec3::Zero();
  };
  void substep(double dt) noexcept;
  Vec3 motor_force() noexcept;
  void stop_at_walls() noexcept;

  SimulatedDeviceSpec spec_;
  HandModel hand_;
  std::unique_ptr<const HandMotion> motion_;
  MotorHeat heat_;
  double time_ = 0.0, last_command_ = 0.0, work_ = 0.0;
  Vec3 position_ = Vec3::Zero(), velocity_ = Vec3::Zero();
  Vec3 commanded_ = Vec3::Zero(), given_ = Vec3::Zero(), push_ = Vec3::Zero();
  std::array<Queued, 64> queue_{};  // of commands on their way
  std::size_t first_ = 0, count_ = 0;
  bool connected_ = true, warm_ = false, saturated_ = false;
  DeviceSample last_;
};

}  // namespace fuai
