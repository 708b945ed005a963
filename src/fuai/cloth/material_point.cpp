// Finds the weights of points between slots.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/material_point.h"

#include <algorithm>

#include "fuai/cloth/cut_cells.h"

namespace fuai {

MaterialPoint make_cell_point(const ClothModel& model, int cell, const Vec2& point) noexcept {
  const int column = cell % model.columns, row = cell / model.columns;
  const double u = point.x() - column, v = point.y() - row;
  const std::array<int, 4> slots = {cell, cell + 1, cell + model.columns, cell + model.columns + 1};
  const std::array<double, 4> weights = {(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v};
  MaterialPoint result;
  result.material = model.origin + model.spacing * point;
  std::size_t used = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (weights[i] == 0.0) continue;
    result.slots[used] = slots[i];
    result.weights[used++] = weights[i];
  }
  std::fill(result.slots.begin() + static_cast<std::ptrdiff_t>(used), result.slots.end(), result.slots[0]);
  return result;
}

MaterialPoint make_material_point(const ClothModel& model, const Vec2& material) noexcept {
  const Vec2 point = (material - model.origin) / model.spacing;
  return make_cell_point(model, nearest_cell(model, point), point);
}

}  // namespace fuai
