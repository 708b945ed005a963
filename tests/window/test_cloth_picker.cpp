// Picking and dragging from every side.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "fuai/window/cloth_picker.h"

namespace {

using namespace fuai;

/// A sheet of 20 cm that is curved like a part of a cylinder of 15 cm.
SurfaceMesh curved_sheet() {
  constexpr int kNodes = 21;
  constexpr double kSpacing = 0.01, kRadius = 0.15;
  std::vector<Vec3> positions;
  for (int row = 0; row < kNodes; ++row)
    for (int column = 0; column < kNodes; ++column) {
      const double angle = kSpacing * (column - 10) / kRadius;
      positions.emplace_back(kRadius * std::sin(angle), kSpacing * (row - 10), kRadius * std::cos(angle));
    }
  return make_lattice_mesh(kNodes, kNodes, kSpacing, positions);
}

double uniform(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1'000'001) / 1e6; }

}  // namespace

TEST_SUITE("property") {
  TEST_CASE("A hit lies on the line of sight and its material point on the cloth there") {
    const SurfaceMesh mesh = curved_sheet();
    CHECK(rc::check([&] {
      // From all sides, also from behind and below.
      const double azimuth = uniform(-std::numbers::pi, std::numbers::pi), z = uniform(-1.0, 1.0);
      const double r = std::sqrt(1.0 - z * z);
      const Vec3 eye = 0.8 * Vec3(r * std::cos(azimuth), r * std::sin(azimuth), z);
      const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(*rc::gen::inRange<int>(0, 800))];
      const Vec3 middle =
          (mesh.positions[static_cast<std::size_t>(a)] + mesh.positions[static_cast<std::size_t>(b)] +
           mesh.positions[static_cast<std::size_t>(c)]) /
          3.0;
      const Ray ray{eye, (middle - eye).normalized()};
      const auto hit = pick_cloth(mesh, ray);
      if (!hit) return;  // seen edge on
      RC_ASSERT((hit->point - eye).cross(ray.direction).norm() < 1e-12);
      RC_ASSERT(hit->depth <= (middle - eye).norm() + 1e-9);
      // Where the material point is by the shape's own formula: within the sagitta h^2 / 8 R of the facets.
      const double angle = (hit->material.x() - 0.10) / 0.15;
      const Vec3 exact(0.15 * std::sin(angle), hit->material.y() - 0.10, 0.15 * std::cos(angle));
      RC_ASSERT((exact - hit->point).norm() < 1.1 * 0.01 * 0.01 / (8.0 * 0.15) * std::sqrt(2.0));
    }));
  }

  TEST_CASE("The nearest side is told apart") {
    const SurfaceMesh mesh = curved_sheet();
    const auto above = pick_cloth(mesh, {{0.003, 0.002, 1.0}, {0.0, 0.0, -1.0}});
    const auto below = pick_cloth(mesh, {{0.003, 0.002, -1.0}, {0.0, 0.0, 1.0}});
    REQUIRE(above);
    REQUIRE(below);
    CHECK(above->face);
    CHECK_FALSE(below->face);
    CHECK_FALSE(pick_cloth(mesh, {{0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}}));
    CHECK_FALSE(pick_cloth(mesh, {{0.5, 0.0, 1.0}, {0.0, 0.0, -1.0}}));
  }

  TEST_CASE("A drag stays under the cursor at its depth, from every direction") {
    CHECK(rc::check([] {
      OrbitCamera camera;
      Bounds bounds;
      bounds.include({-0.2, -0.2, -0.2});
      bounds.include({0.2, 0.2, 0.2});
      camera.frame(bounds, uniform(-7.0, 7.0), uniform(-1.6, 1.6), 1.5);
      const Vec3 grab(uniform(-0.2, 0.2), uniform(-0.2, 0.2), uniform(-0.2, 0.2));
      const Ray ray = camera.ray({uniform(-1.0, 1.0), uniform(-1.0, 1.0)}, 1.5);
      const Vec3 moved = meet_plane(ray, grab, camera.forward());
      RC_ASSERT((moved - ray.origin).cross(ray.direction).norm() < 1e-12);
      RC_ASSERT(std::abs((moved - grab).dot(camera.forward())) < 1e-12);
    }));
  }
}
