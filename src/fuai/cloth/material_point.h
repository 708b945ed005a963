// Points of a piece between its slots: their weights and where they are now.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "fuai/cloth/cloth_model.h"

namespace fuai {

/// The point in terms of the four slots of a cell (bilinear; weights leave [0, 1] outside the cell). Corners
/// that it does not need have no part in it: a point on a yarn hangs on two slots, a point in a slot on one.
/// @param cell index of a cell with cloth @param point lattice coordinates (cut_cells.h). Thread class: any.
MaterialPoint make_cell_point(const ClothModel& model, int cell, const Vec2& point) noexcept;

/// Any point of the piece, from its own or else the nearest cell with cloth.
/// @param material weft and warp coordinate [m]. Thread class: any.
MaterialPoint make_material_point(const ClothModel& model, const Vec2& material) noexcept;

/// Where the point is now [m]. @param positions [m] (slots). Thread class: real-time.
inline Vec3 material_position(const MaterialPoint& point, std::span<const Vec3> positions) noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < point.slots.size(); ++i) {
    sum += point.weights[i] * positions[static_cast<std::size_t>(point.slots[i])];
  }
  return sum;
}

}  // namespace fuai
