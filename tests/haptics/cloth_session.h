// A hand that pulls cloth through a simulated device, in virtual time, with the true books of its port.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fuai/core/smooth_rise.h"
#include "fuai/haptics/cloth_hand.h"
#include "fuai/haptics/force_error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/scenes/engine_scenes.h"
#include "fuai/sim/felt_options.h"
#include "wide_open.h"

namespace fuai_test {

/// Every bundled fabric, also those that came later.
inline std::vector<std::string> every_fabric() {
  std::vector<std::string> ids = fuai::bundled_fabric_ids();
  REQUIRE(ids.size() >= 8);
  return ids;
}

/// What is tried.
struct ClothTrial {
  std::string fabric = "wool-tropical";
  bool bending = false;  ///< the sheet that is bent without gravity; else the one that hangs and is pulled
  int size = 9;
  double spacing = 0.02;  ///< [m]
  std::string device = "premium";
  std::string hand = "arm";
  double seconds = 0.8;
  double cloth_rate = 0.0;  ///< [Hz]; 0: with every tick
  bool tangent = false;
  bool control = true;
  double push = 0.0;  ///< along the path from 0.2 s on, besides the hand [N]
};

/// Everything that a trial needs, in its place.
class ClothSession {
 public:
  explicit ClothSession(const ClothTrial& trial)
      : scene(make_scene(trial)),
        spec(make_spec(trial)),
        cloth(scene.model, scene.material,
              {fuai::SolverKind::kImplicit, fuai::make_felt_options(scene.options.implicit), 0}, scene.start,
              grasp(), hand_options(trial)),
        device(spec, fuai::find_hand_model(trial.hand), motion(trial)),
        path(path_options(trial)),
        session(device, path, cloth,
                {period(trial), period(trial), static_cast<std::size_t>(std::lround(trial.seconds / kTick))}),
        ticks(std::lround(trial.seconds / kTick)),
        alone(trial.hand == "none"),
        steady(trial.push) {
    stored_at_start_ = cloth.simulation().stored_energy(scratch_);
  }

  /// One tick; with the cloth's steps the books are drawn up.
  void tick(long number) {
    // Nobody holds the device: a push of a tenth of a second, then it is left to the cloth.
    const bool pushed = alone && number > 100 && number < 200;
    device.push((pushed ? 0.5 : number >= 200 ? steady : 0.0) * way.normalized());
    const double work = device.work_received();
    const std::uint64_t steps = session.cloth_steps();
    session.tick(kTick);
    if (session.cloth_steps() == steps || number % 5 != 0) return;
    // What the hand put in and what is not in the cloth is lost; it must not be negative.
    const double lost = work + stored_at_start_ - cloth.simulation().stored_energy(scratch_);
    least_lost = std::min(least_lost, lost);
  }
  void run() {
    for (long i = 0; i < ticks; ++i) tick(i);
  }
  fuai::GraspSpec grasp() const {
    fuai::GraspSpec grip = scene.hands.front();
    grip.stiffness = std::min(grip.stiffness, spec.info.stable_stiffness);
    return grip;
  }
  fuai::ForceError error() const {
    const auto reference = fuai::converged_forces(
        {&scene.model, &scene.material, scene.options.implicit, &scene.start, grasp()}, session.records());
    return fuai::compare_forces(session.records(), reference, path.map());
  }

  fuai::Vec3 way;  // of the hand there and back [m]; first, because the motion sets it
  fuai::EngineScene scene;
  fuai::SimulatedDeviceSpec spec;
  fuai::ClothHand cloth;
  fuai::SimulatedDevice device;
  fuai::ForcePath path;
  fuai::VirtualSession session;
  long ticks;
  bool alone;
  double steady;
  double least_lost = std::numeric_limits<double>::infinity();  ///< [J]

 private:
  static fuai::EngineScene make_scene(const ClothTrial& trial) {
    const fuai::FabricLaws laws = fuai::make_fabric_laws(fuai::load_fabric(trial.fabric));
    const fuai::SceneOptions options{trial.size, trial.spacing};
    return trial.bending ? fuai::make_bending(laws, options) : fuai::make_taut_patch(laws, options);
  }
  static fuai::SimulatedDeviceSpec make_spec(const ClothTrial& trial) {
    fuai::SimulatedDeviceSpec device_spec = fuai::find_device_preset(trial.device);
    device_spec.info.rate = 1.0 / kTick;
    return device_spec;
  }
  static fuai::ClothHandOptions hand_options(const ClothTrial& trial) {
    fuai::ClothHandOptions options;
    options.tangent = trial.tangent;
    return options;
  }
  static double period(const ClothTrial& trial) {
    return trial.cloth_rate > 0.0 ? 1.0 / trial.cloth_rate : 0.0;
  }
  std::unique_ptr<const fuai::HandMotion> motion(const ClothTrial& trial) {
    const double side = scene.model.spacing * (scene.model.columns - 1);
    // Aside until the yarns are taut, or up and back as an arm bends a sheet.
    way = trial.bending ? fuai::Vec3(0.0, -0.09 * side, 0.3 * side)
                        : fuai::Vec3(0.22 * side, -0.07 * side, -0.01 * side);
    const double begins = 0.1, ends = trial.seconds - 0.05, middle = 0.5 * (begins + ends);
    if (!trial.bending) return fuai::make_reach_motion(fuai::Vec3(0, 0, 0), way, {begins, ends});
    // Along the arc that the edge of a bending sheet goes: back with the square of the height.
    std::vector<fuai::Vec3> points;
    for (double t = 0.0; t <= trial.seconds; t += 0.002) {
      const double up = fuai::smooth_rise(t, begins, middle) - fuai::smooth_rise(t, middle, ends);
      points.emplace_back(0.0, up * up * way.y(), up * way.z());
    }
    return fuai::make_path_motion(std::move(points), 0.002);
  }
  fuai::ForcePathOptions path_options(const ClothTrial& trial) const {
    fuai::ForcePathOptions options = fuai::make_force_path_options(spec.info);
    options.safety.ramp = 0.05;
    options.passivity.control = trial.control;
    options.map.cloth_centre = cloth.patch();
    return options;
  }

  fuai::ClothState scratch_;
  double stored_at_start_ = 0.0;
};

}  // namespace fuai_test
