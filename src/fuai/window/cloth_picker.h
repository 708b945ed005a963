// What lies under the cursor: the nearest point of a cloth's surface along a line of sight.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "fuai/cloth/surface_mesh.h"
#include "fuai/window/orbit_camera.h"

namespace fuai {

/// A point of a cloth.
struct ClothHit {
  Vec3 point = Vec3::Zero();     ///< [m]
  Vec2 material = Vec2::Zero();  ///< weft and warp coordinate [m]
  double depth = 0.0;            ///< from the eye [m]
  bool face = true;              ///< seen from the face of the fabric
};

/// The nearest hit from either side; nothing when the line misses. Thread class: any.
/// @source T. Möller and B. Trumbore, J. Graphics Tools 2 (1997) 21
std::optional<ClothHit> pick_cloth(const SurfaceMesh& mesh, const Ray& ray);

}  // namespace fuai
