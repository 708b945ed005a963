// A haptic device as a hand of the viewer: between its force path and the session of the cloths.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "A device".
//
//   force loop (runtime/running_session.h)         cloth's thread                        window's thread
//     device -> force path -- pose, mailbox -->      update(): ViewSession::tick()         look(), begin(),
//     device <- force path <-- model, mailbox --     what the hand feels                   set_speed()
//     on_tick() ---------------- mailbox of DeviceView ----------------------------->
//
//   In virtual time tick() does both on the caller's thread, so that everything depends on nothing but the
//   device: with a simulated one on the options alone.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "fuai/core/mailbox_rt.h"
#include "fuai/haptics/virtual_session.h"
#include "fuai/runtime/paced_thread.h"
#include "fuai/runtime/running_session.h"
#include "fuai/scenes/engine_scene.h"
#include "fuai/viewer/view_session.h"

namespace fuai {

/// A device, and who says when its hand holds.
struct HandDevice {
  std::unique_ptr<Device> device;
  std::unique_ptr<HoldRule> holds;
  bool computed = false;  ///< simulated: it can live in virtual time
};
/// "driver" or "driver:model". The hand of a simulated device goes through the cloth by itself, to and fro,
/// and takes hold of it on its way. @throws Error as open_device(). Thread class: set-up.
HandDevice open_hand_device(const std::string& name);

/// What the window shows of it.
struct DeviceView {
  Vec3 tool = Vec3::Zero();  ///< where the hand is in the scene [m]
  double force = 0.0;        ///< sent to the device, behind all limits [N]
  double rate = 0.0;         ///< of the force loop in the last half second; 0: not known yet [Hz]
  std::uint64_t overruns = 0;
  bool away = false;     ///< unplugged, not calibrated or switched off: no force, and the hand has let go
  bool faulted = false;  ///< the force path gives no force until the next begin()
};

/// How device and scene lie to each other: the middle of the workspace at the middle of the scene, as the
/// scene is seen first, and so large that the hand reaches all of it. Thread class: set-up.
WorkspaceMap fit_workspace(const SceneView& view, const DeviceInfo& info);

/// The hand. One thread calls all of it but what is said to be another's.
class DeviceHand final : private HapticEnvironment, private HoldRule, private SessionListener {
 public:
  enum class Time { kReal, kVirtual };
  /// @param session must outlive it; it alone ticks the session from the first begin() to end()
  DeviceHand(HandDevice device, ViewSession& session, Time time);
  ~DeviceHand() override;

  /// Starts, or starts anew with another scene. Thread class: set-up.
  void begin(const SceneView& scene);
  /// No force any more, and nobody ticks the session. @return what the system would not give, when ticks were
  /// missed. Thread class: set-up.
  std::vector<std::string> end();
  /// In virtual time: one tick of kViewStep. @param wall_us as for ViewSession::tick().
  void tick(double wall_us) noexcept;

  /// As PacedThread. Thread class: any.
  void set_speed(double speed) noexcept { speed_.store(speed, std::memory_order_relaxed); }
  double real_time_factor() const noexcept { return factor_.load(std::memory_order_relaxed); }
  /// The newest there is.
  DeviceView look() noexcept;
  const DeviceInfo& info() const noexcept { return device_.device->info(); }

 private:
  LocalModel update(const ToolPose& pose, double dt, double next) noexcept override;
  bool holds(std::size_t hand, double time, const DeviceSample& last) noexcept override;
  void on_tick(const TickRecord& record) noexcept override;
  void on_step(const ClothStepRecord& /*record*/) noexcept override {}
  bool step_cloth(const DevicePose& at) noexcept;
  void audit(const ToolPose& pose, std::uint64_t disturbances) noexcept;

  HandDevice device_;
  ViewSession& session_;
  Time time_;
  std::unique_ptr<ForcePath> path_;
  std::atomic<double> speed_{1.0}, factor_{0.0};
  Mailbox<DeviceView> box_;
  // Of the force loop alone:
  DeviceView view_;
  DeviceSample last_sample_;
  double marked_at_ = 0.0;
  std::uint64_t marked_tick_ = 0;
  // Of the cloth alone:
  double wall_us_ = 0.0, stiffness_ = 0.0;
  Pace pace_{kViewStep, 0.0};
  LocalModel model_;
  double audited_at_ = 0.0, work_ = 0.0, stored_ = 0.0, told_ = 0.0;
  std::uint64_t disturbances_ = 0;
  // Last: they use all of the above.
  std::unique_ptr<VirtualSession> virtual_;
  std::unique_ptr<RunningSession> running_;
};

}  // namespace fuai
