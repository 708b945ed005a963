// Triangulates cloths, boxes, cylinders, arrows and the ground.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/draw_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fuai/core/error.h"

namespace fuai {
namespace {

// Faces of obstacles are cut finely because the soft light is computed at vertices.
constexpr int kFaceCells = 24;
constexpr int kGroundCells = 120;
constexpr int kRoundSegments = 72;

std::array<float, 3> to_floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// Adds cells(a) x cells(b) quads to a mesh; `vertex(i, j)` gives position and normal. The order of the
/// corners is counter-clockwise when d/di x d/dj points to the viewer.
template <class Vertex>
void add_patch(DrawMesh& mesh, int cells_i, int cells_j, const Vertex& vertex) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto row = static_cast<std::uint32_t>(cells_i + 1);
  for (int j = 0; j <= cells_j; ++j) {
    for (int i = 0; i <= cells_i; ++i) {
      const auto [position, normal] =
          vertex(static_cast<double>(i) / cells_i, static_cast<double>(j) / cells_j);
      mesh.vertices.push_back({to_floats(position), to_floats(normal), {0.0F, 0.0F}, {0.0F, 0.0F}});
    }
  }
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(cells_j); ++j) {
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(cells_i); ++i) {
      const std::uint32_t p = first + j * row + i;
      mesh.indices.insert(mesh.indices.end(), {p, p + 1, p + row + 1, p, p + row + 1, p + row});
    }
  }
}

using Point = std::pair<Vec3, Vec3>;  // position, normal

/// The two directions across a unit vector that make a right-handed frame (a, b, axis).
std::pair<Vec3, Vec3> across(const Vec3& axis) {
  const Vec3 helper = std::abs(axis.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX();
  const Vec3 a = helper.cross(axis).normalized();
  return {a, axis.cross(a)};
}

/// Adds the surface of revolution between two rings along `axis`; a ring of radius zero is a point.
void add_ring(DrawMesh& mesh, const Vec3& start, double start_radius, const Vec3& end, double end_radius,
              const Vec3& axis, const Vec3& slope_normal, int cells) {
  const auto [a, b] = across(axis);
  add_patch(mesh, kRoundSegments, cells, [&, a = a, b = b](double s, double t) -> Point {
    const double angle = 2.0 * std::numbers::pi * s;
    const Vec3 radial = std::cos(angle) * a + std::sin(angle) * b;
    // slope_normal: (outward part, part along the axis)
    const Vec3 normal = (slope_normal.x() * radial + slope_normal.y() * axis).normalized();
    return {start + t * (end - start) + std::lerp(start_radius, end_radius, t) * radial, normal};
  });
}

void check_mesh(const SurfaceMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  if (mesh.material.size() != count || (!mesh.values.empty() && mesh.values.size() != count))
    throw Error(ErrorKind::kUsage, "a cloth mesh has " + std::to_string(count) + " positions but " +
                                       std::to_string(mesh.material.size()) + " material coordinates and " +
                                       std::to_string(mesh.values.size()) + " values");
  for (const auto& triangle : mesh.triangles) {
    for (int v : triangle) {
      if (v < 0 || static_cast<std::size_t>(v) >= count)
        throw Error(ErrorKind::kUsage,
                    "a cloth triangle names vertex " + std::to_string(v) + " of " + std::to_string(count));
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!mesh.positions[i].allFinite())
      throw Error(ErrorKind::kCheckFailed, "position " + std::to_string(i) + " of a cloth is not finite");
  }
}

}  // namespace

DrawMesh make_draw_mesh(const ClothItem& cloth, const ColourBar* bar) {
  const SurfaceMesh& mesh = cloth.mesh;
  check_mesh(mesh);
  const std::vector<Vec3> normals = vertex_normals(mesh);
  DrawMesh draw;
  draw.vertices.reserve(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    std::array<float, 2> value{0.0F, 0.0F};
    if (bar != nullptr && !mesh.values.empty() && std::isfinite(mesh.values[i])) {
      const double t = (mesh.values[i] - bar->low) / (bar->high - bar->low);
      value = {static_cast<float>(std::clamp(t, 0.0, 1.0)), 1.0F};
    }
    draw.vertices.push_back(
        {to_floats(mesh.positions[i]),
         to_floats(normals[i]),
         {static_cast<float>(mesh.material[i].x()), static_cast<float>(mesh.material[i].y())},
         value});
  }
  draw.indices.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (int v : triangle) draw.indices.push_back(static_cast<std::uint32_t>(v));
  }
  return draw;
}

DrawMesh make_draw_mesh(const BoxItem& box) {
  DrawMesh draw;
  const Vec3 centre = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  for (int axis = 0; axis < 3; ++axis) {
    for (double side : {-1.0, 1.0}) {
      const Vec3 normal = side * Vec3::Unit(axis);
      const Vec3 a = Vec3::Unit((axis + 1) % 3) * side, b = Vec3::Unit((axis + 2) % 3);
      add_patch(draw, kFaceCells, kFaceCells, [&](double s, double t) -> Point {
        return {centre + half.cwiseProduct(normal + (2.0 * s - 1.0) * a + (2.0 * t - 1.0) * b), normal};
      });
    }
  }
  return draw;
}

DrawMesh make_draw_mesh(const CylinderItem& cylinder) {
  DrawMesh draw;
  const Vec3 up = Vec3::UnitZ(), bottom = cylinder.top - cylinder.height * up;
  const double r = cylinder.radius;
  add_ring(draw, bottom, 0.0, bottom, r, up, Vec3(0.0, -1.0, 0.0), kFaceCells / 2);
  add_ring(draw, bottom, r, cylinder.top, r, up, Vec3(1.0, 0.0, 0.0), kFaceCells / 2);
  add_ring(draw, cylinder.top, r, cylinder.top, 0.0, up, Vec3(0.0, 1.0, 0.0), kFaceCells / 2);
  return draw;
}

DrawMesh make_draw_mesh(const ArrowItem& arrow, double radius) {
  DrawMesh draw;
  const double length = arrow.vector.norm();
  if (length == 0.0) return draw;
  const Vec3 axis = arrow.vector / length, tip = arrow.origin + arrow.vector;
  const double head = std::min(6.0 * radius, 0.5 * length), head_radius = 2.4 * radius;
  const Vec3 neck = tip - head * axis;
  add_ring(draw, arrow.origin, 0.0, arrow.origin, radius, axis, Vec3(0.0, -1.0, 0.0), 1);
  add_ring(draw, arrow.origin, radius, neck, radius, axis, Vec3(1.0, 0.0, 0.0), 1);
  add_ring(draw, neck, radius, neck, head_radius, axis, Vec3(0.0, -1.0, 0.0), 1);
  add_ring(draw, neck, head_radius, tip, 0.0, axis, Vec3(head, head_radius, 0.0).normalized(), 1);
  return draw;
}

DrawMesh make_ground_mesh(const Vec3& centre, double size) {
  DrawMesh draw;
  add_patch(draw, kGroundCells, kGroundCells, [&](double s, double t) -> Point {
    return {centre + size * Vec3(s - 0.5, t - 0.5, 0.0), Vec3::UnitZ()};
  });
  return draw;
}

}  // namespace fuai
