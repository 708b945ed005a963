// The paper's drape test: a square sheet with one corner block held on a table corner, let go from flat.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", section 4.1 (Fig. 4).
#pragma once

#include <memory>

#include "fuai/solver/relaxation.h"

namespace fuai {

/// The drape; the defaults are the paper's 18 x 18 particles with 5 x 5 of them fixed, at 1 cm.
struct PaperDrapeOptions {
  double edge = 0.17;        ///< side of the sheet [m]
  double fixed_edge = 0.04;  ///< side of the fixed block [m]
  double spacing = 0.01;     ///< l0 [m]; both sides must be whole multiples
  RelaxationOptions relaxation;
};

/// Model, state and solver, ready to run. The free corner is the last node.
struct PaperDrape {
  std::unique_ptr<const LatticeModel> model;
  std::unique_ptr<const FabricLaws> laws;
  LatticeState state;
  SolverRelaxation solver;

  /// Where the corner opposite to the table is [m]; the sheet started at z = 0.
  const Vec3& free_corner() const { return state.positions.back(); }
};

/// Builds the drape.
/// @throws Error (kUsage) when the sides are not whole multiples of the spacing, the block does not fit, or
/// the solver refuses its options. Thread class: set-up.
PaperDrape make_paper_drape(const FabricLaws& laws, const PaperDrapeOptions& options = {});

}  // namespace fuai
