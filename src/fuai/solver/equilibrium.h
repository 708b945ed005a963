// Static shapes: the cloth at rest under its loads.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/equilibrium.md.
//
// Descent in growing pseudo-time steps on the incremental potential (implicit.h), in double. A drape has many
// equilibria: which one is found is settled by the start, the loading path and the perturbation, all stated.
#pragma once

#include <cstdint>
#include <span>

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
  double largest_move = 1.0;   ///< of a slot in one step [spacings]
  int iterations = 300;        ///< conjugate gradients a step, at most
  double reduction = 0.1;      ///< and down to this part of the residual
  std::uint64_t seed = 0;      ///< of the perturbation
  double perturbation = 0.0;   ///< largest random shift of a free slot along z before the start [m]
  bool guards = false;         ///< search back along each step for a lower energy: a slower step, no leaps
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

/// The same from coarse to fine: each lattice starts from the shape of the one before, so that a fine one
/// finds the folds of the coarse one in a fraction of the steps. Coarse lattices are solved to
/// kCoarseTolerance.
/// @param levels models of one piece, coarse first; the last is that of `state`, whose positions give the
/// start and the places of fixed slots on every level
/// @return of the last level, with the steps and iterations of all.
/// @throws Error (kUsage) for options out of range or no level. Thread class: set-up.
EquilibriumReport find_equilibrium_nested(std::span<const ClothModel> levels, const ClothMaterial& material,
                                          ClothState& state, const EquilibriumOptions& options = {},
                                          const Progress& progress = {});

/// Tolerance on the coarse levels of a nested solve [part of the weight]: enough for the folds to be where
/// they belong; smaller wastes steps on a shape that the next level changes.
inline constexpr double kCoarseTolerance = 1e-2;

}  // namespace fuai
