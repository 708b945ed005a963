// Triangulated bodies: closed, wound outward, of the right volume.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "fuai/core/error.h"
#include "fuai/picture/draw_mesh.h"
#include "picture/sample_cloths.h"

using namespace fuai;

namespace {

Vec3 to_vec(const std::array<float, 3>& v) { return Vec3(v[0], v[1], v[2]); }

/// Volume by the divergence theorem: positive only when every triangle is wound outward. Also checks that the
/// normals of the vertices point to the side from which the triangle runs counter-clockwise.
double enclosed_volume(const DrawMesh& mesh) {
  double volume = 0.0;
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    Vec3 p[3];
    for (std::size_t k = 0; k < 3; ++k) p[k] = to_vec(mesh.vertices[mesh.indices[t + k]].position);
    const Vec3 twice_area = (p[1] - p[0]).cross(p[2] - p[0]);
    volume += p[0].dot(p[1].cross(p[2])) / 6.0;
    for (std::size_t k = 0; k < 3 && twice_area.norm() > 1e-9; ++k)
      CHECK(to_vec(mesh.vertices[mesh.indices[t + k]].normal).dot(twice_area) > 0.0);
  }
  return volume;
}

/// Area of the polygon of 72 sides in a circle, over that of the circle.
const double kPolygon = 72.0 / (2.0 * std::numbers::pi) * std::sin(2.0 * std::numbers::pi / 72.0);

}  // namespace

TEST_SUITE("analytic") {
  // Single precision positions: relative errors of some 1e-7 each, 1e-5 for the sum of thousands of
  // triangles.
  TEST_CASE("a box encloses its volume") {
    const DrawMesh mesh = make_draw_mesh(BoxItem{Vec3(-0.1, 0.0, 0.2), Vec3(0.3, 0.5, 0.4)});
    CHECK(enclosed_volume(mesh) == doctest::Approx(0.4 * 0.5 * 0.2).epsilon(1e-5));
  }

  TEST_CASE("a cylinder encloses its volume") {
    const DrawMesh mesh = make_draw_mesh(CylinderItem{Vec3(0.1, 0.2, 0.3), 0.09, 0.2});
    CHECK(enclosed_volume(mesh) ==
          doctest::Approx(kPolygon * std::numbers::pi * 0.09 * 0.09 * 0.2).epsilon(1e-5));
  }

  TEST_CASE("an arrow encloses a shaft and a head, whatever its direction") {
    const double r = 0.01, length = 0.3, head = 6.0 * r;
    const double expected =
        kPolygon * std::numbers::pi * (r * r * (length - head) + std::pow(2.4 * r, 2) * head / 3.0);
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(-0.6, 0.48, 0.64)}) {
      const DrawMesh mesh = make_draw_mesh(ArrowItem{Vec3(0.1, 0.1, 0.1), length * direction}, r);
      CHECK(enclosed_volume(mesh) == doctest::Approx(expected).epsilon(1e-5));
    }
    CHECK(make_draw_mesh(ArrowItem{}, r).indices.empty());
  }
}

TEST_SUITE("unit") {
  TEST_CASE("values become places in the colour map, NaN becomes unknown") {
    ClothItem cloth;
    cloth.mesh = test::make_flat(0.1, 1);
    cloth.mesh.values = {2.0, 3.0, 9.0, std::numeric_limits<double>::quiet_NaN()};
    const ColourBar bar{"t", 2.0, 4.0};
    const DrawMesh mesh = make_draw_mesh(cloth, &bar);
    CHECK(mesh.vertices[0].value == std::array{0.0F, 1.0F});
    CHECK(mesh.vertices[1].value == std::array{0.5F, 1.0F});
    CHECK(mesh.vertices[2].value == std::array{1.0F, 1.0F});
    CHECK(mesh.vertices[3].value == std::array{0.0F, 0.0F});
  }

  TEST_CASE("meshes that do not fit together are refused") {
    ClothItem cloth;
    cloth.mesh = test::make_flat(0.1, 2);
    ClothItem broken = cloth;
    broken.mesh.triangles[3][1] = 9;
    CHECK_THROWS_AS(make_draw_mesh(broken, nullptr), Error);
    broken = cloth;
    broken.mesh.material.pop_back();
    CHECK_THROWS_AS(make_draw_mesh(broken, nullptr), Error);
    broken = cloth;
    broken.mesh.values = {1.0};
    CHECK_THROWS_AS(make_draw_mesh(broken, nullptr), Error);
    broken = cloth;
    broken.mesh.positions[4].z() = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(make_draw_mesh(broken, nullptr), Error);
    CHECK_NOTHROW(make_draw_mesh(cloth, nullptr));
  }
}
