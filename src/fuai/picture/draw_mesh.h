// Vertices and triangles as the graphics card wants them, made from the items of a picture.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fuai/picture/cloth_picture.h"

namespace fuai {

/// One vertex of the vertex buffer; single precision is what the card computes with.
struct DrawVertex {
  std::array<float, 3> position;  ///< [m]
  std::array<float, 3> normal;    ///< unit, on the face side
  std::array<float, 2> material;  ///< weft and warp coordinate [m]
  std::array<float, 2> value;     ///< place in the colour map [0, 1], and 1 when known, 0 when not
};

struct DrawMesh {
  std::vector<DrawVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< (triangles * 3)
};

/// @param bar null: the cloth is drawn in its own colours
/// Throws Error kUsage when the mesh does not fit together, kCheckFailed when a position is not finite.
DrawMesh make_draw_mesh(const ClothItem& cloth, const ColourBar* bar);
DrawMesh make_draw_mesh(const BoxItem& box);
DrawMesh make_draw_mesh(const CylinderItem& cylinder);
/// @param radius of the shaft [m]
DrawMesh make_draw_mesh(const ArrowItem& arrow, double radius);
/// @param centre of the floor [m]
/// @param size side of the square [m]
DrawMesh make_ground_mesh(const Vec3& centre, double size);

}  // namespace fuai
