// The triangle surface of a cloth piece with its true outline, for pictures and mesh files.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/cloth-pieces.md, "Mesh".
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/cloth/outline.h"
#include "fuai/cloth/surface_mesh.h"

namespace fuai {

/// A surface and how its vertices hang on the slots.
struct PieceMesh {
  SurfaceMesh mesh;
  std::vector<MaterialPoint> vertices;  ///< weights of each vertex of the mesh
};

/// Full cells as two triangles, diagonals alternating as in make_lattice_mesh(); cut cells as the cloth that
/// is in them. Neighbouring cells share vertices; in the flat state the area is that of the outline.
/// @param positions [m] (slots). Thread class: set-up.
PieceMesh make_piece_mesh(const ClothModel& model, std::span<const Vec3> positions);

/// Moves the vertices to where the slots are now; allocates nothing. @param positions [m] (slots).
/// Thread class: real-time.
void update_piece_mesh(PieceMesh& piece, std::span<const Vec3> positions) noexcept;

/// Triangles of a simple counter-clockwise polygon, as indices of its corners, ear by ear, the best-shaped
/// first; those without area are left out. Thread class: set-up.
std::vector<std::array<int, 3>> triangulate(const Polygon& polygon);

}  // namespace fuai
