// Makes meshes of cloth pieces.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/piece_mesh.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "fuai/cloth/cut_cells.h"
#include "fuai/cloth/material_point.h"
#include "fuai/core/assertion.h"

namespace fuai {
namespace {

/// Smaller triangles are rounding, not cloth [cells].
constexpr double kLeastTriangle = 1e-13;

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Whether p lies in the triangle or on its sides, its corners not counted.
bool covers(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
  if (p == a || p == b || p == c) return false;
  return twice_area(a, b, p) >= 0.0 && twice_area(b, c, p) >= 0.0 && twice_area(c, a, p) >= 0.0;
}

/// Area over squared longest side: 0 for a sliver.
double shape(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0.0 ? twice_area(a, b, c) / longest : 0.0;
}

/// Position in `left` of the corner to cut off next: of those whose ear holds no other corner the
/// best-shaped.
std::size_t best_ear(const Polygon& polygon, const std::vector<int>& left) {
  const auto corner = [&](std::size_t k) -> const Vec2& {
    return polygon[static_cast<std::size_t>(left[k % left.size()])];
  };
  std::size_t best = 0;
  double best_shape = -1.0;
  for (std::size_t k = 0; k < left.size(); ++k) {
    const Vec2 &a = corner(k + left.size() - 1), &b = corner(k), &c = corner(k + 1);
    const double ear_shape = shape(a, b, c);
    if (ear_shape < 0.0 || ear_shape <= best_shape) continue;
    bool empty = true;
    for (std::size_t other = 0; empty && other < left.size(); ++other)
      empty = !covers(a, b, c, corner(other));
    if (!empty) continue;
    best = k;
    best_shape = ear_shape;
  }
  return best;
}

/// Collects vertices and triangles; a place has one vertex, found by the bits of its lattice coordinates.
class Builder {
 public:
  explicit Builder(const ClothModel& model) : model_(model) {}

  int vertex(int cell, const Vec2& point) {
    const auto [entry, added] =
        index_.try_emplace({point.x(), point.y()}, static_cast<int>(piece_.vertices.size()));
    if (added) {
      piece_.vertices.push_back(make_cell_point(model_, cell, point));
      piece_.mesh.material.push_back(piece_.vertices.back().material);
    }
    return entry->second;
  }

  void add_full_cell(int cell) {
    const int column = cell % model_.columns, row = cell / model_.columns;
    const int p00 = vertex(cell, Vec2(column, row)), p10 = vertex(cell, Vec2(column + 1, row));
    const int p01 = vertex(cell, Vec2(column, row + 1)), p11 = vertex(cell, Vec2(column + 1, row + 1));
    auto& triangles = piece_.mesh.triangles;
    if ((row + column) % 2 == 0) {
      triangles.insert(triangles.end(), {{p00, p10, p11}, {p00, p11, p01}});
    } else {
      triangles.insert(triangles.end(), {{p00, p10, p01}, {p10, p11, p01}});
    }
  }

  void add_piece(int cell, const Polygon& polygon) {
    for (const auto& [a, b, c] : triangulate(polygon)) {
      const auto corner = [&](int i) { return vertex(cell, polygon[static_cast<std::size_t>(i)]); };
      const int va = corner(a), vb = corner(b), vc = corner(c);
      piece_.mesh.triangles.push_back({va, vb, vc});
    }
  }

  PieceMesh finish(std::span<const Vec3> positions) {
    piece_.mesh.positions.resize(piece_.vertices.size());
    update_piece_mesh(piece_, positions);
    return std::move(piece_);
  }

 private:
  const ClothModel& model_;
  PieceMesh piece_;
  std::map<std::pair<double, double>, int> index_;
};

}  // namespace

std::vector<std::array<int, 3>> triangulate(const Polygon& polygon) {
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> left(polygon.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
  while (left.size() >= 3) {
    const std::size_t k = best_ear(polygon, left), n = left.size();
    const std::array<int, 3> ear = {left[(k + n - 1) % n], left[k], left[(k + 1) % n]};
    const auto corner = [&](int i) -> const Vec2& {
      return polygon[static_cast<std::size_t>(ear[static_cast<std::size_t>(i)])];
    };
    if (0.5 * twice_area(corner(0), corner(1), corner(2)) > kLeastTriangle) triangles.push_back(ear);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return triangles;
}

PieceMesh make_piece_mesh(const ClothModel& model, std::span<const Vec3> positions) {
  FUAI_ASSERT(positions.size() == model.live.size());
  const CutCells cells =
      make_cut_cells(to_lattice(model.outline, model.origin, model.spacing), model.columns, model.rows);
  const auto kept = [&](int cell) { return model.cell_area[static_cast<std::size_t>(cell)] > 0.0; };
  Builder builder(model);
  for (int cell = 0; cell < model.slot_count(); ++cell) {
    if (cells.full[static_cast<std::size_t>(cell)] != 0) builder.add_full_cell(cell);
  }
  // Dropped cells last: what they share with kept ones has its vertices already.
  for (const CutPiece& piece : cells.pieces) {
    if (kept(piece.cell)) builder.add_piece(piece.cell, piece.polygon);
  }
  for (const CutPiece& piece : cells.pieces) {
    if (kept(piece.cell) || !(polygon_area(piece.polygon) > kLeastTriangle)) continue;
    builder.add_piece(nearest_cell(model, polygon_centroid(piece.polygon)), piece.polygon);
  }
  return builder.finish(positions);
}

void update_piece_mesh(PieceMesh& piece, std::span<const Vec3> positions) noexcept {
  for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
    piece.mesh.positions[i] = material_position(piece.vertices[i], positions);
  }
}

}  // namespace fuai
