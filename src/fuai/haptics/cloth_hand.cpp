// Cloth in the hands.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/cloth_hand.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fuai/core/error.h"

namespace fuai {

ClothHand::ClothHand(const ClothModel& model, const ClothMaterial& material, const ClothSolverOptions& solver,
                     const ClothState& start, std::span<const GraspSpec> grasps,
                     const ClothHandOptions& options)
    : simulation_(model, material, solver, static_cast<int>(kMostSessionHands)),
      twin_(options.tangent ? std::make_unique<ClothSimulation>(model, material, solver,
                                                                static_cast<int>(kMostSessionHands))
                            : nullptr),
      options_(options),
      hands_(grasps.size()),
      state_(start) {
  if (grasps.empty() || grasps.size() > kMostSessionHands)
    throw Error(ErrorKind::kUsage, "cloth is held by 1 to " + std::to_string(kMostSessionHands) + " hands");
  if (!(options.probe > 0.0) || !(options.audit_time >= 0.0) || !(options.least_trust > 0.0) ||
      !(options.most_trust >= options.least_trust) || !(options.reach >= 0.0))
    throw Error(ErrorKind::kUsage,
                "cloth in the hand: probe and trust radius must be positive, the reach not negative");
  simulation_.restore(start);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Hand& hand = hands_[i];
    hand.grasp = grasps[i];
    hand.trust = options.most_trust;
    // A grip only to learn where the patch is; the first pose takes hold wherever the tool then is, so that
    // nothing is pulled by where the encoder's step happens to lie.
    hand.hold = simulation_.grasp(hand.grasp, Vec3::Zero());
    if (hand.hold < 0) throw Error(ErrorKind::kUsage, "there is no cloth where the hand is to grip");
    hand.start = patch(i);
    simulation_.release(hand.hold);
    hand.hold = -1;
  }
  // Makes room for whatever a step copies out; what a solver carries appears after its first step only.
  state_.carried.reserve(64);
  stored_ = simulation_.stored_energy(state_);
}

Vec3 ClothHand::patch(std::size_t hand) const noexcept {
  const Hand& h = hands_[hand];
  return h.hold < 0 ? h.start : simulation_.grasp_reading(h.hold).centre;
}

std::uint64_t ClothHand::state_hash() noexcept {
  simulation_.snapshot(state_);
  return fuai::state_hash(state_);
}

void ClothHand::grip(Hand& hand, const ToolPose& pose) noexcept {
  if (!pose.holds) {
    simulation_.release(hand.hold);
    hand.hold = -1;
    return;
  }
  if (hand.hold >= 0) return;
  if (options_.reach > 0.0) {
    const std::optional<Vec2> near = simulation_.free_cloth_near(pose.position, options_.reach);
    if (!near) return;
    hand.grasp.centre = *near;
  }
  hand.hold = simulation_.grasp(hand.grasp, pose.position);
  hand.tool = pose.position;
}

LocalModel ClothHand::update(const ToolPose& pose, double dt, double next) noexcept {
  LocalModel model;
  if (hands_.size() == 1) update_all({&pose, 1}, dt, next, {&model, 1});
  return model;
}

void ClothHand::update_all(std::span<const ToolPose> poses, double dt, double next,
                           std::span<LocalModel> models) noexcept {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    grip(hands_[i], poses[i]);
    simulation_.move_grasp(hands_[i].hold, poses[i].position);
  }
  const StepReport report = simulation_.step(dt);
  failed_steps_ += (report.status & StepReport::kNotFinite) != 0 ? 1 : 0;
  ++number_;
  bool held = false;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Hand& hand = hands_[i];
    models[i] = begin_model(poses[i], number_);
    const GraspReading reading = simulation_.grasp_reading(hand.hold);
    models[i].grasped = reading.holds;
    if (!reading.holds) continue;
    held = true;
    models[i].force = reading.force;
    hand.work -= reading.force.dot(poses[i].position - hand.tool);
    hand.tool = poses[i].position;
  }
  since_audit_ += dt;
  if (since_audit_ >= options_.audit_time * (1.0 - 1e-9)) {
    since_audit_ = 0.0;
    audit(models);
  }
  if (twin_ && held) probe(poses, next, models);
  for (std::size_t i = 0; i < hands_.size(); ++i) hands_[i].last = models[i];
}

// Each hand keeps books of its own port, so each is told a share of the stored energy: what it put in itself,
// less its part of what got lost on the way. The shares' changes add up to the change of the whole, so no
// energy is promised twice, however roughly the work of a hand is known.
void ClothHand::audit(std::span<LocalModel> models) noexcept {
  const double stored = simulation_.stored_energy(state_);
  if (hands_.size() == 1) {
    models[0].stored_energy = stored;
    return;
  }
  double work = 0.0;
  for (const Hand& hand : hands_) work += hand.work;
  const double lost = (work - (stored - stored_)) / static_cast<double>(hands_.size());
  stored_ = stored;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    hands_[i].stored += hands_[i].work - lost;
    hands_[i].work = 0.0;
    models[i].stored_energy = hands_[i].stored;
  }
}

// The step that will come, every hand where it is expected, one of them beside it.
void ClothHand::run_twin(std::span<const ToolPose> poses, double next, std::size_t moved,
                         const Vec3& off) noexcept {
  twin_->restore(state_);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const Grasp* grasp = simulation_.held(hands_[i].hold);
    twin_holds_[i] = grasp != nullptr ? twin_->take_over(*grasp) : -1;
    Vec3 place = poses[i].position + next * poses[i].velocity;
    if (i == moved) place += off;
    twin_->move_grasp(twin_holds_[i], place);
  }
  twin_->step(next);
}

void ClothHand::probe(std::span<const ToolPose> poses, double next, std::span<LocalModel> models) noexcept {
  simulation_.snapshot(state_);
  run_twin(poses, next, hands_.size(), Vec3::Zero());
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    LocalModel& model = models[i];
    if (!model.grasped) continue;
    model.origin_velocity = poses[i].velocity;
    model.horizon = options_.horizon * next;
    model.force_rate = (twin_->grasp_reading(twin_holds_[i]).force - model.force) / next;
  }
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    LocalModel& model = models[i];
    if (!model.grasped) continue;
    Mat3 stiffness;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 off = options_.probe * Vec3::Unit(axis);
      run_twin(poses, next, i, -off);
      const Vec3 before = twin_->grasp_reading(twin_holds_[i]).force;
      run_twin(poses, next, i, off);
      stiffness.col(axis) = (before - twin_->grasp_reading(twin_holds_[i]).force) / (2.0 * options_.probe);
    }
    model.stiffness = make_passive(stiffness, hands_[i].grasp.stiffness);
    model.trust_radius = find_trust(hands_[i], model);
  }
}

// The last model was off by e at a distance d. What a straight line misses goes with d^2, so the allowed
// error is met at d sqrt(allowed / e).
double ClothHand::find_trust(Hand& hand, const LocalModel& model) noexcept {
  const LocalModel& last = hand.last;
  if (last.number == 0 || !last.grasped) return hand.trust;
  const double error =
      (model.force - model_force(last, model.origin, last.origin_velocity, model.time)).norm();
  const double far = (model.origin - expected_position(last, model.time)).norm();
  const double allowed = std::max(options_.error_force, options_.error_share * model.force.norm());
  const double wanted = error > 0.0 ? far * std::sqrt(allowed / error) : options_.most_trust;
  // A hand that hardly moved tells nothing: the radius then opens slowly.
  hand.trust = std::clamp(std::max(wanted, far < options_.probe ? 1.1 * hand.trust : wanted),
                          options_.least_trust, options_.most_trust);
  return hand.trust;
}

}  // namespace fuai
