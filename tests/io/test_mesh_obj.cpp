// Meshes as Wavefront OBJ.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <string>

#include "fuai/io/mesh_obj.h"

TEST_SUITE("unit") {
  TEST_CASE("places, material coordinates and triangles counted from 1, in a fixed order") {
    fuai::SurfaceMesh mesh;
    mesh.positions = {{0.0, 0.0, 0.25}, {0.1, 0.0, -1e-9}, {0.0, 1.0 / 3.0, 0.0}};
    mesh.material = {{0.0, 0.0}, {0.1, 0.0}, {0.0, 0.5}};
    mesh.triangles = {{0, 1, 2}};
    CHECK(fuai::mesh_obj(mesh, "wool tropical") ==
          "# fuai; metres, z up; texture coordinates are weft and warp in metres\n"
          "o wool_tropical\n"
          "v 0 0 0.25\nv 0.1 0 -1e-09\nv 0 0.333333333 0\n"
          "vt 0 0\nvt 0.1 0\nvt 0 0.5\n"
          "f 1/1 2/2 3/3\n");
  }
}
