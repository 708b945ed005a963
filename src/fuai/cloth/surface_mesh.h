// The triangle surface of a piece of cloth, for pictures and mesh files.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fuai/core/types.h"

namespace fuai {

/// Triangles with counter-clockwise order seen from the face of the fabric (its +z side when it lies flat).
struct SurfaceMesh {
  std::vector<Vec3> positions;                ///< [m] (vertices)
  std::vector<std::array<int, 3>> triangles;  ///< vertex indices (triangles)
  std::vector<Vec2>
      material;  ///< weft and warp coordinate of each vertex in the flat cloth [m]; warp runs along y
  std::vector<double> values;  ///< empty, or one scalar a vertex to be shown in colour
};

/// Area-weighted unit normals, one a vertex; (0,0,1) where a vertex has no area. Thread class: set-up.
std::vector<Vec3> vertex_normals(const SurfaceMesh& mesh);

/// The mesh of a rectangular lattice stored row by row: node (column, row) has index row * columns + column
/// and lies flat at (column * spacing, row * spacing, 0). Each cell becomes two triangles, diagonals
/// alternating.
/// @param positions current positions [m] (columns * rows)
/// @param spacing rest spacing [m]
/// Thread class: set-up.
SurfaceMesh make_lattice_mesh(int columns, int rows, double spacing, std::span<const Vec3> positions);

}  // namespace fuai
