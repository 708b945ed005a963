// Cloth in the hand: steps the simulation after the tool and tells what the hand feels, with a tangent where
// the cloth is slower than the device.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Cloth".
//
//   kHeld     force of the step. For a cloth that steps as often as the device ticks.
//   kTangent  a twin of the simulation does the next step seven times: with the hand going on as it goes, and
//             with it a probe's length off to both sides along x, y, z. The first gives force_rate, the
//             others the stiffness: that of the very step that will come, inertia and friction included.
#pragma once

#include <cstdint>
#include <memory>

#include "fuai/haptics/environment.h"
#include "fuai/sim/simulation.h"

namespace fuai {

/// How the cloth answers.
struct ClothHandOptions {
  bool tangent = false;
  double probe = 0.5e-3;       ///< [m]: beyond rounding, below what bends the force
  double horizon = 2.0;        ///< of the prediction, in steps: one while it is computed, one while it serves
  double error_force = 0.02;   ///< a model may be off by so much [N] ...
  double error_share = 0.03;   ///< ... or this part of the force, whichever is more
  double least_trust = 0.002;  ///< bounds of the trust radius [m]
  double most_trust = 0.02;
  double audit_time = 1.0 / 60.0;  ///< the stored energy is told so often [s]: it costs as much as a step
};

/// How to step a cloth that is felt: each step to 0.2 % of its force, in up to eight linearisations. Tuned on
/// the bundled fabrics bent by a hand that moves in encoder steps (test_cloth_force): the solver's own two
/// linearisations miss up to 2.5 % of the force there, and more iterations in each help less. Thread class:
/// any.
ImplicitOptions make_felt_options(const ImplicitOptions& scene);

/// One hand on one cloth.
class ClothHand final : public HapticEnvironment {
 public:
  /// Copies all of it and puts the cloth in its start. The patch's hold is the coupling of cloth and tool:
  /// spec.stiffness at most what the device renders, see docs/haptics.md.
  /// @throws Error as ClothSimulation, and (kUsage) when there is no cloth to grip. Thread class: set-up.
  ClothHand(const ClothModel& model, const ClothMaterial& material, const ClothSolverOptions& solver,
            const ClothState& start, const GraspSpec& grasp, const ClothHandOptions& options = {});

  /// Grips at the tool when the pose holds and it does not yet, lets go when it does not hold.
  LocalModel update(const ToolPose& pose, double dt, double next) noexcept override;

  const ClothSimulation& simulation() const noexcept { return simulation_; }
  /// Where the middle of the patch is now, or while nobody holds it was at the start [m]: where a tool
  /// begins. Thread class: real-time.
  Vec3 patch() const noexcept;
  /// Steps in which a number went wrong. Thread class: real-time.
  std::uint64_t failed_steps() const noexcept { return failed_steps_; }

 private:
  void grip(const ToolPose& pose) noexcept;
  void probe(const ToolPose& pose, double next, LocalModel& model) noexcept;
  Vec3 twin_force(const Vec3& hand, double dt) noexcept;
  double trust(const LocalModel& model) noexcept;

  ClothSimulation simulation_;
  std::unique_ptr<ClothSimulation> twin_;
  GraspSpec grasp_;
  ClothHandOptions options_;
  ClothState state_;
  LocalModel last_;
  int hold_ = -1;
  Vec3 start_ = Vec3::Zero();
  double since_audit_ = 0.0, trust_ = 0.0;
  std::uint64_t number_ = 0, failed_steps_ = 0;
};

}  // namespace fuai
