// Surface meshes of lattices.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <vector>

#include "fuai/cloth/surface_mesh.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("a flat lattice has every normal up, the right area and material coordinates") {
    std::vector<Vec3> flat;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 6; ++column) flat.emplace_back(0.01 * column, 0.01 * row, 0.0);
    }
    const SurfaceMesh mesh = make_lattice_mesh(6, 4, 0.01, flat);
    CHECK(mesh.triangles.size() == 2 * 5 * 3);
    for (const Vec3& n : vertex_normals(mesh)) CHECK((n - Vec3::UnitZ()).norm() < 1e-15);
    for (std::size_t i = 0; i < flat.size(); ++i)
      CHECK((mesh.material[i] - flat[i].head<2>()).norm() < 1e-17);
  }
}
