// Bicubic interpolation of a piece onto another lattice.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/refine.h"

#include <algorithm>
#include <cmath>

#include "fuai/cloth/smooth_surface.h"
#include "fuai/core/error.h"

namespace fuai {

ClothState refine_state(const ClothModel& coarse, const ClothState& state, const ClothModel& fine) {
  if (state.positions.size() != static_cast<std::size_t>(coarse.slot_count()))
    throw Error(ErrorKind::kUsage, "the state does not belong to the coarse model");
  const SmoothSurface shape(coarse, state.positions);
  ClothState result = make_cloth_state(fine);
  for (int row = 0; row < fine.rows; ++row) {
    for (int column = 0; column < fine.columns; ++column) {
      const auto slot = static_cast<std::size_t>(fine.slot(column, row));
      if (fine.live[slot] == 0) continue;
      const Vec2 place = (fine.material(column, row) - coarse.origin) / coarse.spacing;
      result.positions[slot] = shape.at(fine.material(column, row));
      const int near_column = std::clamp(static_cast<int>(std::lround(place.x())), 0, coarse.columns - 1);
      const int near_row = std::clamp(static_cast<int>(std::lround(place.y())), 0, coarse.rows - 1);
      const auto near = static_cast<std::size_t>(coarse.slot(near_column, near_row));
      result.weft_bending[slot] = state.weft_bending[near];
      result.warp_bending[slot] = state.warp_bending[near];
      result.shear[slot] = state.shear[near];
      result.weft_tension[slot] = state.weft_tension[near];
      result.warp_tension[slot] = state.warp_tension[near];
    }
  }
  result.time = state.time;
  return result;
}

}  // namespace fuai
