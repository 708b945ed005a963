// The explicit oracle behind the interface of all solvers.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fuai/solver/cloth_solver.h"
#include "fuai/solver/explicit.h"

namespace fuai {

/// Keeps the state that SolverExplicit steps, and where fixed slots are to be.
class ClothSolverExplicit final : public ClothSolver {
 public:
  /// @param substeps of a tick; 0: as many as keep each below half of the stability bound, holds included
  /// @throws Error as SolverExplicit, and (kUsage) for a negative number of substeps. Thread class: set-up.
  ClothSolverExplicit(const ClothModel& model, const ClothMaterial& material, const ImplicitOptions& options,
                      int substeps, const AttachmentRoom& room);

  const SolverEntry& entry() const noexcept override { return solver_entry(SolverKind::kExplicit); }
  void restore(const ClothState& state) override;
  void save(ClothState& state) const override;
  void place(int slot, const Vec3& position) noexcept override;
  void attach(std::span<const Attachment> attachments,
              std::span<const AttachmentGroup> groups) noexcept override {
    solver_.attach(attachments, groups);
  }
  /// Nothing is solved for: residual, linearisations and iterations stay zero.
  StepReport step(double dt) noexcept override;
  Vec3 position(int slot) const noexcept override { return state_.positions[static_cast<std::size_t>(slot)]; }
  Vec3 velocity(int slot) const noexcept override {
    return state_.velocities[static_cast<std::size_t>(slot)];
  }
  Vec3 force_on_fixed(int slot) const noexcept override;
  HoldForce hold_force(std::size_t group) const noexcept override { return solver_.hold_force(group); }
  double time() const noexcept override { return state_.time; }
  int inner_steps(double dt) const noexcept override;
  ClothEnergy energy() const override;

 private:
  const ClothModel* model_;        // not owned: outlives the solver
  const ClothMaterial* material_;  // not owned
  SolverExplicit solver_;
  ClothState state_;
  std::vector<Vec3> targets_;  // of the fixed slots, in the solver's order [m]
  std::vector<int> places_;    // of a slot among them; -1: not fixed
  int substeps_ = 0;           // 0: as many as are safe
};

}  // namespace fuai
