// A scene of the cloth engine: the cloth, how it starts, and what hands and pins do as a function of time.
// SPDX-License-Identifier: Apache-2.0
//
//   make_*() in engine_scenes.h or make_engine_scene() by name -> EngineScene, constant
//   SceneRun(scene, solver) or, for the implicit solver of T, SceneRunner<T>(scene)
//     -> step(dt) -> hand_reading() ; snapshot(), restore()
//   who has a Simulation of his own calls drive() with a SceneHolds, or drive_from() when the motion is to
//   pause and go on
//
//   A tick from t to t + dt: hands that begin to hold by t + dt grip the cloth as it is at t; hands and pins
//   go to where they are at t + dt; the cloth follows. Nothing depends on anything but t, dt and the scene.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fuai/sim/simulation.h"

namespace fuai {

/// What every scene lets the caller choose.
struct SceneOptions {
  int size = 0;          ///< nodes on the longer side, kLeastSceneSize to kMostSceneSize; 0: the scene's own
  double spacing = 0.0;  ///< of the yarns [m], kLeastSceneSpacing to kMostSceneSpacing; 0: the scene's own
};

inline constexpr int kLeastSceneSize = 3, kMostSceneSize = 512;
inline constexpr double kLeastSceneSpacing = 1e-4, kMostSceneSpacing = 0.1;  ///< [m]

/// Most hands in a scene.
inline constexpr std::size_t kMostHands = 4;

/// A hand at a moment.
struct HandMoment {
  bool holds = false;                ///< it grips the cloth, or carries it
  Vec3 position = Vec3::Zero();      ///< [m]
  Mat3 rotation = Mat3::Identity();  ///< since the grip; for GraspKind::kPinch
};

/// What moves by itself. Pure functions of time. Thread class: real-time.
class SceneMotion {
 public:
  virtual ~SceneMotion() = default;
  /// @param hand number of the hand  @param time [s], >= 0
  virtual HandMoment hand(std::size_t hand, double time) const noexcept = 0;
  /// How far a fixed slot has gone from where it started [m]. @param start [m]  @param time [s]
  virtual Vec3 fixed_move(const Vec3& start, double time) const noexcept;
  /// Whether fixed_move() ever differs from zero.
  virtual bool moves_fixed() const noexcept { return false; }
};

/// A thing that is only to be seen: table, rail.
struct SceneBlock {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< [m]
};

/// Another: an upright cylinder, such as the disc of a drape tester.
struct SceneColumn {
  Vec3 top = Vec3::Zero();            ///< centre of its upper face [m]
  double radius = 0.0, height = 0.0;  ///< [m]
};

/// Where a scene is best seen from.
struct SceneView {
  double azimuth = 0.0;                          ///< of the eye around z [rad]: 0 on the +x side
  double elevation = 0.0;                        ///< above the horizon [rad]
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box that holds what happens [m]
  std::vector<SceneBlock> blocks;
  std::vector<SceneColumn> columns;
};

/// Everything about a scene; constant once built.
struct EngineScene {
  std::string name;
  ClothModel model;
  ClothMaterial material;
  SimulationOptions options;
  ClothState start;
  std::vector<GraspSpec> hands;               ///< how each hand grips; at most kMostHands
  std::unique_ptr<const SceneMotion> motion;  ///< none: nothing moves, and there are no hands
  double seconds = 0.0;                       ///< how long there is something to see [s]
  double picture_time = 0.0;                  ///< when a picture shows what it is about [s]; 0: at the end
  bool about_speed = false;                   ///< a solver without time has nothing to say about it
  SceneView view;

  /// When to take a picture [s]. Thread class: any.
  double shown_at() const noexcept { return picture_time > 0.0 ? picture_time : seconds; }
};

/// Which holds of a simulation the hands of a scene have.
struct SceneHolds {
  SceneHolds() noexcept { holds.fill(-1); }
  std::array<int, kMostHands> holds{};  ///< by hand; -1: it does not hold
};

/// One tick: hands and pins to where they are at `time` + dt, then a step.
/// @param simulation of the scene's model  @param time of the scene's motion [s]  @param dt [s], > 0. Thread
/// class: real-time.
StepReport drive_from(double time, ClothSimulation& simulation, const EngineScene& scene, SceneHolds& holds,
                      double dt) noexcept;
/// The same where the motion began with the cloth: from simulation.time(). Thread class: real-time.
StepReport drive(ClothSimulation& simulation, const EngineScene& scene, SceneHolds& holds,
                 double dt) noexcept;

/// The same with hands that go where they are told. Pins follow the scene as ever.
/// @param now where the hands are at the start of the tick, by hand; the scene's hands @param then at its end
StepReport drive(ClothSimulation& simulation, const EngineScene& scene, SceneHolds& holds,
                 std::span<const HandMoment> now, std::span<const HandMoment> then, double dt) noexcept;

/// A run, frozen: restore() of it continues bit for bit.
struct SceneSnapshot {
  ClothState cloth;
  std::array<std::optional<Grasp>, kMostHands> grasps;  ///< by hand; none: it does not hold
};

/// A scene in time, by whichever solver. The scene must outlive it. One thread calls all of it.
class SceneRun {
 public:
  /// Allocates, and puts the cloth where the scene starts; of the scene's options it takes all but the
  /// solver.
  /// @param inner_steps as in ClothSolverOptions
  /// @throws Error as ClothSimulation does, and (kUsage) for a scene that the solver has nothing to say
  /// about. Thread class: set-up.
  explicit SceneRun(const EngineScene& scene, SolverKind kind = SolverKind::kImplicit, int inner_steps = 0);

  /// One tick, see drive(). Thread class: real-time.
  StepReport step(double dt) noexcept { return drive(*simulation_, *scene_, holds_, dt); }
  /// One tick with hands that go where they are told. Thread class: real-time.
  StepReport step(std::span<const HandMoment> now, std::span<const HandMoment> then, double dt) noexcept {
    return drive(*simulation_, *scene_, holds_, now, then, dt);
  }
  /// What a hand feels after the last step; a reading that does not hold when there is no such hand.
  /// Thread class: real-time.
  GraspReading hand_reading(std::size_t hand) const noexcept;
  /// Where a hand is now. Thread class: real-time.
  HandMoment hand(std::size_t hand) const noexcept;

  void snapshot(SceneSnapshot& snapshot) const;  ///< Thread class: set-up.
  void restore(const SceneSnapshot& snapshot);   ///< Thread class: set-up.
  const EngineScene& scene() const noexcept { return *scene_; }
  ClothSimulation& simulation() noexcept { return *simulation_; }
  const ClothSimulation& simulation() const noexcept { return *simulation_; }

 protected:
  SceneRun(const EngineScene& scene, std::unique_ptr<ClothSimulation> simulation);

 private:
  const EngineScene* scene_;
  std::unique_ptr<ClothSimulation> simulation_;
  SceneHolds holds_;
};

/// The same by the implicit solver of T, float or double.
template <class T>
class SceneRunner : public SceneRun {
 public:
  /// @throws Error (kUsage) as Simulation does. Thread class: set-up.
  explicit SceneRunner(const EngineScene& scene)
      : SceneRun(scene, std::make_unique<Simulation<T>>(scene.model, scene.material, scene.options)) {}

  Simulation<T>& simulation() noexcept { return static_cast<Simulation<T>&>(SceneRun::simulation()); }
  const Simulation<T>& simulation() const noexcept {
    return static_cast<const Simulation<T>&>(SceneRun::simulation());
  }
};

}  // namespace fuai
