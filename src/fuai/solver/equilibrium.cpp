// Descent to equilibrium.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "fuai/cloth/refine.h"
#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Pseudo-time grows by this while steps are taken whole and shrinks by its inverse when they are not.
constexpr double kGrowth = 4.0, kShrink = 0.5;
constexpr double kLongestDt = 1e4, kShortestDt = 1e-5;

void check(const EquilibriumOptions& o) {
  if (!(o.tolerance > 0.0) || o.most_steps < 1 || o.load_steps < 1 || !(o.first_dt > 0.0) ||
      !(o.largest_move > 0.0) || !(o.perturbation >= 0.0)) {
    throw Error(ErrorKind::kUsage,
                "a static solve needs a positive tolerance, step, largest move, and at least one step");
  }
}

void perturb(const ClothModel& model, const EquilibriumOptions& options, ClothState& state) {
  if (options.perturbation == 0.0) return;
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<double> shift(-options.perturbation, options.perturbation);
  for (std::size_t slot = 0; slot < state.positions.size(); ++slot) {
    const double z = shift(random);
    if (model.live[slot] != 0 && model.fixed[slot] == 0) state.positions[slot].z() += z;
  }
}

}  // namespace

EquilibriumReport find_equilibrium(const ClothModel& model, const ClothMaterial& material, ClothState& state,
                                   const EquilibriumOptions& options, const Progress& progress) {
  check(options);
  perturb(model, options, state);
  ImplicitOptions implicit;
  implicit.iterations = options.iterations;
  implicit.reduction = options.reduction;
  implicit.gravity = options.gravity;
  implicit.guards = options.guards;  // else the length of a step is limited instead: see the theory page
  implicit.preconditioner = options.preconditioner;
  ClothMaterial still = material;
  still.mass_drag = still.air_normal = still.air_tangential = still.viscosity_time = 0.0;
  SolverImplicit<double> solver(model, still, implicit);
  solver.restore(state);
  const double weight = solver.mobile_weight();
  EquilibriumReport report;
  for (int load = 1; load <= options.load_steps; ++load) {
    const double share = static_cast<double>(load) / options.load_steps;
    solver.set_load(share);
    const double limit = std::max(options.tolerance * weight * share, options.least_force);
    double dt = options.first_dt, residual = solver.out_of_balance();
    while (residual > limit && report.steps < options.most_steps) {
      const StepReport step = solver.descend(dt, options.largest_move * model.spacing);
      ++report.steps;
      report.iterations += step.iterations;
      const double before = residual;
      residual = solver.out_of_balance();
      const bool whole = (step.status & (StepReport::kShortened | StepReport::kNotFinite)) == 0;
      dt = std::clamp(dt * (whole && residual < 4.0 * before ? kGrowth : kShrink), kShortestDt, kLongestDt);
      if (progress) progress("equilibrium", static_cast<double>(report.steps) / options.most_steps);
    }
    report.residual = weight > 0.0 ? residual / weight : residual;
    report.converged = residual <= limit;
    solver.commit();
  }
  const double time = state.time;
  solver.save(state);
  state.time = time;
  return report;
}

EquilibriumReport find_equilibrium_nested(std::span<const ClothModel> levels, const ClothMaterial& material,
                                          ClothState& state, const EquilibriumOptions& options,
                                          const Progress& progress) {
  if (levels.empty()) throw Error(ErrorKind::kUsage, "a nested static solve needs at least one lattice");
  const ClothModel& finest = levels.back();
  const ClothState start = state;
  EquilibriumReport all;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const bool last = i + 1 == levels.size();
    const ClothState placed = last ? start : refine_state(finest, start, levels[i]);
    ClothState level = i == 0 ? placed : refine_state(levels[i - 1], state, levels[i]);
    for (std::size_t slot = 0; slot < level.positions.size(); ++slot)
      if (levels[i].fixed[slot] != 0 || levels[i].live[slot] == 0)
        level.positions[slot] = placed.positions[slot];
    EquilibriumOptions here = options;
    if (!last) here.tolerance = std::max(options.tolerance, kCoarseTolerance);
    if (i > 0) here.perturbation = 0.0;
    const EquilibriumReport report = find_equilibrium(levels[i], material, level, here, progress);
    all = {report.converged, all.steps + report.steps, all.iterations + report.iterations, report.residual};
    state = std::move(level);
  }
  state.time = start.time;
  return all;
}

}  // namespace fuai
