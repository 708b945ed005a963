// Writes a triangle surface as Wavefront OBJ.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "fuai/cloth/surface_mesh.h"

namespace fuai {

/// Text of an OBJ file: positions [m] with z up, texture coordinates = material coordinates [m] (weft, warp),
/// triangles counter-clockwise seen from the face. The same mesh gives the same bytes.
/// @param name of the object; blanks become underscores. Thread class: set-up.
std::string mesh_obj(const SurfaceMesh& mesh, std::string_view name);

}  // namespace fuai
