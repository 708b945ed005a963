// The last gate before the device: whatever comes in, what goes out is bounded.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Limits"; what it guarantees: docs/haptics.md, "Safety".
//
//   gain      0 without connection, model or trust; else it rises in `ramp` seconds, and while no model comes
//             it falls from 1 at `fade_begins` to 0 at `fade_ends`
//   limit()   force, thermal budget, power, change in a tick, gain * peak: in this order, the last word is
//             the gain's
//   faults    latched: no force until reset()
#pragma once

#include <cstdint>

#include "fuai/core/types.h"
#include "fuai/device/device.h"
#include "fuai/device/motor_heat_rt.h"

namespace fuai {

/// Bits of what the force path did or met in a tick.
enum ForceStatus : std::uint32_t {
  kForceFine = 0,
  kForceNoModel = 1U << 0,      ///< no model has come yet
  kForceModelOld = 1U << 1,     ///< the model is older than `old_model`
  kForceStalled = 1U << 2,      ///< no model for so long that the force fades
  kForceFaultModel = 1U << 3,   ///< latched: a model had numbers that are none, or absurd ones
  kForceFaultOutput = 1U << 4,  ///< latched: the path computed a force that is no number
  kForceSampleBad = 1U << 5,    ///< a sample was no number, or out of reach
  kForceDeviceAway = 1U << 6,   ///< the device is unplugged or not calibrated
  kForceLate = 1U << 7,         ///< the tick came later than `longest_tick`
  kForceRamping = 1U << 8,      ///< after a start
  kForceCut = 1U << 9,          ///< force limit
  kForceWarm = 1U << 10,        ///< thermal limit
  kForcePowerCut = 1U << 11,    ///< power limit
  kForceRateCut = 1U << 12,     ///< limit of the change
  kForceBraked = 1U << 13,      ///< the passivity controller acted
  kForceUntrusted = 1U << 14,   ///< the hand left the model's trust radius
  kForceClutched = 1U << 15,    ///< the clutch is open
};
inline constexpr std::uint32_t kForceFaults = kForceFaultModel | kForceFaultOutput;

/// Bounds. The defaults of the forces are a Touch's.
struct SafetyOptions {
  double most_force = 3.3;                     ///< [N]
  double continuous_force = 0.88;              ///< [N]
  double thermal_time = 10.0;                  ///< [s]
  double most_rate = 100.0;                    ///< of the force [N/s]
  double most_step = 0.1;                      ///< of the force in a tick [N]
  double most_power = 5.0;                     ///< into the hand [W]
  double ramp = 0.5;                           ///< from 0 to 1 after every start [s]
  double old_model = 0.033;                    ///< [s]
  double fade_begins = 0.05, fade_ends = 0.1;  ///< age of the model [s]
  double longest_tick = 0.02;                  ///< a tick that comes later starts anew [s]
  double most_speed = 10.0;                    ///< of a hand; faster samples are bad [m/s]
  double absurd_force = 1e4;                   ///< of a model; beyond it something broke [N]
  Vec3 reach_low = Vec3::Constant(-1.0), reach_high = Vec3::Constant(1.0);  ///< samples beyond are bad [m]
};

/// Bounds for a device: its forces, its workspace with half of its size around. Thread class: set-up.
SafetyOptions make_safety_options(const DeviceInfo& info);

/// The gate.
class SafetyLimiter {
 public:
  explicit SafetyLimiter(const SafetyOptions& options = {}) noexcept;

  /// Whether a sample is one. @param last position before [m], not finite: none @param dt since then [s]
  bool is_good(const DeviceSample& sample, const Vec3& last, double dt) const noexcept;
  /// Begins anew at gain 0: after connecting, a bad sample, a stall, the clutch. Thread class: real-time.
  void restart() noexcept { ramp_ = 0.0; }
  /// Latches faults. Thread class: real-time.
  void latch(std::uint32_t faults) noexcept { faults_ |= faults & kForceFaults; }
  /// Clears them and begins anew; without faults it does nothing. Thread class: real-time.
  void reset() noexcept {
    if (faults_ != 0) restart();
    faults_ = 0;
  }
  std::uint32_t faults() const noexcept { return faults_; }

  /// Share of the force that is given now. @param age of the model [s] @param dt [s]. Thread class:
  /// real-time.
  double gain(double age, double dt, std::uint32_t& status) noexcept;
  /// The force that may be given [N]. @param force asked for [N], any numbers @param velocity [m/s]
  Vec3 limit(const Vec3& force, const Vec3& velocity, double gain, double dt, std::uint32_t& status) noexcept;
  /// No force now, whatever was. Thread class: real-time.
  void cut(double dt) noexcept;
  const SafetyOptions& options() const noexcept { return options_; }

 private:
  SafetyOptions options_;
  MotorHeat heat_;
  double ramp_ = 0.0;
  Vec3 last_ = Vec3::Zero();
  std::uint32_t faults_ = 0;
};

}  // namespace fuai
