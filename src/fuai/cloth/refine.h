// Carries the shape of a coarse piece over to a finer lattice of the same piece.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/equilibrium.md, "From coarse to fine".
#pragma once

#include "fuai/cloth/cloth_model.h"

namespace fuai {

/// Positions by bicubic interpolation over the material coordinates, continued straight beyond the outermost
/// slots, so that a bent sheet stays smooth; friction memory from the nearest slot; at rest. Fixed slots too
/// are interpolated: place them afterwards where they must be exact.
/// @param coarse,state the solved piece @param fine the same piece with another spacing or lattice shift
/// @throws Error (kUsage) when the state does not belong to the model. Thread class: set-up.
ClothState refine_state(const ClothModel& coarse, const ClothState& state, const ClothModel& fine);

}  // namespace fuai
