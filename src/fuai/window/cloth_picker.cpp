// Intersects a line of sight with the triangles of a cloth.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/cloth_picker.h"

#include <Eigen/Geometry>
#include <cmath>

namespace fuai {
namespace {

constexpr double kEdgeOn = 1e-9;

}  // namespace

std::optional<ClothHit> pick_cloth(const SurfaceMesh& mesh, const Ray& ray) {
  std::optional<ClothHit> nearest;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b),
               k = static_cast<std::size_t>(c);
    const Vec3 ab = mesh.positions[j] - mesh.positions[i], ac = mesh.positions[k] - mesh.positions[i];
    // origin + t d = A + u AB + v AC, by Cramer's rule with the triple product d x AC . AB.
    const Vec3 d_ac = ray.direction.cross(ac);
    const double det = ab.dot(d_ac);
    // Seen edge on, what is hit is rounding.
    if (std::abs(det) <= kEdgeOn * ab.norm() * ac.norm()) continue;
    const Vec3 from_a = ray.origin - mesh.positions[i];
    const double u = from_a.dot(d_ac) / det;
    if (!(u >= 0.0 && u <= 1.0)) continue;
    const Vec3 cross = from_a.cross(ab);
    const double v = ray.direction.dot(cross) / det;
    if (!(v >= 0.0 && u + v <= 1.0)) continue;
    const double t = ac.dot(cross) / det;
    if (!(t > 0.0) || (nearest && t >= nearest->depth)) continue;
    nearest = ClothHit{ray.origin + t * ray.direction,
                       (1.0 - u - v) * mesh.material[i] + u * mesh.material[j] + v * mesh.material[k], t,
                       det > 0.0};
  }
  return nearest;
}

}  // namespace fuai
