// The converged solve of a recorded path.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/force_error.h"

#include <algorithm>
#include <cmath>

#include "fuai/haptics/cloth_hand.h"
#include "fuai/sim/felt_options.h"

namespace fuai {
namespace {

/// As far as double goes: a step ends where rounding leaves it.
ImplicitOptions converged(const ImplicitOptions& options) {
  ImplicitOptions o = options;
  o.implicitness = kFeltImplicitness;
  o.iterations = 300;
  o.linearisations = 12;
  o.relinearise = 1e-7;
  o.noise_floor = 0.0;
  o.reduction = 1e-7;
  return o;
}

}  // namespace

std::vector<Vec3> converged_forces(const ReferenceCloth& cloth, std::span<const TickRecord> records,
                                   const Progress& progress) {
  ClothSimulation simulation(*cloth.model, *cloth.material,
                             {SolverKind::kDouble, converged(cloth.implicit), 0}, 1);
  simulation.restore(*cloth.start);
  std::vector<Vec3> forces;
  forces.reserve(records.size());
  int hold = -1;
  for (const TickRecord& record : records) {
    // The tool took hold with its first step, and again whenever it wanted to.
    if (record.holds && hold < 0) hold = simulation.grasp(cloth.grasp, record.tool);
    if (!record.holds) {
      simulation.release(hold);
      hold = -1;
    }
    simulation.move_grasp(hold, record.tool);
    simulation.step(record.dt);
    forces.push_back(simulation.grasp_reading(hold).force);
    if (progress && forces.size() % 16 == 0)
      progress("converged solve", static_cast<double>(forces.size()) / static_cast<double>(records.size()));
  }
  return forces;
}

ForceError compare_forces(std::span<const TickRecord> records, std::span<const Vec3> reference,
                          const WorkspaceMap& map) {
  ForceError error;
  double difference = 0.0, size = 0.0, farthest = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < std::min(records.size(), reference.size()); ++i) {
    // Letting go takes the felt force some ticks of 0.1 N; there is no cloth then to compare it with.
    if (!(records[i].tick.gain >= 1.0) || !records[i].holds) continue;
    const Vec3 felt = map.rotation * records[i].tick.force / map.force_gain;
    const double off = (felt - reference[i]).norm();
    difference += off * off;
    size += reference[i].squaredNorm();
    farthest = std::max(farthest, off);
    largest = std::max(largest, reference[i].norm());
    ++error.ticks;
  }
  if (size > 0.0) error.rms = std::sqrt(difference / size);
  if (largest > 0.0) error.peak = farthest / largest;
  return error;
}

}  // namespace fuai
