// Cloth in the hands: steps the simulation after the tools and tells what each hand feels, with a tangent
// where the cloth is slower than the device.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Cloth".
//
//   kHeld     force of the step. For a cloth that steps as often as the device ticks.
//   kTangent  a twin of the simulation does the next step seven times: with the hand going on as it goes, and
//             with it a probe's length off to both sides along x, y, z. The first gives force_rate, the
//             others the stiffness: that of the very step that will come, inertia and friction included.
//             Of several hands the others go on as they go while one is probed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fuai/haptics/environment.h"
#include "fuai/haptics/session_record.h"
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
  /// 0: a hand always grips its own patch, wherever the tool is. Else it grips the cloth that is nearest to
  /// the tool, if that is no farther away [m].
  double reach = 0.0;
};

/// Hands on one cloth: one, or several that hold it together.
class ClothHand final : public HapticEnvironment {
 public:
  /// Copies all of it and puts the cloth in its start. The patch's hold is the coupling of cloth and tool:
  /// spec.stiffness at most what the device renders, see docs/haptics.md.
  /// @param grasps one a hand, 1 to kMostSessionHands
  /// @throws Error as ClothSimulation, and (kUsage) when there is no cloth to grip. Thread class: set-up.
  ClothHand(const ClothModel& model, const ClothMaterial& material, const ClothSolverOptions& solver,
            const ClothState& start, std::span<const GraspSpec> grasps, const ClothHandOptions& options = {});
  /// The same with one hand.
  ClothHand(const ClothModel& model, const ClothMaterial& material, const ClothSolverOptions& solver,
            const ClothState& start, const GraspSpec& grasp, const ClothHandOptions& options = {})
      : ClothHand(model, material, solver, start, std::span<const GraspSpec>(&grasp, 1), options) {}

  std::size_t hands() const noexcept override { return hands_.size(); }
  /// Each hand grips at its tool when its pose holds and it does not yet, lets go when it does not hold.
  void update_all(std::span<const ToolPose> poses, double dt, double next,
                  std::span<LocalModel> models) noexcept override;
  /// update_all() of one hand.
  LocalModel update(const ToolPose& pose, double dt, double next) noexcept override;
  std::uint64_t state_hash() noexcept override;

  const ClothSimulation& simulation() const noexcept { return simulation_; }
  /// What a hand feels after the last step. Thread class: real-time.
  GraspReading reading(std::size_t hand) const noexcept {
    return simulation_.grasp_reading(hands_[hand].hold);
  }
  /// Where the middle of a hand's patch is now, or while nobody holds it was at the start [m]: where a tool
  /// begins. Thread class: real-time.
  Vec3 patch(std::size_t hand = 0) const noexcept;
  /// Steps in which a number went wrong. Thread class: real-time.
  std::uint64_t failed_steps() const noexcept { return failed_steps_; }

 private:
  struct Hand {
    GraspSpec grasp;
    int hold = -1;
    Vec3 start = Vec3::Zero();
    Vec3 tool = Vec3::Zero();  // of the last step, while it held
    double work = 0.0;         // on the cloth since the last audit [J]
    double stored = 0.0;       // its share of what is stored [J]
    LocalModel last;
    double trust = 0.0;
  };
  void grip(Hand& hand, const ToolPose& pose) noexcept;
  void audit(std::span<LocalModel> models) noexcept;
  void probe(std::span<const ToolPose> poses, double next, std::span<LocalModel> models) noexcept;
  void run_twin(std::span<const ToolPose> poses, double next, std::size_t moved, const Vec3& off) noexcept;
  double find_trust(Hand& hand, const LocalModel& model) noexcept;

  ClothSimulation simulation_;
  std::unique_ptr<ClothSimulation> twin_;
  ClothHandOptions options_;
  std::vector<Hand> hands_;
  ClothState state_;
  std::array<int, kMostSessionHands> twin_holds_{};
  double since_audit_ = 0.0, stored_ = 0.0;
  std::uint64_t number_ = 0, failed_steps_ = 0;
};

}  // namespace fuai
