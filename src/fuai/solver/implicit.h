// The implicit step: one linearised minimisation of the incremental potential a tick, solved by conjugate
// gradients with exact solves along every yarn.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md (energies), docs/theory/implicit-step.md (step, preconditioner, guards).
//
//   make (allocates) -> restore(state) -> [place / attach -> step]* -> save(state)
//   float at run time, double for checking; both from one source
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/core/constants.h"
#include "fuai/core/team.h"
#include "fuai/solver/cloth_material.h"
#include "fuai/solver/implicit_holds.h"
#include "fuai/solver/implicit_kernels.h"
#include "fuai/solver/implicit_runner.h"
#include "fuai/solver/implicit_storage.h"

namespace fuai {

/// What goes into P^-1.
enum class Preconditioner {
  kYarnLines,  ///< mean of the exact solves along all warp yarns and along all weft yarns
  kBlocks,     ///< 3 x 3 blocks of the nodes alone: the fallback
};

/// How a step is done.
struct ImplicitOptions {
  int iterations = 8;        ///< conjugate gradients a linearisation, at most
  int linearisations = 2;    ///< at most, a step
  double relinearise = 0.1;  ///< once more while the force out of balance exceeds this part of what it was
  double noise_floor = 0.5;  ///< no further linearisation once the force out of balance is below this part of
                             ///< what rounding of positions makes of it; 1 costs the bending force 0.4 % in
                             ///< float, smaller only costs time, 0 never stops
  double implicitness =
      0.65;                 ///< theta of steps up to kLongestSharpStep, 0.5 < theta <= 1; longer ones take 1
  double reduction = 1e-6;  ///< conjugate gradients stop at this part of the first residual
  double tolerance =
      0.0;  ///< stop when the force out of balance is below this, root of the sum of squares [N]
  Preconditioner preconditioner = Preconditioner::kYarnLines;
  bool guards = true;                            ///< line searches that keep under-converged steps safe
  Vec3 gravity = {0.0, 0.0, -kStandardGravity};  ///< [m/s2]
  Vec3 wind = Vec3::Zero();                      ///< velocity of the air [m/s]
};

/// Longer steps are those of implicit Euler, whatever the implicitness: their damping is what keeps them calm
/// [s].
inline constexpr double kLongestSharpStep = 1.5e-3;

/// What a step did.
struct StepReport {
  enum Status : std::uint32_t {
    kFine = 0,
    kNotFinite = 1,    ///< a number went wrong; the state before the step was kept, at rest
    kStartedBack = 2,  ///< the first guess was pulled back (guard A)
    kShortened = 4,    ///< the step was shortened (guard B)
  };
  std::uint32_t status = kFine;
  int linearisations = 0;
  int iterations = 0;  ///< conjugate gradients, all together
  int evaluations = 0;
  double residual = 0.0;  ///< force out of balance after the step, root of the sum of squares [N]
};

/// The solver. T is float or double.
template <class T>
class SolverImplicit {
 public:
  /// Allocates everything a step needs. @param room most attachments and groups at a time
  /// @throws Error (kUsage) for options out of range. Thread class: set-up.
  SolverImplicit(const ClothModel& model, const ClothMaterial& material, const ImplicitOptions& options,
                 const AttachmentRoom& room = {});
  /// Takes over a state. Thread class: set-up.
  void restore(const ClothState& state);
  /// Copies the state out; restore() of it continues bit for bit. Thread class: set-up.
  void save(ClothState& state) const;

  /// Where a fixed slot is at the end of the next step. Thread class: real-time.
  void place(int slot, const Vec3& position) noexcept;
  /// Springs of the next steps, group after group; what does not fit is left out. Thread class: real-time.
  void attach(std::span<const Attachment> attachments, std::span<const AttachmentGroup> groups) noexcept {
    holds_.attach(attachments, groups);
  }
  /// One step. Thread class: real-time. @param dt [s]; one that is not positive and finite does nothing and
  /// reports kNotFinite
  StepReport step(double dt) noexcept;

  /// One step of descent to equilibrium: a linearisation about x, damped as a step dt from rest would be, no
  /// slot moved by more than `largest_move`. Leaves velocities at zero and the memory where it was; see
  /// commit(). The residual reported is that before the step. Thread class: real-time.
  StepReport descend(double dt, double largest_move) noexcept;
  /// Moves the friction memory to where the cloth is. Thread class: real-time.
  void commit() noexcept;
  /// Force out of balance where the cloth is, root of the sum of squares over mobile slots [N].
  /// Thread class: real-time.
  double out_of_balance() noexcept;
  /// Weight of the mobile cloth [N]. Thread class: any.
  double mobile_weight() const noexcept;
  /// Scales gravity in the next steps: the loading path of a static solve. Thread class: real-time.
  void set_load(double share) noexcept { load_ = share; }

  /// Position of a slot [m]. Thread class: real-time.
  Vec3 position(int slot) const noexcept;
  Vec3 velocity(int slot) const noexcept;
  /// Force of the cloth on a fixed slot after the last step, its weight included [N]: what the clamp carries.
  Vec3 force_on_fixed(int slot) const noexcept;
  /// What a group of attachments put on the cloth in the last step; the hand feels the opposite.
  HoldForce hold_force(std::size_t group) const noexcept { return holds_.force(group); }
  double time() const noexcept { return time_; }
  const ImplicitOptions& options() const noexcept { return options_; }
  /// @throws Error (kUsage) for options out of range. Thread class: set-up.
  void set_options(const ImplicitOptions& options);
  /// Shares the rows of every kernel out to a team; the bits stay the same. Null: one thread. The team must
  /// outlive the steps. Thread class: set-up.
  void set_team(Team* team) { run_.set_team(team); }
  /// Bytes of all arrays that belong to nodes.
  std::size_t bytes() const noexcept;
  const char* target() const noexcept { return kernels_->target; }

 private:
  /// What the potential did along v at the end of the last step: guard A then need not evaluate it there.
  struct Fall {
    bool known = false;
    double cloth = 0.0;         // (force of the cloth).v [W]
    double kinetic = 0.0;       // m v.(v + past_dt a) / theta^2 [J]
    double weight_power = 0.0;  // m g.v [W]
  };
  /// The first guess of a step: how fast the potential falls along v at xn and at the guess [W].
  struct Guess {
    double fall_at_start = 0.0, fall_at_end = 0.0;
    double rise(double dt) const noexcept { return -0.5 * dt * (fall_at_start + fall_at_end); }  ///< [J]
  };
  /// What a solve did: how far along d it went, by how much the potential fell [J], trapezoid rule, and what
  /// is out of balance there, sum of squares [N2].
  struct Descent {
    double length = 1.0, fall = 0.0, square = 0.0;
  };
  void begin_step(double dt, double theta) noexcept;
  void evaluate(Evaluation what) noexcept;
  Guess start(double dt, StepReport& report) noexcept;
  bool start_back(double dt, Guess guess, const Descent& descent, StepReport& report) noexcept;
  /// What a solve promises: force.d at d = 0 [J], and what is out of balance there, sum of squares [N2].
  struct Promise {
    double slope = 0.0, square = 0.0;
  };
  Promise solve(StepReport& report) noexcept;
  double shorten(double length, Descent& descent, StepReport& report) noexcept;
  Descent move_along(const Promise& promise, StepReport& report) noexcept;
  void finish_step(double dt) noexcept;
  void stand_still() noexcept;
  void give_up() noexcept;
  double longest_square() const noexcept;
  double fall_at_start(double dt) const noexcept;
  double force_noise() const noexcept;

  const ImplicitKernels<T>* kernels_ = nullptr;
  std::unique_ptr<ImplicitStorage<T>> storage_;
  ImplicitGrid<T> grid_;
  ImplicitConstants<T> constants_;
  ImplicitRunner<T> run_;
  ImplicitStepConstants<T> step_;
  ImplicitOptions options_;
  ImplicitHolds<T> holds_;
  Fall fall_;
  double stiffest_ = 0.0;      // of a yarn edge at rest [N/m]
  double size_ = 0.0;          // diagonal of the flat piece [m]
  double mobile_count_ = 0.0;  // nodes
  double time_ = 0.0, load_ = 1.0;
  double theta_ = 1.0;  // of the step at hand
};

extern template class SolverImplicit<float>;
extern template class SolverImplicit<double>;

}  // namespace fuai
