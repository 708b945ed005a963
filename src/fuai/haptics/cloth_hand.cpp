// Cloth in the hand.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/cloth_hand.h"

#include <algorithm>
#include <cmath>

#include "fuai/core/error.h"

namespace fuai {

ImplicitOptions make_felt_options(const ImplicitOptions& scene) {
  ImplicitOptions options = scene;
  options.linearisations = 8;
  options.relinearise = 0.002;
  return options;
}

ClothHand::ClothHand(const ClothModel& model, const ClothMaterial& material, const ClothSolverOptions& solver,
                     const ClothState& start, const GraspSpec& grasp, const ClothHandOptions& options)
    : simulation_(model, material, solver),
      twin_(options.tangent ? std::make_unique<ClothSimulation>(model, material, solver, 1) : nullptr),
      grasp_(grasp),
      options_(options),
      state_(start),
      trust_(options.most_trust) {
  if (!(options.probe > 0.0) || !(options.audit_time >= 0.0) || !(options.least_trust > 0.0) ||
      !(options.most_trust >= options.least_trust))
    throw Error(ErrorKind::kUsage, "cloth in the hand: probe and trust radius must be positive");
  simulation_.restore(start);
  // A grip only to learn where the patch is; the first pose takes hold wherever the tool then is, so that
  // nothing is pulled by where the encoder's step happens to lie.
  hold_ = simulation_.grasp(grasp_, Vec3::Zero());
  if (hold_ < 0) throw Error(ErrorKind::kUsage, "there is no cloth where the hand is to grip");
  start_ = patch();
  simulation_.release(hold_);
  hold_ = -1;
  // Makes room for whatever a step copies out; what a solver carries appears after its first step only.
  state_.carried.reserve(64);
  simulation_.stored_energy(state_);
}

Vec3 ClothHand::patch() const noexcept {
  return hold_ < 0 ? start_ : simulation_.grasp_reading(hold_).centre;
}

void ClothHand::grip(const ToolPose& pose) noexcept {
  if (pose.holds && hold_ < 0) hold_ = simulation_.grasp(grasp_, pose.position);
  if (!pose.holds) {
    simulation_.release(hold_);
    hold_ = -1;
  }
}

LocalModel ClothHand::update(const ToolPose& pose, double dt, double next) noexcept {
  grip(pose);
  simulation_.move_grasp(hold_, pose.position);
  const StepReport report = simulation_.step(dt);
  failed_steps_ += (report.status & StepReport::kNotFinite) != 0 ? 1 : 0;
  LocalModel model = begin_model(pose, ++number_);
  const GraspReading reading = simulation_.grasp_reading(hold_);
  model.grasped = reading.holds;
  if (reading.holds) model.force = reading.force;
  since_audit_ += dt;
  if (since_audit_ >= options_.audit_time * (1.0 - 1e-9)) {
    since_audit_ = 0.0;
    model.stored_energy = simulation_.stored_energy(state_);
  }
  if (twin_ && reading.holds) {
    probe(pose, next, model);
    model.trust_radius = trust(model);
  }
  last_ = model;
  return model;
}

Vec3 ClothHand::twin_force(const Vec3& hand, double dt) noexcept {
  twin_->restore(state_);
  const int hold = twin_->take_over(*simulation_.held(hold_));
  twin_->move_grasp(hold, hand);
  twin_->step(dt);
  return twin_->grasp_reading(hold).force;
}

void ClothHand::probe(const ToolPose& pose, double next, LocalModel& model) noexcept {
  simulation_.snapshot(state_);
  model.origin_velocity = pose.velocity;
  model.horizon = options_.horizon * next;
  const Vec3 ahead = pose.position + next * pose.velocity;
  model.force_rate = (twin_force(ahead, next) - model.force) / next;
  Mat3 stiffness;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 off = options_.probe * Vec3::Unit(axis);
    stiffness.col(axis) =
        (twin_force(ahead - off, next) - twin_force(ahead + off, next)) / (2.0 * options_.probe);
  }
  model.stiffness = make_passive(stiffness, grasp_.stiffness);
}

// The last model was off by e at a distance d. What a straight line misses goes with d^2, so the allowed
// error is met at d sqrt(allowed / e).
double ClothHand::trust(const LocalModel& model) noexcept {
  if (last_.number == 0 || !last_.grasped) return trust_;
  const double error =
      (model.force - model_force(last_, model.origin, last_.origin_velocity, model.time)).norm();
  const double far = (model.origin - expected_position(last_, model.time)).norm();
  const double allowed = std::max(options_.error_force, options_.error_share * model.force.norm());
  const double wanted = error > 0.0 ? far * std::sqrt(allowed / error) : options_.most_trust;
  // A hand that hardly moved tells nothing: the radius then opens slowly.
  trust_ = std::clamp(std::max(wanted, far < options_.probe ? 1.1 * trust_ : wanted), options_.least_trust,
                      options_.most_trust);
  return trust_;
}

}  // namespace fuai
