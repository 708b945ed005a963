// The founding paper's descent behind the interface of all solvers.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", Eq. (6).
//
//   A tick, in equal moves as many as it has steps:
//     1. fixed and held slots go straight on from where they are to where they are told
//     2. one step of Eq. (6), corrected (PaperMode::kCorrected)
//   after the last one held slots are where they were told, and the forces are taken once more
//
//   There is no time: dt is only added up. The springs are the paper's (kRelaxationSpringStiffness), about a
//   thousandth of a real thread's.
#pragma once

#include <vector>

#include "fuai/cloth/lattice.h"
#include "fuai/fabric/laws.h"
#include "fuai/solver/cloth_solver.h"
#include "fuai/solver/relaxation.h"

namespace fuai {

/// Of the material it reads the two bending laws.
class ClothSolverPaper final : public ClothSolver {
 public:
  /// @param steps of the descent in a tick; 0: kPaperStepsATick
  /// @throws Error (kUsage) when the piece is no rectangle of whole cells, 3 x 3 nodes or more, for wind and
  /// for a negative number of steps. Thread class: set-up.
  ClothSolverPaper(const ClothModel& model, const ClothMaterial& material, const ImplicitOptions& options,
                   int steps, const AttachmentRoom& room);

  const SolverEntry& entry() const noexcept override { return solver_entry(SolverKind::kPaper); }
  void restore(const ClothState& state) override;
  void save(ClothState& state) const override;
  void place(int slot, const Vec3& position) noexcept override;
  /// Stiffness and most force of a hold are not read: it is rigid.
  void attach(std::span<const Attachment> attachments,
              std::span<const AttachmentGroup> groups) noexcept override;
  /// The residual is the force out of balance of the free slots, root of the sum of squares.
  StepReport step(double dt) noexcept override;
  Vec3 position(int slot) const noexcept override { return state_.positions[static_cast<std::size_t>(slot)]; }
  Vec3 velocity(int /*slot*/) const noexcept override { return Vec3::Zero(); }
  Vec3 force_on_fixed(int slot) const noexcept override { return solver_.force(slot); }
  HoldForce hold_force(std::size_t group) const noexcept override { return hold_forces_[group]; }
  double time() const noexcept override { return time_; }
  int inner_steps(double /*dt*/) const noexcept override { return steps_; }
  /// The springs, diagonals too, are `stretch`; there is no shear and no twist.
  ClothEnergy energy() const override;

 private:
  /// A slot that goes where it is told.
  struct Guided {
    int slot = 0;
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();  // in this tick [m]
  };
  void guide(double fraction) noexcept;
  void read_holds() noexcept;
  double residual() const noexcept;

  FabricLaws laws_;
  LatticeModel lattice_;
  SolverRelaxation solver_;
  LatticeState state_, before_;
  ClothState other_;                  // what the method does not know, saved as it was restored
  std::vector<Guided> guided_;        // the fixed slots, then room for the held ones
  std::vector<int> places_;           // of a fixed slot among them; -1: not fixed
  std::vector<std::uint8_t> mobile_;  // 1: neither fixed nor held
  std::size_t fixed_count_ = 0, held_count_ = 0, group_count_ = 0;
  std::vector<AttachmentGroup> groups_;
  std::vector<HoldForce> hold_forces_;
  int steps_ = kPaperStepsATick;
  double time_ = 0.0;
};

}  // namespace fuai
