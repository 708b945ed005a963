// The explicit solver: many small semi-implicit Euler steps of the reference forces; the oracle of the
// implicit one. SPDX-License-Identifier: Apache-2.0 Source: docs/theory/engine.md.
//
//   each substep ds = dt / substeps:
//     1. forces at x, v; the friction memory moves to x      (cloth_energy.h, and viscosity from v)
//     2. v += ds (F / m + g - c v + F_air / m),  x += ds v   of free slots
//     3. fixed slots go straight from where they are to where they are told, with that velocity
//   after the last one the forces are taken once more, so that internal_forces() belongs to the end of the
//   step
//
//   First order in ds; stable below stable_substep(). Without friction, viscosity, drag and air the energy
//   swings about its start by O(ds) and does not drift.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/core/constants.h"
#include "fuai/solver/cloth_material.h"

namespace fuai {

/// How to step.
struct ExplicitOptions {
  int substeps = 100;                            ///< of one step, > 0
  Vec3 gravity = {0.0, 0.0, -kStandardGravity};  ///< [m/s2]
  Vec3 wind = Vec3::Zero();                      ///< velocity of the air [m/s]
};

/// Bits that a step returns.
enum ExplicitStatus : std::uint32_t {
  kExplicitNotFinite = 1,        ///< a number became infinite or NaN: the state is as it was before the step
  kExplicitUnstableSubstep = 2,  ///< the substep is longer than stable_substep() of the flat cloth
};

/// Build, prepare(), then step(). Deterministic: one thread, fixed order.
class SolverExplicit {
 public:
  /// Model and material are not copied: they must outlive the solver.
  /// @throws Error (kUsage) when substeps < 1; (kBadInput) when a free live slot carries no cloth.
  /// Thread class: set-up.
  void prepare(const ClothModel& model, const ClothMaterial& material, const ExplicitOptions& options = {});

  /// Gravity of the next steps [m/s2], for a load that grows. Thread class: real-time.
  void set_gravity(const Vec3& gravity) noexcept { options_.gravity = gravity; }

  /// One step.
  /// @param dt [s], > 0
  /// @param fixed_positions [m], where the fixed slots are at the end of the step, in the order of
  /// fixed_slots(); empty: they stay
  /// @return ExplicitStatus bits; 0 is good. Thread class: real-time.
  std::uint32_t step(ClothState& state, double dt, std::span<const Vec3> fixed_positions = {}) noexcept;

  /// Elastic, frictional and viscous force of the cloth on each slot at the end of the last step [N] (slots),
  /// without weight, drag and air; zero after a refused step. Over fixed slots it sums to the force on what
  /// holds them.
  std::span<const Vec3> internal_forces() const noexcept { return forces_; }
  /// Sum of internal_forces() over the fixed slots [N].
  Vec3 reaction() const noexcept;
  /// Slots whose positions are prescribed, rising.
  std::span<const int> fixed_slots() const noexcept { return fixed_slots_; }
  /// Longest substep that is stable about the flat cloth [s].
  double stable_substep() const noexcept { return stable_substep_; }
  /// Steps refused since prepare().
  std::uint64_t failed_steps() const noexcept { return failed_steps_; }

 private:
  void take_forces(ClothState& state) noexcept;
  void move_free(ClothState& state, double ds) const noexcept;
  void move_fixed(ClothState& state, std::span<const Vec3> targets, double fraction) const noexcept;

  const ClothModel* model_ = nullptr;        // not owned: outlives the solver
  const ClothMaterial* material_ = nullptr;  // not owned
  ExplicitOptions options_;
  std::vector<int> fixed_slots_, free_slots_;
  std::vector<Vec3> forces_;
  ClothState before_;  // the last good state
  double stable_substep_ = 0.0;
  std::uint64_t failed_steps_ = 0;
};

/// Longest stable substep about the flat cloth [s]: 4 / (d + sqrt(d^2 + 4 w^2)), with w^2 and d bounds on the
/// eigenvalues of stiffness and damping over mass (largest row sum of block norms, Gershgorin). Stiffness:
/// the largest stick tangent over the measured range of every law, the steepest tension included. Cloth
/// folded sharper than the range, or pulled beyond it where the law is steeper still, needs shorter substeps.
/// Infinite when nothing is stiff. Thread class: set-up.
double stable_substep(const ClothModel& model, const ClothMaterial& material);

/// Force of the air on the cloth of one slot [N]: -A (c_n n n^T + c_t (1 - n n^T)) v with c_n = rho C_n |v_n|
/// / 2 and c_t = rho C_t |v_t| / 2.
/// @param area [m2]  @param normal unit, or zero where the cloth has none (then all of v counts as
/// tangential)
/// @param velocity of the cloth against the air [m/s]. Thread class: real-time.
Vec3 air_force(const ClothMaterial& material, double area, const Vec3& normal, const Vec3& velocity) noexcept;

}  // namespace fuai
