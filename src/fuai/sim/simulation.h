// A piece of cloth in time: model, state, solver and the hands that hold it.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md, docs/theory/implicit-step.md, docs/theory/grasp.md.
//
//   make -> [grasp / move_grasp / place_fixed -> step -> grasp_reading]* ; snapshot() copies the state out
//   One thread calls all of it. ClothSimulation takes any solver; Simulation<T> is the implicit one of T,
//   float at run time, double for checking.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "fuai/sim/grasp.h"
#include "fuai/solver/cloth_energy.h"
#include "fuai/solver/cloth_solver.h"
#include "fuai/solver/cloth_solver_implicit.h"

namespace fuai {

/// What make needs besides model and material.
struct SimulationOptions {
  ImplicitOptions implicit;
  int most_grasps = 4;
};

/// What a hand feels.
struct GraspReading {
  bool holds = false;
  Vec3 force = Vec3::Zero();   ///< of the cloth on the hand [N]: the true reaction, what the springs carry
  Vec3 moment = Vec3::Zero();  ///< about the hand's target point [N m]
  Vec3 centre = Vec3::Zero();  ///< where the patch is [m]
  bool saturated = false;      ///< the hold slips behind the hand
};

/// Everything worth knowing about a state, in double precision.
struct SimulationReading {
  ClothEnergy energy;            ///< free energy and weight [J]
  double kinetic_energy = 0.0;   ///< [J]
  double max_strain = 0.0;       ///< largest strain of a yarn edge with cloth [-]
  double max_speed = 0.0;        ///< [m/s]
  std::uint64_t state_hash = 0;  ///< over positions, velocities and memory
  double total_energy() const noexcept { return energy.total() + kinetic_energy; }
};

/// The simulation, whatever its solver.
class ClothSimulation {
 public:
  /// Copies model and material, allocates. @throws Error as make_cloth_solver(), and (kUsage) for grasps out
  /// of range. Thread class: set-up.
  ClothSimulation(const ClothModel& model, const ClothMaterial& material, const ClothSolverOptions& options,
                  int most_grasps = SimulationOptions{}.most_grasps);
  ClothSimulation(ClothSimulation&&) noexcept = default;
  ClothSimulation& operator=(ClothSimulation&&) noexcept = default;
  virtual ~ClothSimulation() = default;

  const ClothModel& model() const noexcept { return *model_; }
  const ClothMaterial& material() const noexcept { return *material_; }

  /// Takes over a state, lets all holds go. Thread class: set-up.
  void restore(const ClothState& state);
  /// Copies the state out. Thread class: set-up (allocates when the state is empty).
  void snapshot(ClothState& state) const { solver_->save(state); }
  /// Energies, largest strain, hash. Thread class: set-up.
  SimulationReading read() const;

  /// All that the cloth and its holds could still give [J]: free energy, weight, motion, springs of the holds
  /// (of a saturated one what its force would give back). Energies by the solver's material, whatever the
  /// solver. @param scratch any state; allocates when it is empty. Thread class: real-time once it is not.
  double stored_energy(ClothState& scratch) const;

  /// Grips the cloth. A solver whose holds are rigid gets the nearest particle alone, as in the founding
  /// paper: a patch held stiff would be another cloth. @param hand where the hand is [m]. @return number of
  /// the hold, or -1 when there is no cloth there or no hold left. Thread class: real-time.
  int grasp(const GraspSpec& spec, const Vec3& hand) noexcept;
  /// Where the hand is at the end of the next step. @param rotation since the grip. Thread class: real-time.
  void move_grasp(int hold, const Vec3& hand, const Mat3& rotation = Mat3::Identity()) noexcept;
  /// Lets go. Thread class: real-time.
  void release(int hold) noexcept;
  /// The hold itself, to be kept with a snapshot; null when it does not hold. Thread class: real-time.
  const Grasp* held(int hold) const noexcept;
  /// The point of the material at the node that is nearest to a place and not fixed, if it is no farther than
  /// `reach` [m]. @param place [m]. Thread class: real-time.
  std::optional<Vec2> free_cloth_near(const Vec3& place, double reach) const noexcept;
  /// Goes on with a hold that was kept, after restore() of the state that was kept with it. @return number of
  /// the hold, or -1 when there is none left. Thread class: real-time.
  int take_over(const Grasp& grasp) noexcept;
  /// The same with the number it had: a run goes on bit for bit only when all holds have theirs. @return
  /// whether that number was free. Thread class: real-time.
  bool take_over_as(int hold, const Grasp& grasp) noexcept;
  /// What the hand feels after the last step. Thread class: real-time.
  GraspReading grasp_reading(int hold) const noexcept;

  /// Where a fixed slot is at the end of the next step [m]. Thread class: real-time.
  void place_fixed(int slot, const Vec3& position) noexcept { solver_->place(slot, position); }
  /// Force of the cloth on all fixed slots after the last step [N]. Thread class: real-time.
  Vec3 clamp_force() const noexcept;

  /// One step. @param dt [s], > 0. Thread class: real-time.
  StepReport step(double dt) noexcept;

  Vec3 position(int slot) const noexcept { return solver_->position(slot); }
  Vec3 velocity(int slot) const noexcept { return solver_->velocity(slot); }
  double time() const noexcept { return solver_->time(); }
  ClothSolver& any_solver() noexcept { return *solver_; }
  const ClothSolver& any_solver() const noexcept { return *solver_; }

 private:
  struct Hold {
    Grasp grasp;
    bool active = false;
    std::size_t group = 0;  // of the last step
    bool stepped = false;   // a step was done since the grip
  };
  void attach_holds() noexcept;

  std::unique_ptr<const ClothModel> model_;
  std::unique_ptr<const ClothMaterial> material_;
  std::unique_ptr<ClothSolver> solver_;
  std::vector<Hold> holds_;
  std::vector<Attachment> attachments_;
  std::vector<AttachmentGroup> groups_;
  std::vector<int> fixed_slots_;
  Vec3 gravity_;
};

/// The simulation on the implicit solver of T, float or double.
template <class T>
class Simulation : public ClothSimulation {
 public:
  /// @throws Error (kUsage) as SolverImplicit, and for grasps out of range. Thread class: set-up.
  Simulation(const ClothModel& model, const ClothMaterial& material, const SimulationOptions& options = {})
      : ClothSimulation(model, material, {ClothSolverImplicit<T>::kKind, options.implicit, 0},
                        options.most_grasps) {}

  SolverImplicit<T>& solver() noexcept { return static_cast<ClothSolverImplicit<T>&>(any_solver()).solver(); }
  const SolverImplicit<T>& solver() const noexcept {
    return static_cast<const ClothSolverImplicit<T>&>(any_solver()).solver();
  }
};

/// Hash over positions, velocities, accelerations and friction memory. Thread class: any.
std::uint64_t state_hash(const ClothState& state) noexcept;

/// Largest strain of a yarn edge that carries cloth [-]. Thread class: any.
double max_edge_strain(const ClothModel& model, const ClothState& state) noexcept;

}  // namespace fuai
