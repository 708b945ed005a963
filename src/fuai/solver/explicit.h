// The explicit solver: many small semi-implicit Euler steps of the reference forces; the oracle of the
// implicit one.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md.
//
//   each substep ds = dt / substeps:
//     1. forces at x, v; the friction memory moves to x      (cloth_energy.h, and viscosity from v)
//     2. v += ds (F / m + g - c v + F_air / m),  x += ds v   of free slots
//     3. fixed slots and the targets of holds go straight from where they are to where they are told
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
#include "fuai/solver/implicit_holds.h"  // Attachment, AttachmentGroup, HoldForce: what a hold is

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
  /// @param room most attachments and groups at a time
  /// @throws Error (kUsage) when substeps < 1; (kBadInput) when a free live slot carries no cloth.
  /// Thread class: set-up.
  void prepare(const ClothModel& model, const ClothMaterial& material, const ExplicitOptions& options = {},
               const AttachmentRoom& room = {});

  /// Gravity of the next steps [m/s2], for a load that grows. Thread class: real-time.
  void set_gravity(const Vec3& gravity) noexcept { options_.gravity = gravity; }

  /// One step.
  /// @param dt [s], > 0
  /// @param fixed_positions [m], where the fixed slots are at the end of the step, in the order of
  /// fixed_slots(); empty: they stay
  /// @return ExplicitStatus bits; 0 is good. Thread class: real-time.
  std::uint32_t step(ClothState& state, double dt, std::span<const Vec3> fixed_positions = {}) noexcept;

  /// Springs of the next steps, group after group, with the targets at the end of the next step; what does
  /// not fit is left out. During a step targets go straight from where they were at the end of the last one;
  /// those of a new hold from where its slots are. Thread class: real-time.
  void attach(std::span<const Attachment> attachments, std::span<const AttachmentGroup> groups) noexcept;
  /// What a group of attachments put on the cloth at the end of the last step; zero after a refused step.
  /// Thread class: real-time.
  HoldForce hold_force(std::size_t group) const noexcept { return hold_forces_[group]; }
  /// Slots and targets of the holds as a state carries them (ClothState::carried), so that a run that is
  /// restored goes on bit for bit. Thread class: set-up.
  std::vector<double> holds() const;
  /// Takes them over; anything that is not from holds() lets all go. Thread class: set-up.
  void restore_holds(std::span<const double> carried) noexcept;
  /// Substeps of the next steps, > 0. Thread class: real-time.
  void set_substeps(int substeps) noexcept { options_.substeps = substeps; }
  /// Substeps that keep each of them below `margin` of the bound, holds included.
  /// @param dt [s], > 0  @param margin in (0, 1]. Thread class: real-time.
  int safe_substeps(double dt, double margin) const noexcept;
  const ExplicitOptions& options() const noexcept { return options_; }

  /// Elastic, frictional and viscous force of the cloth on each slot at the end of the last step [N] (slots),
  /// without weight, drag and air; zero after a refused step. Over fixed slots it sums to the force on what
  /// holds them.
  std::span<const Vec3> internal_forces() const noexcept { return forces_; }
  /// Sum of internal_forces() over the fixed slots [N].
  Vec3 reaction() const noexcept;
  /// Slots whose positions are prescribed, rising.
  std::span<const int> fixed_slots() const noexcept { return fixed_slots_; }
  /// Longest substep that is stable about the flat cloth, without holds [s].
  double stable_substep() const noexcept { return stable_substep_; }
  /// Steps refused since prepare().
  std::uint64_t failed_steps() const noexcept { return failed_steps_; }

 private:
  /// A spring of a hold, and where its target was at the end of the last step.
  struct Spring {
    Attachment end;
    Vec3 from = Vec3::Zero();  // [m]
    bool fresh = true;         // `from` is not known yet
  };
  void take_forces(ClothState& state) noexcept;
  void take_holds(const ClothState& state, double fraction) noexcept;
  void move_free(ClothState& state, double ds) const noexcept;
  void move_fixed(ClothState& state, std::span<const Vec3> targets, double fraction) const noexcept;

  const ClothModel* model_ = nullptr;        // not owned: outlives the solver
  const ClothMaterial* material_ = nullptr;  // not owned
  ExplicitOptions options_;
  std::vector<int> fixed_slots_, free_slots_;
  std::vector<Vec3> forces_;
  std::vector<Spring> springs_;
  std::vector<AttachmentGroup> groups_;
  std::vector<HoldForce> hold_forces_;
  std::vector<Vec3> pulls_;  // of the holds on each slot [N]
  std::size_t spring_count_ = 0, group_count_ = 0;
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
