// What tools meet: something that answers poses with local models. Cloth, or a wall to try devices on.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "fuai/haptics/local_model_rt.h"

namespace fuai {

/// Answers poses. One thread calls it: the cloth's.
class HapticEnvironment {
 public:
  HapticEnvironment() = default;
  HapticEnvironment(const HapticEnvironment&) = delete;
  HapticEnvironment& operator=(const HapticEnvironment&) = delete;
  virtual ~HapticEnvironment() = default;

  /// Goes on by dt to the moment of the pose. @param dt [s], > 0 @param next how long the model will serve
  /// [s] Thread class: real-time.
  virtual LocalModel update(const ToolPose& pose, double dt, double next) noexcept = 0;

  /// How many hands it answers. Thread class: any.
  virtual std::size_t hands() const noexcept { return 1; }
  /// The same for all hands at once. @param poses one a hand (hands) @param models their answers, all of one
  /// number (hands). Thread class: real-time.
  virtual void update_all(std::span<const ToolPose> poses, double dt, double next,
                          std::span<LocalModel> models) noexcept {
    models[0] = update(poses[0], dt, next);
  }
  /// Hash of everything that the next answer depends on; 0 when it has none. Thread class: real-time.
  virtual std::uint64_t state_hash() noexcept { return 0; }
};

/// A model's share that every environment fills alike: number, time, place, ledger.
inline LocalModel begin_model(const ToolPose& pose, std::uint64_t number) noexcept {
  LocalModel model;
  model.number = number;
  model.time = pose.time;
  model.origin = pose.position;
  model.ledger = pose.ledger;
  return model;
}

/// A spring about a point, felt on both sides: the wall of the textbooks.
class SpringWall final : public HapticEnvironment {
 public:
  /// How its force reaches the device.
  enum class Answer {
    kHeld,     ///< the force alone, as a slow simulation without a tangent gives it
    kTangent,  ///< force, stiffness and damping
  };
  /// @param stiffness [N/m] @param damping [N s/m] @param centre [m]
  SpringWall(double stiffness, double damping, const Vec3& centre, Answer answer) noexcept
      : stiffness_(stiffness), damping_(damping), centre_(centre), answer_(answer) {}

  LocalModel update(const ToolPose& pose, double /*dt*/, double /*next*/) noexcept override {
    LocalModel model = begin_model(pose, ++number_);
    const Vec3 d = pose.position - centre_;
    model.grasped = true;
    model.stored_energy = 0.5 * stiffness_ * d.squaredNorm();
    if (answer_ == Answer::kHeld) {
      model.force = -stiffness_ * d - damping_ * pose.velocity;
      return model;
    }
    // The damper's force at the origin belongs to the origin's velocity, which is taken as zero.
    model.force = -stiffness_ * d;
    model.stiffness = stiffness_ * Mat3::Identity();
    model.damping = damping_ * Mat3::Identity();
    return model;
  }

 private:
  double stiffness_, damping_;
  Vec3 centre_;
  Answer answer_;
  std::uint64_t number_ = 0;
};

}  // namespace fuai
