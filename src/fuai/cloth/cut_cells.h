// The cells of a lattice that an outline covers, wholly or in part.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/cloth-pieces.md, "Cells".
//
// Lattice coordinates: the spacing is 1 and slot (column, row) lies at exactly (column, row).
#pragma once

#include <cstdint>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/cloth/outline.h"

namespace fuai {

/// A simple piece of a cell that the outline cuts.
struct CutPiece {
  int cell = 0;     ///< index of the cell: that of its low corner slot
  Polygon polygon;  ///< lattice coordinates, counter-clockwise
};

/// What lies inside the outline.
struct CutCells {
  std::vector<std::uint8_t> full;  ///< 1: all of the cell (slots; the last row and column have no cell)
  std::vector<CutPiece> pieces;    ///< of the other cells; a cell may have several
};

/// A lattice coordinate that differs from a whole number by less than this counts as whole where an outline
/// edge runs along a lattice line [-].
inline constexpr double kLatticeSnap = 1e-6;

/// The outline in lattice coordinates; corners of edges along a lattice line lie exactly on it.
/// @param outline [m] @param origin of slot (0, 0) [m] @param spacing [m]. Thread class: set-up.
Polygon to_lattice(const Polygon& outline, const Vec2& origin, double spacing);

/// Cuts the outline along all lattice lines; the areas sum to that of the outline to rounding.
/// @param outline lattice coordinates, inside the lattice to kLatticeSnap
/// @param columns,rows slots. Thread class: set-up.
CutCells make_cut_cells(const Polygon& outline, int columns, int rows);

/// The cell with cloth (cell_area > 0) that is nearest to a point; the lowest index among equals.
/// @param point lattice coordinates. @return index, -1 when there is none. Thread class: any.
int nearest_cell(const ClothModel& model, const Vec2& point) noexcept;

}  // namespace fuai
