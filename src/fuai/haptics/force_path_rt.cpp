// The force path.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/force_path_rt.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fuai/core/error.h"

namespace fuai {
namespace {

const Vec3 kNowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());

void check(const ForcePathOptions& o) {
  const auto require = [](bool fine, const char* what) {
    if (!fine) throw Error(ErrorKind::kUsage, std::string("force path: ") + what);
  };
  require(o.map.scale > 0.0 && std::isfinite(o.map.scale), "the scale must be positive");
  require(o.map.force_gain > 0.0 && std::isfinite(o.map.force_gain), "the force gain must be positive");
  require(o.map.rotation.isUnitary(1e-9), "the rotation must be one");
  require(o.velocity_cutoff > 0.0, "the velocity cut-off must be positive");
  require(o.stable_stiffness > 0.0, "the device's stiffness must be positive");
  require(o.damping >= 0.0 && o.blend >= 0.0, "damping and blend must not be negative");
  require(o.passivity.mass > 0.0 && o.passivity.payback > 0.0 && o.passivity.reserve >= 0.0 &&
              o.passivity.tolerance >= 0.0,
          "mass and payback must be positive, reserve and tolerance not negative");
  require(o.safety.most_force >= 0.0 && o.safety.continuous_force > 0.0 && o.safety.thermal_time > 0.0,
          "the force limits must not be negative, continuous force and thermal time positive");
  require(o.safety.most_rate > 0.0 && o.safety.most_step > 0.0 && o.safety.most_power > 0.0 &&
              o.safety.ramp > 0.0 && o.safety.fade_ends > o.safety.fade_begins,
          "rate, step, power and ramp must be positive, and the fading must take time");
}

}  // namespace

ForcePathOptions make_force_path_options(const DeviceInfo& info) {
  ForcePathOptions options;
  options.safety = make_safety_options(info);
  if (!(info.peak_force > 0.0)) {  // an input: nothing is given, so nothing can be too much
    options.safety.continuous_force = SafetyOptions{}.continuous_force;
    return options;
  }
  options.passivity.mass = info.mass;
  options.stable_stiffness = info.stable_stiffness;
  return options;
}

ForcePath::ForcePath(const ForcePathOptions& options)
    : options_(options),
      filter_(options.velocity_cutoff),
      passivity_(options.passivity),
      limiter_(options.safety),
      position_(kNowhere) {
  check(options);
  tool_ = options.map.cloth_centre;
}

bool ForcePath::accept(const DeviceSample& sample, double dt) noexcept {
  if (!(dt > 0.0) || !(dt <= options_.safety.longest_tick)) {
    status_ |= kForceLate;
    ++counters_.late;
    return false;
  }
  if ((sample.status & (kDeviceDisconnected | kDeviceUncalibrated | kDeviceForceOff)) != 0) {
    status_ |= kForceDeviceAway;
    return false;
  }
  if (!limiter_.is_good(sample, position_, dt)) {
    status_ |= kForceSampleBad;
    ++counters_.bad_samples;
    return false;
  }
  return true;
}

ToolPose ForcePath::follow(const DeviceSample& sample, double dt) noexcept {
  ++counters_.ticks;
  status_ = kForceFine;
  // A second is as good as a week, and no broken clock may carry time_ to where a tick is lost in rounding.
  dt_ = std::isfinite(dt) && dt > 0.0 ? std::min(dt, 1.0) : 0.0;
  time_ += dt_;
  good_ = accept(sample, dt);
  ToolPose pose;
  pose.time = time_;
  pose.holds = holds_;
  pose.position = tool_;
  pose.ledger = passivity_.ledger();
  if (!good_) {
    // Begin anew with the next good sample, wherever it is.
    position_ = kNowhere;
    filter_.restart();
    passivity_.restart();
    limiter_.restart();
    return pose;
  }
  position_ = sample.position;
  velocity_ = filter_.update(position_, dt);
  if (sample.velocity.allFinite()) velocity_ = sample.velocity;
  passivity_.move(position_);
  pose.ledger = passivity_.ledger();
  if (clutched_) return pose;
  if (closing_) {
    options_.map.close_clutch(tool_, position_);
    // The model as it was lies elsewhere on the device now.
    coupled_ = couple(options_.map.to_device(model_), options_.stable_stiffness);
    blend_left_ = 0.0;
    closing_ = false;
  }
  // The tool is ahead of the device by what the coupling gives way.
  const Vec3 pull = coupled_.compliance > 0.0
                        ? Vec3(coupled_.compliance * model_force(coupled_.model, position_, velocity_, time_))
                        : Vec3(Vec3::Zero());
  tool_ = options_.map.to_tool(position_ + pull);
  pose.position = tool_;
  pose.velocity = options_.map.way_to_tool(velocity_);
  return pose;
}

void ForcePath::take_model() noexcept {
  if (!models_.fetch()) return;
  ++counters_.models;
  const LocalModel& model = models_.value();
  if (!is_finite(model) || !(model.force.norm() < options_.safety.absurd_force)) {
    limiter_.latch(kForceFaultModel);
    return;
  }
  const Vec3 shown = blended_force();
  model_ = model;
  const bool first = coupled_.model.number == 0;
  coupled_ = couple(options_.map.to_device(model), options_.stable_stiffness);
  passivity_.audit(coupled_.model, gain_);
  // The hand goes on feeling what it felt; the difference fades. A model without stiffness comes from a cloth
  // that keeps up, and a blend would only make it late: 4 ms cost nine tenths of the stiffest wall.
  blend_left_ = 0.0;
  if (!good_ || first || coupled_.model.stiffness.isZero(0.0)) return;
  blend_force_ = shown - model_force(coupled_.model, position_, velocity_, time_);
  blend_left_ = options_.blend;
}

Vec3 ForcePath::blended_force() const noexcept {
  if (!good_) return Vec3::Zero();
  const double share = options_.blend > 0.0 ? blend_left_ / options_.blend : 0.0;
  return model_force(coupled_.model, position_, velocity_, time_) + share * blend_force_;
}

ForceTick ForcePath::render() noexcept {
  blend_left_ = std::max(0.0, blend_left_ - dt_);
  take_model();
  ForceTick tick;
  tick.model = coupled_.model.number;
  tick.model_age = tick.model > 0 ? std::max(0.0, time_ - coupled_.model.time) : 0.0;
  std::uint32_t& status = status_;
  if (tick.model == 0) status |= kForceNoModel;
  if (clutched_) status |= kForceClutched;
  if (!good_ || clutched_ || tick.model == 0) {
    limiter_.restart();
    limiter_.cut(dt_);
    gain_ = 0.0;
  } else {
    gain_ = limiter_.gain(tick.model_age, dt_, status);
    if (!is_trusted(coupled_.model, position_, time_)) {
      status |= kForceUntrusted;
      ++counters_.untrusted;
    }
    tick.model_force = model_force(coupled_.model, position_, velocity_, time_);
    passivity_.expect(gain_ * tick.model_force);
    const Vec3 brake = passivity_.brake(velocity_, dt_);
    if (brake != Vec3::Zero()) {
      status |= kForceBraked;
      ++counters_.braked;
    }
    const Vec3 asked = gain_ * (blended_force() - options_.damping * velocity_) + brake;
    tick.force = limiter_.limit(asked, velocity_, gain_, dt_, status);
  }
  if (good_) passivity_.give(tick.force);
  tick.gain = gain_;
  tick.energy = passivity_.energy();
  tick.status = status | limiter_.faults();
  return tick;
}

void ForcePath::open_clutch(bool open) noexcept {
  closing_ = closing_ || (clutched_ && !open);
  clutched_ = open;
}

}  // namespace fuai
