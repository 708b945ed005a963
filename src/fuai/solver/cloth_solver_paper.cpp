// Runs the paper's descent by the tick.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", Eq. (6).
#include "fuai/solver/cloth_solver_paper.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "fuai/core/error.h"

namespace fuai {
namespace {

std::size_t at(int slot) noexcept { return static_cast<std::size_t>(slot); }

/// Areas agree to rounding of the outline.
constexpr double kWholeCell = 1e-6;

/// @throws Error (kUsage) unless every cell is whole.
void check_whole(const ClothModel& model) {
  const double square = model.spacing * model.spacing;
  bool whole = model.columns >= 3 && model.rows >= 3;
  for (int row = 0; row + 1 < model.rows; ++row)
    for (int column = 0; column + 1 < model.columns; ++column)
      whole = whole && std::abs(model.cell_area[at(model.slot(column, row))] / square - 1.0) < kWholeCell;
  if (whole) return;
  throw Error(
      ErrorKind::kUsage,
      "the paper's solver knows rectangles of whole cells only, 3 x 3 nodes or more, and this piece is "
      "none",
      {"", 0, 0, "solver"}, "take a spacing that divides its sides, or another solver");
}

LatticeModel lattice_of(const ClothModel& model) {
  check_whole(model);
  LatticeSpec spec;
  spec.columns = model.columns;
  spec.rows = model.rows;
  spec.spacing = model.spacing;
  spec.areal_mass = model.areal_mass;
  for (int slot = 0; slot < model.slot_count(); ++slot)
    if (model.fixed[at(slot)] != 0) spec.fixed_nodes.push_back(slot);
  return make_lattice_model(spec);
}

FabricLaws laws_of(const ClothModel& model, const ClothMaterial& material) {
  FabricLaws laws;
  laws.areal_mass = model.areal_mass;
  laws.bending[static_cast<std::size_t>(Direction::kWarp)] = material.warp_bending;
  laws.bending[static_cast<std::size_t>(Direction::kWeft)] = material.weft_bending;
  return laws;
}

/// The memory of a triple in a state of the engine.
template <class State>
auto& memory_of(State& state, const LatticeTriple& triple) {
  return (triple.direction == Direction::kWeft ? state.weft_bending : state.warp_bending)[at(triple.middle)];
}

bool is_finite(const LatticeState& state) noexcept {
  return std::ranges::all_of(state.positions, [](const Vec3& x) { return x.allFinite(); });
}

}  // namespace

ClothSolverPaper::ClothSolverPaper(const ClothModel& model, const ClothMaterial& material,
                                   const ImplicitOptions& options, int steps, const AttachmentRoom& room)
    : laws_(laws_of(model, material)), lattice_(lattice_of(model)), hold_forces_(room.groups) {
  if (steps < 0 || !options.wind.isZero(0.0)) {
    throw Error(ErrorKind::kUsage,
                steps < 0 ? "a tick of the paper's solver cannot have " + std::to_string(steps) + " steps"
                          : "the paper's solver knows no air, and there is wind");
  }
  if (steps > 0) steps_ = steps;
  RelaxationOptions relaxation;
  relaxation.gravity = options.gravity;
  solver_.prepare(lattice_, laws_, relaxation);
  groups_.resize(room.groups);
  places_.assign(at(model.slot_count()), -1);
  mobile_.assign(at(model.slot_count()), 1);
  for (int slot = 0; slot < model.slot_count(); ++slot) {
    if (model.fixed[at(slot)] == 0) continue;
    mobile_[at(slot)] = 0;
    places_[at(slot)] = static_cast<int>(guided_.size());
    guided_.push_back({slot});
  }
  fixed_count_ = guided_.size();
  guided_.resize(fixed_count_ + room.attachments);
  state_ = before_ = make_lattice_state(lattice_);
  restore(make_cloth_state(model));
}

void ClothSolverPaper::restore(const ClothState& state) {
  other_ = state;
  other_.carried.clear();
  std::ranges::fill(other_.accelerations, Vec3::Zero());  // known to the implicit steps only
  attach({}, {});
  state_.positions = state.positions;
  for (std::size_t i = 0; i < lattice_.triples.size(); ++i)
    state_.memory[i] = memory_of(state, lattice_.triples[i]);
  for (std::size_t i = 0; i < fixed_count_; ++i) guided_[i].to = state.positions[at(guided_[i].slot)];
  time_ = state.time;
  solver_.compute_forces(state_);
}

void ClothSolverPaper::save(ClothState& state) const {
  state = other_;
  state.positions = state_.positions;
  std::fill(state.velocities.begin(), state.velocities.end(), Vec3::Zero());
  for (std::size_t i = 0; i < lattice_.triples.size(); ++i)
    memory_of(state, lattice_.triples[i]) = state_.memory[i];
  state.time = time_;
}

void ClothSolverPaper::place(int slot, const Vec3& position) noexcept {
  if (places_[at(slot)] >= 0) guided_[at(places_[at(slot)])].to = position;
}

void ClothSolverPaper::attach(std::span<const Attachment> attachments,
                              std::span<const AttachmentGroup> groups) noexcept {
  for (std::size_t i = 0; i < held_count_; ++i) mobile_[at(guided_[fixed_count_ + i].slot)] = 1;
  const std::size_t room = std::min(guided_.size() - fixed_count_, attachments.size());
  held_count_ = group_count_ = 0;
  for (const AttachmentGroup& group : groups) {
    if (group_count_ == groups_.size() || held_count_ + group.count > room) break;
    for (const std::size_t end = held_count_ + group.count; held_count_ < end; ++held_count_) {
      const Attachment& a = attachments[held_count_];
      guided_[fixed_count_ + held_count_] = {a.slot, Vec3::Zero(), a.target};
      mobile_[at(a.slot)] = 0;
    }
    hold_forces_[group_count_] = {};
    groups_[group_count_++] = group;
  }
}

void ClothSolverPaper::guide(double fraction) noexcept {
  for (std::size_t i = 0; i < fixed_count_ + held_count_; ++i) {
    const Guided& g = guided_[i];
    // What stays stays to the bit, and what moves ends where it was told.
    state_.positions[at(g.slot)] = fraction == 1.0 ? g.to : Vec3(g.from + fraction * (g.to - g.from));
  }
}

StepReport ClothSolverPaper::step(double dt) noexcept {
  StepReport report;
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    report.status = StepReport::kNotFinite;
    return report;
  }
  before_ = state_;  // as large as before: no allocation
  for (std::size_t i = 0; i < fixed_count_ + held_count_; ++i)
    guided_[i].from = state_.positions[at(guided_[i].slot)];
  for (int i = 1; i <= steps_; ++i) {
    guide(static_cast<double>(i) / steps_);
    solver_.step(state_);
  }
  guide(1.0);
  if (!is_finite(state_)) {
    state_ = before_;
    for (std::size_t i = 0; i < fixed_count_ + held_count_; ++i) guided_[i].to = guided_[i].from;
    report.status = StepReport::kNotFinite;
  }
  solver_.compute_forces(state_);
  read_holds();
  report.iterations = steps_;
  report.evaluations = steps_ + 1;
  report.residual = residual();
  time_ += dt;
  return report;
}

// What keeps a held particle in its place is what it does not let the cloth do.
void ClothSolverPaper::read_holds() noexcept {
  std::size_t first = fixed_count_;
  for (std::size_t g = 0; g < group_count_; first += groups_[g].count, ++g) {
    HoldForce hold;
    for (std::size_t i = first; i < first + groups_[g].count; ++i) {
      const Vec3 force = -solver_.force(guided_[i].slot);
      hold.force += force;
      hold.moment += (position(guided_[i].slot) - groups_[g].origin).cross(force);
    }
    hold_forces_[g] = hold;
  }
}

double ClothSolverPaper::residual() const noexcept {
  double square = 0.0;
  for (int slot = 0; slot < lattice_.node_count(); ++slot)
    if (mobile_[at(slot)] != 0) square += solver_.force(slot).squaredNorm();
  return std::sqrt(square);
}

ClothEnergy ClothSolverPaper::energy() const {
  const RelaxationResult measured = solver_.measure(state_);
  ClothEnergy energy;
  energy.stretch = measured.stretch_energy;
  energy.bending = measured.bending_energy;
  energy.weight = measured.weight_energy;
  // measure() counts from the rest positions, the engine from the origin of coordinates.
  for (int slot = 0; slot < lattice_.node_count(); ++slot) {
    energy.weight -= lattice_.areal_mass * lattice_.tributary_area(slot) *
                     solver_.options().gravity.dot(lattice_.rest_positions[at(slot)]);
  }
  return energy;
}

}  // namespace fuai
