// What every solver of a cloth offers: a state in, places and holds, a tick, positions and forces out.
// SPDX-License-Identifier: Apache-2.0
//
//   make_cloth_solver() -> restore(state) -> [place / attach -> step]* -> save(state)
//
//   kind        numbers   a tick of dt is                                  a hold is
//   kImplicit   float     one linearised implicit step (implicit.h)        springs, solved for with the cloth
//   kDouble     double    the same                                         the same
//   kExplicit   double    equal substeps below the bound (explicit.h)      springs, their targets move with
//                                                                          the substeps
//   kPaper      double    a stated number of steps of the paper's Eq. (6)  rigid: its slots go where they are
//                         (relaxation.h); there is no time, dt only says   told, so it should be one particle
//                         how far hands and pins go
//
//   The paper's method knows springs of one stiffness, bending and weight, on whole cells; it does not read
//   shear, tension, twist, viscosity, drag and air of the material, and holds a clamp at its particles.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "fuai/cloth/cloth_model.h"
#include "fuai/core/team.h"
#include "fuai/solver/cloth_energy.h"
#include "fuai/solver/cloth_material.h"
#include "fuai/solver/implicit.h"

namespace fuai {

enum class SolverKind : std::uint8_t { kImplicit, kDouble, kExplicit, kPaper };

/// A solver in the list of solvers.
struct SolverEntry {
  SolverKind kind;
  std::string_view name;         ///< as the program takes it
  std::string_view description;  ///< one line
  std::string_view precision;    ///< "float" or "double"
  bool has_time;                 ///< dt is a time, and velocities mean something
  bool spring_holds;             ///< holds are springs; else rigid
  bool solves_equation;          ///< StepReport::residual says how well; the explicit step leaves it zero
};

/// All solvers, the default first. Thread class: any.
std::span<const SolverEntry> solver_entries() noexcept;
const SolverEntry& solver_entry(SolverKind kind) noexcept;
/// @throws Error (kUsage) with all names for a solver that does not exist. Thread class: set-up.
const SolverEntry& find_solver(std::string_view name);

/// Steps of the paper's descent in a tick: at a tick of 1 ms a cloth of 18 x 18 is at rest within 3 s.
inline constexpr int kPaperStepsATick = 100;

/// Which solver, and how it steps.
struct ClothSolverOptions {
  SolverKind kind = SolverKind::kImplicit;
  ImplicitOptions implicit;  ///< of the implicit solvers; gravity and wind are those of every solver
  int inner_steps = 0;  ///< substeps of the explicit solver, 0: as many as are safe; steps of the paper's
                        ///< in a tick, 0: kPaperStepsATick; not read by the implicit ones
};

/// A solver. One thread calls all of it.
class ClothSolver {
 public:
  ClothSolver() = default;
  ClothSolver(const ClothSolver&) = delete;
  ClothSolver& operator=(const ClothSolver&) = delete;
  virtual ~ClothSolver() = default;

  virtual const SolverEntry& entry() const noexcept = 0;
  /// Takes over a state. What a solver does not carry in it (friction memory that it does not have) stays as
  /// it was and is saved again. Thread class: set-up.
  virtual void restore(const ClothState& state) = 0;
  /// Copies the state out; restore() of it, and the same holds, continue bit for bit. Thread class: set-up.
  virtual void save(ClothState& state) const = 0;

  /// Where a fixed slot is at the end of the next step [m]. Thread class: real-time.
  virtual void place(int slot, const Vec3& position) noexcept = 0;
  /// Holds of the next steps, group after group; what does not fit is left out. Thread class: real-time.
  virtual void attach(std::span<const Attachment> attachments,
                      std::span<const AttachmentGroup> groups) noexcept = 0;
  /// One tick. @param dt [s]; one that is not positive and finite does nothing and reports kNotFinite.
  /// Thread class: real-time.
  virtual StepReport step(double dt) noexcept = 0;

  virtual Vec3 position(int slot) const noexcept = 0;  ///< [m]. Thread class: real-time.
  virtual Vec3 velocity(int slot) const noexcept = 0;  ///< [m/s]; zero without time. Thread class: real-time.
  /// Force of the cloth on a fixed slot after the last step, its weight included [N]. Thread class:
  /// real-time.
  virtual Vec3 force_on_fixed(int slot) const noexcept = 0;
  /// What a group of attachments put on the cloth in the last step. Thread class: real-time.
  virtual HoldForce hold_force(std::size_t group) const noexcept = 0;
  /// Sum of all dt [s]. Thread class: real-time.
  virtual double time() const noexcept = 0;
  /// Steps inside one tick of dt: 1, substeps, or steps of the paper's. Thread class: real-time.
  virtual int inner_steps(double dt) const noexcept = 0;
  /// Free energy by the solver's own laws and the weight [J]. Thread class: set-up.
  virtual ClothEnergy energy() const = 0;
  /// Threads that share a step; a solver that cannot use them does not. Null: one. The bits stay the same.
  /// Thread class: set-up.
  virtual void set_team(Team* /*team*/) {}
  /// Instruction set of the vector kernels; empty for a solver that has none. Thread class: any.
  virtual const char* target() const noexcept { return ""; }
};

/// Model and material are not copied: they must outlive the solver.
/// @param room most attachments and groups at a time
/// @throws Error (kUsage) for options out of range, and for a piece or wind that the solver cannot serve;
/// (kBadInput) as SolverExplicit. Thread class: set-up.
std::unique_ptr<ClothSolver> make_cloth_solver(const ClothModel& model, const ClothMaterial& material,
                                               const ClothSolverOptions& options,
                                               const AttachmentRoom& room = {});

}  // namespace fuai
