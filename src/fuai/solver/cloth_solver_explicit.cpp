// Steps the explicit oracle by the tick.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/cloth_solver_explicit.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Part of the bound that a substep may be long: the bound is that of the flat cloth within the measured
/// ranges, and the error of a substep falls with its length.
constexpr double kSafe = 0.5;

}  // namespace

ClothSolverExplicit::ClothSolverExplicit(const ClothModel& model, const ClothMaterial& material,
                                         const ImplicitOptions& options, int substeps,
                                         const AttachmentRoom& room)
    : model_(&model), material_(&material), substeps_(substeps) {
  if (substeps < 0) {
    throw Error(ErrorKind::kUsage,
                "a tick of the explicit solver cannot have " + std::to_string(substeps) + " substeps");
  }
  ExplicitOptions own;
  own.gravity = options.gravity;
  own.wind = options.wind;
  own.substeps = std::max(substeps, 1);
  solver_.prepare(model, material, own, room);
  places_.assign(static_cast<std::size_t>(model.slot_count()), -1);
  for (const int slot : solver_.fixed_slots()) {
    places_[static_cast<std::size_t>(slot)] = static_cast<int>(targets_.size());
    targets_.emplace_back(Vec3::Zero());
  }
  restore(make_cloth_state(model));
}

void ClothSolverExplicit::restore(const ClothState& state) {
  state_ = state;
  state_.carried.clear();
  std::ranges::fill(state_.accelerations, Vec3::Zero());  // known to the implicit steps only
  solver_.restore_holds(state.carried);
  for (const int slot : solver_.fixed_slots()) place(slot, state.positions[static_cast<std::size_t>(slot)]);
}

void ClothSolverExplicit::save(ClothState& state) const {
  state = state_;
  state.carried = solver_.holds();
}

void ClothSolverExplicit::place(int slot, const Vec3& position) noexcept {
  const int place = places_[static_cast<std::size_t>(slot)];
  if (place >= 0) targets_[static_cast<std::size_t>(place)] = position;
}

StepReport ClothSolverExplicit::step(double dt) noexcept {
  StepReport report;
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    report.status = StepReport::kNotFinite;
    return report;
  }
  solver_.set_substeps(inner_steps(dt));
  report.evaluations = solver_.options().substeps + 1;
  const std::uint32_t status = solver_.step(state_, dt, targets_);
  if ((status & kExplicitNotFinite) == 0) return report;
  // As the implicit step: the state before, at rest, and time goes on.
  report.status = StepReport::kNotFinite;
  for (Vec3& v : state_.velocities) v.setZero();
  for (const int slot : solver_.fixed_slots()) place(slot, position(slot));
  state_.time += dt;
  return report;
}

Vec3 ClothSolverExplicit::force_on_fixed(int slot) const noexcept {
  const auto i = static_cast<std::size_t>(slot);
  return solver_.internal_forces()[i] + model_->areal_mass * model_->node_area[i] * solver_.options().gravity;
}

int ClothSolverExplicit::inner_steps(double dt) const noexcept {
  return substeps_ > 0 ? substeps_ : solver_.safe_substeps(dt, kSafe);
}

ClothEnergy ClothSolverExplicit::energy() const {
  return cloth_free_energy(*model_, *material_, state_, solver_.options().gravity);
}

}  // namespace fuai
