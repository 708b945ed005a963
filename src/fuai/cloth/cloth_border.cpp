// Makes border points.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/cloth_border.h"

#include <algorithm>
#include <cmath>

#include "fuai/cloth/cut_cells.h"
#include "fuai/cloth/material_point.h"

namespace fuai {
namespace {

/// A yarn that meets a side of the outline.
struct Crossing {
  double share;  ///< of the side, from its first corner
  int axis;      ///< 0: a warp yarn, x = line; 1: a weft yarn, y = line
  double line;
};

/// The point at the crossing has its own coordinate on the yarn exactly, so that it hangs on two slots.
Vec2 place(const Crossing& crossing, const Vec2& a, const Vec2& b) {
  Vec2 point = a + crossing.share * (b - a);
  point[crossing.axis] = crossing.line;
  return point;
}

std::vector<Crossing> crossings_of_side(const Vec2& a, const Vec2& b) {
  std::vector<Crossing> crossings;
  const double snap = kLatticeSnap / (b - a).norm();  // a crossing this near to a corner is the corner
  for (int axis : {0, 1}) {
    const double low = std::min(a[axis], b[axis]), high = std::max(a[axis], b[axis]);
    for (double line = std::floor(low) + 1.0; line < high; line += 1.0) {
      const double share = (line - a[axis]) / (b[axis] - a[axis]);
      if (share > snap && share < 1.0 - snap) crossings.push_back({share, axis, line});
    }
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& p, const Crossing& q) { return p.share < q.share; });
  // Through a slot: both its yarns cross in the same place.
  const auto last =
      std::unique(crossings.begin(), crossings.end(),
                  [&](const Crossing& p, const Crossing& q) { return q.share - p.share < snap; });
  crossings.erase(last, crossings.end());
  return crossings;
}

/// The low slot of the edge of the crossing's yarn that holds the point, or of the next edge either way; -1
/// when none of them has cloth, as in a tip narrower than a yarn.
int edge_of_crossing(const ClothModel& model, const Crossing& crossing, const Vec2& point) {
  const int axis = 1 - crossing.axis;  // along the yarn
  const std::vector<double>& edge_area = axis == 0 ? model.weft_edge_area : model.warp_edge_area;
  const int line = static_cast<int>(crossing.line), here = static_cast<int>(std::floor(point[axis]));
  const int edges = (axis == 0 ? model.columns : model.rows) - 1;
  for (int edge : {here, here - 1, here + 1}) {
    if (edge < 0 || edge >= edges) continue;
    const int slot = axis == 0 ? model.slot(edge, line) : model.slot(line, edge);
    if (edge_area[static_cast<std::size_t>(slot)] > 0.0) return slot;
  }
  return -1;
}

}  // namespace

std::vector<MaterialPoint> make_border(const Polygon& outline, const ClothModel& model) {
  std::vector<MaterialPoint> border;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    border.push_back(make_cell_point(model, nearest_cell(model, a), a));
    for (const Crossing& crossing : crossings_of_side(a, b)) {
      // On a lattice line the other two corners of whatever cell have no weight.
      const Vec2 point = place(crossing, a, b);
      const int edge = edge_of_crossing(model, crossing, point);
      border.push_back(make_cell_point(model, edge >= 0 ? edge : nearest_cell(model, point), point));
    }
  }
  return border;
}

}  // namespace fuai
