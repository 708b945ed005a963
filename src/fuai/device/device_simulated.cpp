// The simulated device in time.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/device_simulated.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fuai/core/error.h"

namespace fuai {
namespace {

constexpr double kSubstep = 50e-6;  ///< [s]; the stiffest pair here, 5 kN/m on 45 g, turns in 19 ms

void check(const SimulatedDeviceSpec& spec) {
  const auto require = [](bool fine, const char* what) {
    if (!fine) throw Error(ErrorKind::kUsage, std::string("simulated device: ") + what);
  };
  const DeviceInfo& info = spec.info;
  require(info.mass > 0.0, "its mass must be positive");
  require(info.rate > 0.0, "its rate must be positive");
  require(info.peak_force >= 0.0 && info.continuous_force > 0.0 && info.thermal_time > 0.0,
          "its forces must not be negative, and its continuous force and thermal time positive");
  require(info.resolution >= 0.0 && spec.damping >= 0.0 && spec.friction >= 0.0,
          "resolution, damping and friction must not be negative");
  require(spec.delay >= 0.0 && spec.delay <= kMostDelay, "its delay must be 0 to 20 ms");
  require((info.workspace_high - info.workspace_low).minCoeff() > 0.0, "its workspace must not be empty");
}

}  // namespace

SimulatedDevice::SimulatedDevice(const SimulatedDeviceSpec& spec, const HandModel& hand,
                                 std::unique_ptr<const HandMotion> motion)
    : spec_(spec),
      hand_(hand),
      motion_(std::move(motion)),
      heat_(spec.info.peak_force, spec.info.continuous_force, spec.info.thermal_time) {
  check(spec);
  position_ = motion_ ? motion_->at(0.0).position : Vec3(Vec3::Zero());
  read();
}

DeviceSample SimulatedDevice::read() noexcept {
  if (!connected_) {
    last_.status = kDeviceDisconnected;
    return last_;
  }
  last_.time = time_;
  last_.position = position_;
  if (spec_.info.resolution > 0.0)
    last_.position = (position_ / spec_.info.resolution).array().round() * spec_.info.resolution;
  last_.status = (saturated_ ? kDeviceSaturated : kDeviceReady) | (warm_ ? kDeviceWarm : kDeviceReady);
  const double timeout = spec_.info.command_timeout;
  if (timeout > 0.0 && time_ - last_command_ > timeout) last_.status |= kDeviceTimedOut;
  return last_;
}

void SimulatedDevice::write(const DeviceCommand& command) noexcept {
  if (!connected_) return;
  last_command_ = time_;
  const Vec3 force = force_within(command, spec_.info.peak_force, saturated_);
  if (spec_.delay <= 0.0) {
    commanded_ = force;
    return;
  }
  // A queue that is full forgets its oldest command, which the next would have replaced.
  if (count_ == queue_.size()) {
    commanded_ = queue_[first_].force;
    first_ = (first_ + 1) % queue_.size();
    --count_;
  }
  queue_[(first_ + count_) % queue_.size()] = {time_ + spec_.delay, force};
  ++count_;
}

Vec3 SimulatedDevice::motor_force() noexcept {
  while (count_ > 0 && queue_[first_].time <= time_ + 1e-9) {
    commanded_ = queue_[first_].force;
    first_ = (first_ + 1) % queue_.size();
    --count_;
  }
  const double timeout = spec_.info.command_timeout;
  if (!connected_ || (timeout > 0.0 && time_ - last_command_ > timeout)) return Vec3::Zero();
  const double most = heat_.most_force(), asked = commanded_.norm();
  warm_ = asked > most;
  return warm_ ? Vec3(most / asked * commanded_) : commanded_;
}

void SimulatedDevice::stop_at_walls() noexcept {
  for (int i = 0; i < 3; ++i) {
    const double inside = std::clamp(position_[i], spec_.info.workspace_low[i], spec_.info.workspace_high[i]);
    if (inside == position_[i]) continue;
    position_[i] = inside;
    velocity_[i] = 0.0;
  }
}

void SimulatedDevice::substep(double dt) noexcept {
  given_ = motor_force();
  heat_.advance(given_.norm(), dt);
  const double mass = spec_.info.mass + hand_.mass;
  const HandTarget target = motion_ ? motion_->at(time_) : HandTarget{};
  const Vec3 before = position_, start = velocity_;
  // Springs and motors at the old place, dampers at the new speed.
  const Vec3 force =
      given_ + push_ + hand_.stiffness * (target.position - position_) + hand_.damping * target.velocity;
  velocity_ = (mass * velocity_ + dt * force) / (mass + dt * (spec_.damping + hand_.damping));
  // Coulomb friction takes what it can of the momentum and no more: it never pushes back.
  const double speed = velocity_.norm(), least = dt * spec_.friction / mass;
  velocity_ = speed > least ? Vec3((1.0 - least / speed) * velocity_) : Vec3(Vec3::Zero());
  // By the mean speed, which is exact for a force that is held: the new speed would anticipate half a substep
  // and render walls 5 % stiffer than they can be.
  position_ += 0.5 * dt * (start + velocity_);
  stop_at_walls();
  work_ -= given_.dot(position_ - before);
  time_ += dt;
}

void SimulatedDevice::advance(double dt) noexcept {
  const double parts = std::max(1.0, std::ceil(dt / kSubstep - 1e-6));
  const auto count = static_cast<int>(parts);
  for (int i = 0; i < count; ++i) substep(dt / parts);
}

void SimulatedDevice::set_connected(bool connected) noexcept {
  connected_ = connected;
  commanded_ = Vec3::Zero();
  count_ = 0;
  last_command_ = time_;
}

void SimulatedDevice::place(const Vec3& position) noexcept {
  position_ = position;
  velocity_ = Vec3::Zero();
}

}  // namespace fuai
