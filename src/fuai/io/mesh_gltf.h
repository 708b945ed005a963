// Writes a triangle surface as binary glTF 2.0 (.glb).
// SPDX-License-Identifier: Apache-2.0
// Source: Khronos Group, glTF 2.0 specification, sections 3.6 (data), 3.9 (materials) and 4 (GLB).
#pragma once

#include <array>
#include <string>

#include "fuai/cloth/surface_mesh.h"

namespace fuai {

/// What else goes into the file.
struct GltfOptions {
  std::string generator = "fuai";                          ///< program and version
  std::array<double, 4> colour = {0.80, 0.78, 0.72, 1.0};  ///< base colour, linear red, green, blue, opacity
};

/// Bytes of a .glb file: positions [m] (z up, turned by the node to glTF's y up), normals, one set of texture
/// coordinates (u = weft, v = -warp, in metres: glTF counts v downward), a double-sided material, and in
/// `extras` of the mesh the fabric and the units. The same mesh gives the same bytes.
/// @param fabric its name
/// @throws Error (kUsage) for a mesh without triangles, with a number that is not finite, or whose material
/// coordinates are not one a vertex. Thread class: set-up.
std::string mesh_glb(const SurfaceMesh& mesh, const std::string& fabric, const GltfOptions& options = {});

}  // namespace fuai
