// The hand of a device on the viewer's cloths.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/device_hand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <thread>
#include <utility>

#include "fuai/device/device_simulated.h"
#include "fuai/device/registry.h"
#include "fuai/haptics/cloth_hand.h"
#include "fuai/haptics/hand_rules.h"

namespace fuai {
namespace {

/// Round the device's middle: from the user away and back [s].
constexpr double kVisitPeriod = 4.0;
/// Of each round it wants to hold from here to there [s]: not before the force's ramp is over, and it lets go
/// before it comes back to where it began.
constexpr double kVisitGrips = 0.5, kVisitLetsGo = 3.5;
/// Half axes of the way, as parts of the workspace, away from the user and up.
constexpr double kVisitFar = 0.2, kVisitHigh = 0.1;
/// Rates of the force loop that are asked for [Hz]: what every driver does, and more than four times of it
/// takes a core.
constexpr double kLeastRate = 1000.0, kMostRate = 4000.0;
/// Ticks that are caught up with at once; PacedThread does them one after another, too.
constexpr int kTicksAtOnce = 4;
constexpr double kRatePeriod = 0.5;  ///< over which the rate is counted [s]

/// To and fro through the middle, for ever.
class VisitMotion final : public HandMotion {
 public:
  explicit VisitMotion(const DeviceInfo& info) noexcept
      : middle_(0.5 * (info.workspace_low + info.workspace_high)),
        room_(info.workspace_high - info.workspace_low) {}
  HandTarget at(double time) const noexcept override {
    const double rate = 2.0 * std::numbers::pi / kVisitPeriod, phase = rate * time;
    const Vec3 far(0.0, kVisitFar * room_.y(), 0.0), high(0.0, 0.0, kVisitHigh * room_.z());
    return {middle_ - std::cos(phase) * far + std::sin(phase) * high,
            rate * (std::sin(phase) * far + std::cos(phase) * high)};
  }

 private:
  Vec3 middle_, room_;
};

class VisitHolds final : public HoldRule {
 public:
  bool holds(std::size_t /*hand*/, double time, const DeviceSample& last) noexcept override {
    const double phase = std::fmod(time, kVisitPeriod);
    return can_hold(last) && phase >= kVisitGrips && phase < kVisitLetsGo;
  }
};

class ButtonHolds final : public HoldRule {
 public:
  bool holds(std::size_t /*hand*/, double /*time*/, const DeviceSample& last) noexcept override {
    return wants_to_hold(last);
  }
};

}  // namespace

HandDevice open_hand_device(const std::string& name) {
  const std::size_t colon = name.find(':');
  if (find_device_driver(name.substr(0, colon)).name != simulated_driver().name)
    return {open_device(name), std::make_unique<ButtonHolds>(), false};
  const SimulatedDeviceSpec& spec =
      colon == std::string::npos ? device_presets().front().spec : find_device_preset(name.substr(colon + 1));
  return {std::make_unique<SimulatedDevice>(spec, find_hand_model("arm"),
                                            std::make_unique<VisitMotion>(spec.info)),
          std::make_unique<VisitHolds>(), true};
}

WorkspaceMap fit_workspace(const SceneView& view, const DeviceInfo& info) {
  WorkspaceMap map;
  // The device's x, y and z: to the right, away from the eye, up.
  const double c = std::cos(view.azimuth), s = std::sin(view.azimuth);
  map.rotation.col(0) = Vec3(-s, c, 0.0);
  map.rotation.col(1) = Vec3(-c, -s, 0.0);
  map.rotation.col(2) = Vec3::UnitZ();
  map.device_centre = 0.5 * (info.workspace_low + info.workspace_high);
  map.cloth_centre = 0.5 * (view.low + view.high);
  const Mat3 back = map.rotation.transpose();
  map.scale = fitting_scale(back.cwiseAbs() * (view.high - view.low), info);
  return map;
}

DeviceHand::DeviceHand(HandDevice device, ViewSession& session, Time time)
    : device_(std::move(device)), session_(session), time_(time) {}

DeviceHand::~DeviceHand() { end(); }

void DeviceHand::begin(const SceneView& scene) {
  end();
  const DeviceInfo& info = device_.device->info();
  ForcePathOptions options = make_force_path_options(info);
  options.map = fit_workspace(scene, info);
  path_ = std::make_unique<ForcePath>(options);
  stiffness_ = std::clamp(most_hold_stiffness(info, options.map.scale, options.map.force_gain),
                          kLeastHoldStiffness, GraspSpec{}.stiffness);
  view_ = {};
  last_sample_ = {};
  marked_at_ = audited_at_ = work_ = stored_ = told_ = 0.0;
  marked_tick_ = 0;
  model_ = {};
  const SessionHand hand{device_.device.get(), path_.get()};
  HapticEnvironment& cloth = *this;
  HoldRule* rule = this;
  SessionListener* listener = this;
  if (time_ == Time::kVirtual) {
    VirtualSessionOptions virtual_options;
    virtual_options.listener = listener;
    virtual_ = std::make_unique<VirtualSession>(std::array{hand}, cloth, virtual_options);
    return;
  }
  pace_ = Pace(kViewStep, PacedThread::now_us());
  RealtimeOptions real;
  real.tick = 1.0 / std::clamp(info.rate, kLeastRate, kMostRate);
  real.cloth_period = kViewStep;
  // The cloth may take a core all for itself; the pictures need one, and whatever else runs.
  real.claim_cloth = std::thread::hardware_concurrency() > 2;
  running_ = std::make_unique<RunningSession>(std::array{hand}, cloth, real, rule, listener);
}

std::vector<std::string> DeviceHand::end() {
  std::vector<std::string> refused;
  if (running_) {
    const RealtimeReport& report = running_->end();
    if (report.overruns > 0) refused = report.refused;
  }
  if (virtual_ || running_) device_.device->write({});
  virtual_.reset();
  running_.reset();
  return refused;
}

void DeviceHand::tick(double wall_us) noexcept {
  wall_us_ = wall_us;
  if (!virtual_) return;
  path_->hold(holds(0, path_->time() + kViewStep, last_sample_));
  virtual_->tick(kViewStep);
}

bool DeviceHand::holds(std::size_t hand, double time, const DeviceSample& last) noexcept {
  return device_.holds->holds(hand, time, last);
}

bool DeviceHand::step_cloth(const DevicePose& at) noexcept {
  if (time_ == Time::kVirtual) return session_.tick(wall_us_, &at);
  bool did = false;
  for (int i = 0; i < kTicksAtOnce && pace_.due(PacedThread::now_us()); ++i) {
    const bool one = session_.tick(PacedThread::now_us(), &at);
    pace_.done(PacedThread::now_us(), one, speed_.load(std::memory_order_relaxed));
    did = did || one;
  }
  factor_.store(pace_.real_time_factor(), std::memory_order_relaxed);
  return did;
}

LocalModel DeviceHand::update(const ToolPose& pose, double /*dt*/, double /*next*/) noexcept {
  // A cloth that stands still does not answer: what it told last grows old, and the force fades.
  if (!step_cloth({pose.position, pose.holds, kHandReach, stiffness_})) return model_;
  const DeviceTouch touch = session_.device_touch();
  const LocalModel last = std::exchange(model_, begin_model(pose, model_.number + 1));
  model_.grasped = touch.reading.holds;
  if (touch.reading.holds) model_.force = touch.reading.force;
  if (last.number == 0 || pose.time - audited_at_ >= ClothHandOptions{}.audit_time)
    audit(pose, touch.disturbances);
  return model_;
}

// The books of the port stand against what the cloth stores. Where something else moved the cloth, the mouse
// or the scene's own hands, that is no measure, and the books are taken as even.
void DeviceHand::audit(const ToolPose& pose, std::uint64_t disturbances) noexcept {
  const double stored = session_.stored_energy();
  const WorkspaceMap& map = path_->map();
  told_ += disturbances == disturbances_ ? stored - stored_
                                         : map.scale / map.force_gain * (pose.ledger.work - work_);
  model_.stored_energy = told_;
  audited_at_ = pose.time;
  stored_ = stored;
  work_ = pose.ledger.work;
  disturbances_ = disturbances;
}

void DeviceHand::on_tick(const TickRecord& record) noexcept {
  last_sample_ = record.sample;
  view_.tool = record.tool;
  view_.force = record.tick.force.norm();
  view_.away = (record.tick.status & kForceDeviceAway) != 0;
  view_.faulted = (record.tick.status & kForceFaults) != 0;
  if (record.time - marked_at_ >= kRatePeriod) {
    view_.rate = static_cast<double>(record.number - marked_tick_) / (record.time - marked_at_);
    marked_at_ = record.time;
    marked_tick_ = record.number;
  }
  box_.put(view_);
}

DeviceView DeviceHand::look() noexcept {
  box_.fetch();
  DeviceView view = box_.value();
  if (running_) view.overruns = running_->overruns();
  return view;
}

}  // namespace fuai
