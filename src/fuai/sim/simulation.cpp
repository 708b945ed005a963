// A piece of cloth in time.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/sim/simulation.h"

#include <algorithm>

#include "fuai/core/error.h"
#include "fuai/core/hash.h"

namespace fuai {
namespace {

AttachmentRoom room_for(int grasps) {
  if (grasps < 0 || grasps > 64) throw Error(ErrorKind::kUsage, "a simulation takes 0 to 64 grasps");
  const auto count = static_cast<std::size_t>(grasps);
  return {count * kMostPatchSlots, count};
}

}  // namespace

ClothSimulation::ClothSimulation(const ClothModel& model, const ClothMaterial& material,
                                 const ClothSolverOptions& options, int most_grasps)
    : model_(std::make_unique<const ClothModel>(model)),
      material_(std::make_unique<const ClothMaterial>(material)),
      solver_(make_cloth_solver(*model_, *material_, options, room_for(most_grasps))),
      holds_(static_cast<std::size_t>(most_grasps)),
      attachments_(room_for(most_grasps).attachments),
      groups_(room_for(most_grasps).groups),
      gravity_(options.implicit.gravity) {
  for (int slot = 0; slot < model.slot_count(); ++slot)
    if (model.fixed[static_cast<std::size_t>(slot)] != 0) fixed_slots_.push_back(slot);
}

void ClothSimulation::restore(const ClothState& state) {
  for (Hold& hold : holds_) hold.active = false;
  solver_->restore(state);
}

SimulationReading ClothSimulation::read() const {
  ClothState state;
  solver_->save(state);
  SimulationReading reading;
  reading.energy = solver_->energy();
  reading.kinetic_energy = cloth_kinetic_energy(*model_, state);
  reading.max_strain = max_edge_strain(*model_, state);
  for (const Vec3& v : state.velocities) reading.max_speed = std::max(reading.max_speed, v.norm());
  reading.state_hash = state_hash(state);
  return reading;
}

double ClothSimulation::stored_energy(ClothState& scratch) const {
  solver_->save(scratch);
  double energy = cloth_free_energy(*model_, *material_, scratch, gravity_).total() +
                  cloth_kinetic_energy(*model_, scratch);
  for (const Hold& hold : holds_) {
    if (!hold.active) continue;
    const GraspSpec& spec = hold.grasp.spec();
    double springs = 0.0;
    Vec3 pull = Vec3::Zero();
    for (std::size_t i = 0; i < hold.grasp.size(); ++i) {
      const Vec3 gap = hold.grasp.target(i) - solver_->position(hold.grasp.slot(i));
      const double k = spec.stiffness * hold.grasp.weight(i);
      springs += 0.5 * k * gap.squaredNorm();
      pull += k * gap;
    }
    // Beyond its most force F the common part of the gap stores F gap - F^2 / 2K instead of K gap^2 / 2.
    const double force = pull.norm(), most = spec.most_force;
    if (force > most) springs -= 0.5 * (force - most) * (force - most) / spec.stiffness;
    energy += springs;
  }
  return energy;
}

int ClothSimulation::grasp(const GraspSpec& spec, const Vec3& hand) noexcept {
  GraspSpec grip = spec;
  if (!solver_->entry().spring_holds) grip.radius = 0.0;
  for (std::size_t i = 0; i < holds_.size(); ++i) {
    Hold& hold = holds_[i];
    if (hold.active) continue;
    hold.active = hold.grasp.take(*model_, grip, hand, [this](int slot) { return solver_->position(slot); });
    hold.stepped = false;
    return hold.active ? static_cast<int>(i) : -1;
  }
  return -1;
}

void ClothSimulation::move_grasp(int hold, const Vec3& hand, const Mat3& rotation) noexcept {
  if (hold < 0 || hold >= static_cast<int>(holds_.size()) || !hand.allFinite() || !rotation.allFinite())
    return;
  holds_[static_cast<std::size_t>(hold)].grasp.move(hand, rotation);
}

void ClothSimulation::release(int hold) noexcept {
  if (hold >= 0 && hold < static_cast<int>(holds_.size()))
    holds_[static_cast<std::size_t>(hold)].active = false;
}

const Grasp* ClothSimulation::held(int hold) const noexcept {
  if (hold < 0 || hold >= static_cast<int>(holds_.size())) return nullptr;
  const Hold& h = holds_[static_cast<std::size_t>(hold)];
  return h.active ? &h.grasp : nullptr;
}

std::optional<Vec2> ClothSimulation::free_cloth_near(const Vec3& place, double reach) const noexcept {
  double least = reach;
  std::optional<Vec2> nearest;
  for (int row = 0; row < model_->rows; ++row) {
    for (int column = 0; column < model_->columns; ++column) {
      const int slot = model_->slot(column, row);
      const auto i = static_cast<std::size_t>(slot);
      if (model_->live[i] == 0 || model_->fixed[i] != 0) continue;
      const double far = (position(slot) - place).norm();
      if (!(far <= least)) continue;
      least = far;
      nearest = model_->material(column, row);
    }
  }
  return nearest;
}

int ClothSimulation::take_over(const Grasp& grasp) noexcept {
  for (int hold = 0; hold < static_cast<int>(holds_.size()); ++hold)
    if (take_over_as(hold, grasp)) return hold;
  return -1;
}

bool ClothSimulation::take_over_as(int hold, const Grasp& grasp) noexcept {
  if (hold < 0 || hold >= static_cast<int>(holds_.size())) return false;
  Hold& h = holds_[static_cast<std::size_t>(hold)];
  if (h.active) return false;
  h.grasp = grasp;
  h.active = true;
  h.stepped = false;
  return true;
}

GraspReading ClothSimulation::grasp_reading(int hold) const noexcept {
  GraspReading reading;
  if (hold < 0 || hold >= static_cast<int>(holds_.size())) return reading;
  const Hold& h = holds_[static_cast<std::size_t>(hold)];
  reading.holds = h.active;
  if (!h.active) return reading;
  for (std::size_t i = 0; i < h.grasp.size(); ++i)
    reading.centre += h.grasp.weight(i) * solver_->position(h.grasp.slot(i));
  if (!h.stepped) return reading;
  const HoldForce on_cloth = solver_->hold_force(h.group);
  reading.force = -on_cloth.force;
  reading.moment = -on_cloth.moment;
  reading.saturated = on_cloth.share < 1.0;
  return reading;
}

void ClothSimulation::attach_holds() noexcept {
  std::size_t springs = 0, groups = 0;
  for (Hold& hold : holds_) {
    if (!hold.active) continue;
    hold.grasp.follow([this](int slot) { return solver_->position(slot); });
    const GraspSpec& spec = hold.grasp.spec();
    for (std::size_t i = 0; i < hold.grasp.size(); ++i)
      attachments_[springs++] = {hold.grasp.slot(i), spec.stiffness * hold.grasp.weight(i),
                                 hold.grasp.target(i)};
    hold.group = groups;
    hold.stepped = true;
    groups_[groups++] = {hold.grasp.size(), spec.most_force, hold.grasp.centre()};
  }
  solver_->attach({attachments_.data(), springs}, {groups_.data(), groups});
}

StepReport ClothSimulation::step(double dt) noexcept {
  attach_holds();
  return solver_->step(dt);
}

Vec3 ClothSimulation::clamp_force() const noexcept {
  Vec3 sum = Vec3::Zero();
  for (int slot : fixed_slots_) sum += solver_->force_on_fixed(slot);
  return sum;
}

std::uint64_t state_hash(const ClothState& state) noexcept {
  StateHash hash;
  for (const auto* field : {&state.positions, &state.velocities, &state.accelerations})
    for (const Vec3& v : *field) hash.add(v.data(), 3 * sizeof(double));
  for (const auto* memory :
       {&state.weft_bending, &state.warp_bending, &state.shear, &state.weft_tension, &state.warp_tension})
    for (const PlayState& play : *memory) hash.add(std::span<const double>(play.position));
  return hash.value();
}

double max_edge_strain(const ClothModel& model, const ClothState& state) noexcept {
  double largest = 0.0;
  const auto edge = [&](const std::vector<double>& areas, std::size_t slot, std::size_t next) {
    if (!(areas[slot] > 0.0)) return;
    const double strain = (state.positions[next] - state.positions[slot]).norm() / model.spacing - 1.0;
    largest = std::max(largest, strain);
  };
  const auto up = static_cast<std::size_t>(model.columns);
  for (std::size_t slot = 0; slot < state.positions.size(); ++slot) {
    edge(model.weft_edge_area, slot, slot + 1);
    edge(model.warp_edge_area, slot, slot + up);
  }
  return largest;
}

}  // namespace fuai
