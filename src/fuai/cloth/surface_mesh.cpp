// Makes surface meshes of lattices and their normals.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/surface_mesh.h"

#include <Eigen/Geometry>

#include "fuai/core/assertion.h"

namespace fuai {

std::vector<Vec3> vertex_normals(const SurfaceMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions.size(), Vec3::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3& p = mesh.positions[static_cast<std::size_t>(a)];
    const Vec3& q = mesh.positions[static_cast<std::size_t>(b)];
    const Vec3& r = mesh.positions[static_cast<std::size_t>(c)];
    const Vec3 twice_area = (q - p).cross(r - p);
    for (int v : {a, b, c}) normals[static_cast<std::size_t>(v)] += twice_area;
  }
  for (Vec3& n : normals) {
    const double length = n.norm();
    n = length > 0.0 ? Vec3(n / length) : Vec3(Vec3::UnitZ());
  }
  return normals;
}

SurfaceMesh make_lattice_mesh(int columns, int rows, double spacing, std::span<const Vec3> positions) {
  FUAI_ASSERT(columns > 1 && rows > 1);
  FUAI_ASSERT(positions.size() == static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  SurfaceMesh mesh;
  mesh.positions.assign(positions.begin(), positions.end());
  mesh.material.reserve(positions.size());
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column)
      mesh.material.emplace_back(column * spacing, row * spacing);
  }
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      const int p00 = row * columns + column, p10 = p00 + 1, p01 = p00 + columns, p11 = p01 + 1;
      if ((row + column) % 2 == 0) {
        mesh.triangles.push_back({p00, p10, p11});
        mesh.triangles.push_back({p00, p11, p01});
      } else {
        mesh.triangles.push_back({p00, p10, p01});
        mesh.triangles.push_back({p10, p11, p01});
      }
    }
  }
  return mesh;
}

}  // namespace fuai
