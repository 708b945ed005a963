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
#include "fuai/solver/implicit_kernels.h"
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
  double reduction = 1e-6;   ///< conjugate gradients stop at this part of the first residual
  double tolerance =
      0.0;  ///< stop when the force out of balance is below this, root of the sum of squares [N]
  Preconditioner preconditioner = Preconditioner::kYarnLines;
  bool guards = true;                            ///< line searches that keep under-converged steps safe
  Vec3 gravity = {0.0, 0.0, -kStandardGravity};  ///< [m/s2]
  Vec3 wind = Vec3::Zero();                      ///< velocity of the air [m/s]
};

/// A node tied to a point by a spring that is solved for with the cloth.
struct Attachment {
  int slot = 0;
  double stiffness = 0.0;      ///< [N/m]
  Vec3 target = Vec3::Zero();  ///< [m]
};

/// Memory to be set aside for attachments.
struct AttachmentRoom {
  std::size_t attachments = 0, groups = 0;
};

/// Consecutive attachments that share a hold: their forces together never exceed `most_force`.
struct AttachmentGroup {
  std::size_t count = 0;       ///< attachments that belong to it
  double most_force = 0.0;     ///< [N]; beyond it the springs weaken together
  Vec3 origin = Vec3::Zero();  ///< point that the moment is taken about [m]
};

/// What a group put on the cloth in the last step.
struct HoldForce {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 moment = Vec3::Zero();  ///< about the group's origin [N m]
  double share = 1.0;          ///< of the spring stiffness that was left after saturation
};

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
  void attach(std::span<const Attachment> attachments, std::span<const AttachmentGroup> groups) noexcept;
  /// One step. Thread class: real-time. @param dt [s], > 0
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
  HoldForce hold_force(std::size_t group) const noexcept { return holds_[group]; }
  double time() const noexcept { return time_; }
  const ImplicitOptions& options() const noexcept { return options_; }
  void set_options(const ImplicitOptions& options) noexcept { options_ = options; }
  /// Shares the rows of every kernel out to a team; the bits stay the same. Null: one thread. The team must
  /// outlive the steps. Thread class: set-up.
  void set_team(Team* team);
  /// Bytes of all arrays that belong to nodes.
  std::size_t bytes() const noexcept;
  const char* target() const noexcept { return kernels_->target; }

 private:
  std::ptrdiff_t at(int slot) const noexcept { return grid_.at(slot / columns_) + slot % columns_; }
  void begin_step(double dt) noexcept;
  void evaluate(Evaluation what) noexcept;
  void add_attachments(bool linearise) noexcept;
  void start(double dt, StepReport& report) noexcept;
  double solve(StepReport& report) noexcept;
  void search_back(double slope, StepReport& report) noexcept;
  void give_up() noexcept;
  double longest_square() const noexcept;
  template <class Kernel, class... Arguments>
  double rows(Kernel kernel, const Arguments&... arguments) noexcept;
  template <class Kernel, class... Arguments>
  double vectors(Kernel kernel, const Arguments&... arguments) noexcept;
  template <class Kernel>
  void lines(Kernel warp, Kernel weft) noexcept;
  template <class Work>
  void with_scratch(const Work& work) noexcept;
  double sum_rows() const noexcept;

  const ImplicitKernels<T>* kernels_ = nullptr;
  std::unique_ptr<ImplicitStorage<T>> storage_;
  ImplicitGrid<T> grid_;
  ImplicitConstants<T> constants_;
  ImplicitStepConstants<T> step_;
  ImplicitOptions options_;
  Team* team_ = nullptr;
  std::vector<T> scratch_;  // one set a member
  std::vector<Attachment> attachments_;
  std::vector<AttachmentGroup> groups_;
  std::vector<HoldForce> holds_;
  std::size_t group_count_ = 0;
  int columns_ = 0;
  /// What the potential did along v at the end of the last step: guard A then need not evaluate it there.
  struct Fall {
    bool known = false;
    double cloth = 0.0;         // (force of the cloth).v [W]
    double kinetic = 0.0;       // m v.v [J]
    double weight_power = 0.0;  // m g.v [W]
  };
  void finish_step(double dt) noexcept;
  double fall_at_start(double dt) const noexcept;
  double attachment_power() const noexcept;
  double force_noise() const noexcept;

  Fall fall_;
  double stiffest_ = 0.0;      // of a yarn edge at rest [N/m]
  double size_ = 0.0;          // diagonal of the flat piece [m]
  double mobile_count_ = 0.0;  // nodes
  double time_ = 0.0, load_ = 1.0;
};

extern template class SolverImplicit<float>;
extern template class SolverImplicit<double>;

}  // namespace fuai
