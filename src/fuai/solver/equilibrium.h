// Static shapes: the cloth at rest under its loads.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/equilibrium.md.
//
// Descent in growing pseudo-time steps on the incremental potential (implicit.h), in double. A drape has many
// equilibria: which one is found is settled by the start, the loading path and the perturbation, all stated.
#pragma once

#include <cstdint>

#include "fuai/core/progress.h"
#include "fuai/solver/implicit.h"

namespace fuai {

/// How to get there and when to stop.
struct EquilibriumOptions {
  double tolerance = 1e-4;     ///< force out of balance, root of the sum of squares, as a part of the weight
  double least_force = 1e-12;  ///< the same without weight [N]
  int most_steps = 5000;       ///< of all load steps together
  int load_steps = 1;          ///< gravity grows in so many equal steps, the friction memory moves after each
  double first_dt = 0.01;      ///< of the pseudo-time [s]
  double largest_move = 0.5;   ///< of a slot in one step [spacings]
  int iterations = 200;        ///< conjugate gradients a step, at most
  double reduction = 0.1;      ///< and down to this part of the residual
  std::uint64_t seed = 0;      ///< of the perturbation
  double perturbation = 0.0;   ///< largest random shift of a free slot along z before the start [m]
  bool guards = false;         ///< search back along each step for a lower energy: slower, ends limit cycles
  Vec3 gravity = {0.0, 0.0, -kStandardGravity};
  Preconditioner preconditioner = Preconditioner::kYarnLines;
};

/// What was reached.
struct EquilibriumReport {
  bool converged = false;
  int steps = 0;
  int iterations = 0;     ///< conjugate gradients
  double residual = 0.0;  ///< part of the weight, or [N] without weight
};

/// Moves the state to equilibrium; velocities are zero afterwards, the memory is committed.
/// @throws Error (kUsage) for options out of range. Thread class: set-up.
EquilibriumReport find_equilibrium(const ClothModel& model, const ClothMaterial& material, ClothState& state,
                                   const EquilibriumOptions& options = {}, const Progress& progress = {});

}  // namespace fuai
