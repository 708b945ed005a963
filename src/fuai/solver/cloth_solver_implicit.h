// The implicit solver behind the interface of all solvers.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "fuai/solver/cloth_solver.h"

namespace fuai {

/// Passes everything on. T is float or double.
template <class T>
class ClothSolverImplicit final : public ClothSolver {
 public:
  static constexpr SolverKind kKind = std::is_same_v<T, float> ? SolverKind::kImplicit : SolverKind::kDouble;

  /// @throws Error (kUsage) as SolverImplicit. Thread class: set-up.
  ClothSolverImplicit(const ClothModel& model, const ClothMaterial& material, const ImplicitOptions& options,
                      const AttachmentRoom& room)
      : model_(&model), material_(&material), solver_(model, material, options, room) {}

  SolverImplicit<T>& solver() noexcept { return solver_; }
  const SolverImplicit<T>& solver() const noexcept { return solver_; }

  const SolverEntry& entry() const noexcept override { return solver_entry(kKind); }
  void restore(const ClothState& state) override { solver_.restore(state); }
  void save(ClothState& state) const override { solver_.save(state); }
  void place(int slot, const Vec3& position) noexcept override { solver_.place(slot, position); }
  void attach(std::span<const Attachment> attachments,
              std::span<const AttachmentGroup> groups) noexcept override {
    solver_.attach(attachments, groups);
  }
  StepReport step(double dt) noexcept override { return solver_.step(dt); }
  Vec3 position(int slot) const noexcept override { return solver_.position(slot); }
  Vec3 velocity(int slot) const noexcept override { return solver_.velocity(slot); }
  Vec3 force_on_fixed(int slot) const noexcept override { return solver_.force_on_fixed(slot); }
  HoldForce hold_force(std::size_t group) const noexcept override { return solver_.hold_force(group); }
  double time() const noexcept override { return solver_.time(); }
  int inner_steps(double /*dt*/) const noexcept override { return 1; }
  ClothEnergy energy() const override {
    ClothState state;
    solver_.save(state);
    return cloth_free_energy(*model_, *material_, state, solver_.options().gravity);
  }
  void set_team(Team* team) override { solver_.set_team(team); }
  const char* target() const noexcept override { return solver_.target(); }

 private:
  const ClothModel* model_;        // not owned: outlives the solver
  const ClothMaterial* material_;  // not owned
  SolverImplicit<T> solver_;
};

}  // namespace fuai
