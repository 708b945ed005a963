// The force path: from a sample of the device and the cloth's newest model to the force on the hand.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md.
//
//   force loop, every tick                          cloth, as fast as it can
//   1  pose = follow(sample, dt)    -- pose -->      cloth.update(pose, its step) -> model
//   2  tick = render()              <-- model --     models().put(model)
//   3  device.write(tick.force)
//
//   follow()   checks the sample, filters the velocity, books the work, tells the tool's place
//   render()   newest model -> device's coordinates -> coupling -> blend -> force -> books, brake -> limits
//
// Nobody waits for anybody: models() is a mailbox. follow() and render() belong to one thread, put() to one
// other.
#pragma once

#include "fuai/core/mailbox_rt.h"
#include "fuai/device/device.h"
#include "fuai/device/velocity_filter_rt.h"
#include "fuai/haptics/coupling_rt.h"
#include "fuai/haptics/local_model_rt.h"
#include "fuai/haptics/passivity_rt.h"
#include "fuai/haptics/safety_limiter_rt.h"
#include "fuai/haptics/workspace_map_rt.h"

namespace fuai {

/// Everything that can be chosen.
struct ForcePathOptions {
  WorkspaceMap map;
  PassivityOptions passivity;
  SafetyOptions safety;
  double velocity_cutoff = 100.0;    ///< [Hz]
  double stable_stiffness = 1000.0;  ///< of the device [N/m]; stiffer models are felt through the coupling
  double damping = 0.0;              ///< put on the hand besides [N s/m]
  double blend = 0.004;              ///< time over which a new model takes over [s]; 0: at once
};

/// Options for a device: its limits, its mass, its stiffness; of an input without force its
/// workspace, and no force. Thread class: set-up.
ForcePathOptions make_force_path_options(const DeviceInfo& info);

/// What a tick was.
struct ForceTick {
  Vec3 force = Vec3::Zero();        ///< to be written to the device [N]
  Vec3 model_force = Vec3::Zero();  ///< as the model has it, in the device's coordinates [N]
  double energy = 0.0;              ///< of the passivity observer [J]
  double model_age = 0.0;           ///< [s]
  double gain = 0.0;                ///< of ramp and fading
  std::uint64_t model = 0;          ///< its number
  std::uint32_t status = kForceFine;
};

/// How often what happened since the beginning.
struct ForceCounters {
  std::uint64_t ticks = 0, models = 0, bad_samples = 0, late = 0, braked = 0, untrusted = 0;
};

/// One device's path.
class ForcePath {
 public:
  /// @throws Error (kUsage) for options out of range. Thread class: set-up.
  explicit ForcePath(const ForcePathOptions& options);

  /// Where the cloth puts its models.
  Mailbox<LocalModel>& models() noexcept { return models_; }
  /// @param sample of now @param dt since the last tick [s]; not positive or not finite counts as a late tick
  /// Thread class: real-time.
  ToolPose follow(const DeviceSample& sample, double dt) noexcept;
  /// The force at the sample of the last follow(). Thread class: real-time.
  ForceTick render() noexcept;

  /// While it is open the tool stays and no force is given. Thread class: real-time.
  void open_clutch(bool open) noexcept;
  /// Whether the hand wants to hold cloth. Thread class: real-time.
  void hold(bool holds) noexcept { holds_ = holds; }
  /// Clears latched faults. Thread class: real-time.
  void reset() noexcept { limiter_.reset(); }

  const WorkspaceMap& map() const noexcept { return options_.map; }
  /// Number of the newest model that was fetched, usable or not; 0: none yet. Thread class: real-time.
  std::uint64_t arrived() const noexcept { return models_.value().number; }
  const ForceCounters& counters() const noexcept { return counters_; }
  double time() const noexcept { return time_; }  ///< sum of all dt, none counted for more than a second [s]

 private:
  bool accept(const DeviceSample& sample, double dt) noexcept;
  void take_model() noexcept;
  Vec3 blended_force() const noexcept;

  ForcePathOptions options_;
  Mailbox<LocalModel> models_;
  VelocityFilter filter_;
  Passivity passivity_;
  SafetyLimiter limiter_;
  LocalModel model_;      // the newest, as the cloth gave it
  CoupledModel coupled_;  // the same as the device feels it
  ForceCounters counters_;
  double time_ = 0.0, dt_ = 0.0, gain_ = 0.0, blend_left_ = 0.0;
  Vec3 position_, velocity_ = Vec3::Zero(), tool_ = Vec3::Zero(), blend_force_ = Vec3::Zero();
  bool good_ = false, holds_ = true, clutched_ = false, closing_ = false;
  std::uint32_t status_ = kForceFine;
};

}  // namespace fuai
