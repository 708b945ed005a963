// Cuts outlines into cells and finds the cells with cloth.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/cut_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace fuai {
namespace {

/// Cells [low, high) of the lattice.
struct Block {
  int low[2], high[2];
  int size(int axis) const { return high[axis] - low[axis]; }
};

/// Halves the block and what lies in it until a block is empty, full or a single cell.
void cut(const std::vector<Polygon>& polygons, const Block& block, int columns, CutCells& cells) {
  if (polygons.empty()) return;
  double area = 0.0;
  for (const Polygon& polygon : polygons) area += polygon_area(polygon);
  // Corners on lattice lines are whole numbers, so a full block has exactly its area.
  if (area == static_cast<double>(block.size(0)) * block.size(1)) {
    for (int row = block.low[1]; row < block.high[1]; ++row) {
      const auto begin = cells.full.begin() + static_cast<std::ptrdiff_t>(row) * columns;
      std::fill(begin + block.low[0], begin + block.high[0], std::uint8_t{1});
    }
    return;
  }
  if (block.size(0) == 1 && block.size(1) == 1) {
    for (const Polygon& polygon : polygons)
      cells.pieces.push_back({block.low[1] * columns + block.low[0], polygon});
    return;
  }
  const int axis = block.size(0) >= block.size(1) ? 0 : 1;
  const int middle = (block.low[axis] + block.high[axis]) / 2;
  std::vector<Polygon> halves[2];
  for (const Polygon& polygon : polygons) {
    SplitPolygon split = split_polygon(polygon, axis, middle);
    std::move(split.low.begin(), split.low.end(), std::back_inserter(halves[0]));
    std::move(split.high.begin(), split.high.end(), std::back_inserter(halves[1]));
  }
  Block low = block, high = block;
  low.high[axis] = high.low[axis] = middle;
  cut(halves[0], low, columns, cells);
  cut(halves[1], high, columns, cells);
}

}  // namespace

Polygon to_lattice(const Polygon& outline, const Vec2& origin, double spacing) {
  Polygon lattice;
  for (const Vec2& p : outline) lattice.push_back((p - origin) / spacing);
  const Polygon exact = lattice;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const std::size_t j = (i + 1) % exact.size();
    for (int axis : {0, 1}) {
      const double line = std::round(exact[i][axis]);
      if (std::abs(exact[i][axis] - line) < kLatticeSnap && std::abs(exact[j][axis] - line) < kLatticeSnap) {
        lattice[i][axis] = lattice[j][axis] = line;
      }
    }
  }
  return lattice;
}

CutCells make_cut_cells(const Polygon& outline, int columns, int rows) {
  CutCells cells;
  cells.full.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  cut({outline}, {{0, 0}, {columns - 1, rows - 1}}, columns, cells);
  return cells;
}

int nearest_cell(const ClothModel& model, const Vec2& point) noexcept {
  const int most = std::max(model.columns, model.rows);
  const int column = static_cast<int>(std::clamp(std::floor(point.x()), 0.0, model.columns - 2.0));
  const int row = static_cast<int>(std::clamp(std::floor(point.y()), 0.0, model.rows - 2.0));
  int best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  // Square rings about the point's own cell: a cell of ring k is at least k - 1 away.
  for (int ring = 0; ring <= most && best_distance > std::max(0, ring - 1) * std::max(0, ring - 1); ++ring) {
    for (int r = std::max(0, row - ring); r <= std::min(model.rows - 2, row + ring); ++r) {
      const int step = std::abs(r - row) == ring || ring == 0 ? 1 : 2 * ring;
      for (int c = column - ring; c <= column + ring; c += step) {
        if (c < 0 || c > model.columns - 2) continue;
        const int cell = model.slot(c, r);
        if (!(model.cell_area[static_cast<std::size_t>(cell)] > 0.0)) continue;
        const Vec2 low(c, r);
        const double distance = (point - point.cwiseMax(low).cwiseMin(low + Vec2::Ones())).squaredNorm();
        if (distance < best_distance || (distance == best_distance && cell < best)) {
          best = cell;
          best_distance = distance;
        }
      }
    }
  }
  return best;
}

}  // namespace fuai
