// How far the force that was felt is from the cloth's: a session against a converged solve of its own path.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "fuai/core/progress.h"
#include "fuai/haptics/virtual_session.h"
#include "fuai/sim/simulation.h"

namespace fuai {

/// What is solved again.
struct ReferenceCloth {
  const ClothModel* model = nullptr;        ///< not owned
  const ClothMaterial* material = nullptr;  ///< not owned
  ImplicitOptions implicit;                 ///< gravity, wind; how it is solved is the reference's own affair
  const ClothState* start = nullptr;        ///< not owned
  GraspSpec grasp;
};

/// Forces on the hand along the recorded path of the tool: double precision, a step a record, every step
/// solved until the force out of balance has fallen to rounding. The cloth's coordinates.
/// @return [N] (records). @throws Error as ClothSimulation. Thread class: set-up.
std::vector<Vec3> converged_forces(const ReferenceCloth& cloth, std::span<const TickRecord> records,
                                   const Progress& progress = {});

/// Differences.
struct ForceError {
  double rms = 0.0;       ///< root of the sum of |F - R|^2 over that of |R|^2
  double peak = 0.0;      ///< largest |F - R| over the largest |R|
  std::size_t ticks = 0;  ///< that count: at full gain, with cloth in the hand
};

/// @param map that the session ended with: turns the felt forces back. Thread class: set-up.
ForceError compare_forces(std::span<const TickRecord> records, std::span<const Vec3> reference,
                          const WorkspaceMap& map);

}  // namespace fuai
