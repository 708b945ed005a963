// Runs a scene of the engine.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/scenes/engine_scene.h"

#include <algorithm>
#include <string>
#include <utility>

#include "fuai/core/error.h"

namespace fuai {
namespace {

std::unique_ptr<ClothSimulation> simulate(const EngineScene& scene, SolverKind kind, int inner_steps) {
  const SolverEntry& solver = solver_entry(kind);
  if (scene.about_speed && !solver.has_time) {
    throw Error(
        ErrorKind::kUsage,
        "'" + scene.name + "' is about speed, and the solver '" + std::string(solver.name) + "' has no time",
        {"", 0, 0, "solver"}, "take another scene or another solver");
  }
  return std::make_unique<ClothSimulation>(scene.model, scene.material,
                                           ClothSolverOptions{kind, scene.options.implicit, inner_steps},
                                           scene.options.most_grasps);
}

}  // namespace

Vec3 SceneMotion::fixed_move(const Vec3& /*start*/, double /*time*/) const noexcept { return Vec3::Zero(); }

namespace {

/// Hands: let go, grip where the hand was at the start of the tick, carry.
void carry(ClothSimulation& simulation, const EngineScene& scene, SceneHolds& holds,
           std::span<const HandMoment> now, std::span<const HandMoment> then) noexcept {
  for (std::size_t i = 0; i < std::min(now.size(), then.size()); ++i) {
    int& hold = holds.holds[i];
    if (!then[i].holds) {
      simulation.release(hold);
      hold = -1;
      continue;
    }
    if (hold < 0) hold = simulation.grasp(scene.hands[i], now[i].position);
    simulation.move_grasp(hold, then[i].position, then[i].rotation);
  }
}

/// Pins, to where the motion has them at `time`.
void place_pins(ClothSimulation& simulation, const EngineScene& scene, double time) noexcept {
  if (!scene.motion || !scene.motion->moves_fixed()) return;
  const std::vector<Vec3>& start = scene.start.positions;
  for (std::size_t slot = 0; slot < start.size(); ++slot) {
    if (scene.model.fixed[slot] == 0) continue;
    simulation.place_fixed(static_cast<int>(slot), start[slot] + scene.motion->fixed_move(start[slot], time));
  }
}

}  // namespace

StepReport drive(ClothSimulation& simulation, const EngineScene& scene, SceneHolds& holds,
                 double dt) noexcept {
  return drive_from(simulation.time(), simulation, scene, holds, dt);
}

StepReport drive_from(double time, ClothSimulation& simulation, const EngineScene& scene, SceneHolds& holds,
                      double dt) noexcept {
  std::array<HandMoment, kMostHands> now, then;
  const std::size_t hands = scene.motion ? std::min(scene.hands.size(), kMostHands) : 0;
  for (std::size_t i = 0; i < hands; ++i) {
    now[i] = scene.motion->hand(i, time);
    then[i] = scene.motion->hand(i, time + dt);
  }
  carry(simulation, scene, holds, {now.data(), hands}, {then.data(), hands});
  place_pins(simulation, scene, time + dt);
  return simulation.step(dt);
}

StepReport drive(ClothSimulation& simulation, const EngineScene& scene, SceneHolds& holds,
                 std::span<const HandMoment> now, std::span<const HandMoment> then, double dt) noexcept {
  carry(simulation, scene, holds, now, then);
  place_pins(simulation, scene, simulation.time() + dt);
  return simulation.step(dt);
}

SceneRun::SceneRun(const EngineScene& scene, std::unique_ptr<ClothSimulation> simulation)
    : scene_(&scene), simulation_(std::move(simulation)) {
  simulation_->restore(scene.start);
}

SceneRun::SceneRun(const EngineScene& scene, SolverKind kind, int inner_steps)
    : SceneRun(scene, simulate(scene, kind, inner_steps)) {}

GraspReading SceneRun::hand_reading(std::size_t hand) const noexcept {
  return hand < kMostHands ? simulation_->grasp_reading(holds_.holds[hand]) : GraspReading{};
}

HandMoment SceneRun::hand(std::size_t hand) const noexcept {
  if (!scene_->motion || hand >= scene_->hands.size()) return {};
  return scene_->motion->hand(hand, simulation_->time());
}

void SceneRun::snapshot(SceneSnapshot& snapshot) const {
  simulation_->snapshot(snapshot.cloth);
  for (std::size_t i = 0; i < kMostHands; ++i) {
    const Grasp* grasp = simulation_->held(holds_.holds[i]);
    snapshot.grasps[i] = grasp ? std::optional<Grasp>(*grasp) : std::nullopt;
  }
}

void SceneRun::restore(const SceneSnapshot& snapshot) {
  simulation_->restore(snapshot.cloth);
  for (std::size_t i = 0; i < kMostHands; ++i)
    holds_.holds[i] = snapshot.grasps[i] ? simulation_->take_over(*snapshot.grasps[i]) : -1;
}

}  // namespace fuai
