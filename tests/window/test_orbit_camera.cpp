// The orbit camera against the painter's own projection.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <cmath>

#include "fuai/window/orbit_camera.h"

namespace {

using namespace fuai;

constexpr int kWidth = 900, kHeight = 600;
constexpr double kAspect = 1.5;

OrbitCamera some_camera(double azimuth, double elevation) {
  Bounds bounds;
  bounds.include({-0.2, -0.1, -0.3});
  bounds.include({0.3, 0.2, 0.1});
  OrbitCamera camera;
  camera.frame(bounds, azimuth, elevation, kAspect, 0.1);
  return camera;
}

Vec2 place_of(const OrbitCamera& camera, const Vec3& point) {
  const Vec3 pixel = project_to_pixel(camera.camera(), kWidth, kHeight, point);
  return {2.0 * pixel.x() / kWidth - 1.0, 1.0 - 2.0 * pixel.y() / kHeight};
}

double uniform(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1'000'001) / 1e6; }

}  // namespace

TEST_SUITE("property") {
  TEST_CASE("A line of sight goes through what is seen there") {
    CHECK(rc::check([] {
      const OrbitCamera camera = some_camera(uniform(-4.0, 4.0), uniform(-2.0, 2.0));
      const Vec3 point(uniform(-0.2, 0.3), uniform(-0.1, 0.2), uniform(-0.3, 0.1));
      const Ray ray = camera.ray(place_of(camera, point), kAspect);
      // Two ways through the same numbers: rounding at distances of a metre.
      const Vec3 off = (point - ray.origin).cross(ray.direction);
      RC_ASSERT(off.norm() < 1e-12);
    }));
  }

  TEST_CASE("Zooming keeps what the cursor is at, at the depth of the target") {
    CHECK(rc::check([] {
      OrbitCamera camera = some_camera(uniform(-4.0, 4.0), uniform(-1.5, 1.5));
      const Vec2 place(uniform(-0.9, 0.9), uniform(-0.9, 0.9));
      const Vec3 seen = meet_plane(camera.ray(place, kAspect), camera.target(), camera.forward());
      camera.zoom(uniform(-5.0, 5.0), place, kAspect);
      RC_ASSERT((place_of(camera, seen) - place).norm() < 1e-9);
    }));
  }

  TEST_CASE("However it is turned it stays upright") {
    CHECK(rc::check([] {
      OrbitCamera camera = some_camera(0.3, 0.2);
      for (int i = 0; i < 50; ++i) {
        camera.orbit({uniform(-2000.0, 2000.0), uniform(-2000.0, 2000.0)}, kHeight);
        camera.pan({uniform(-100.0, 100.0), uniform(-100.0, 100.0)}, kHeight);
      }
      // The picture's upward direction has a part upward: up on the screen is up in the scene.
      RC_ASSERT(camera_axes(camera.camera()).col(1).z() > 0.0);
      RC_ASSERT(std::isfinite(camera.target().norm()));
    }));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("Going so many times nearer keeps target and direction, up to the nearest that there is") {
    OrbitCamera camera = some_camera(0.7, 0.4);
    const OrbitCamera before = camera;
    camera.approach(4.0);
    CHECK(camera.distance() == doctest::Approx(before.distance() / 4.0));
    CHECK(camera.target() == before.target());
    CHECK(camera.azimuth() == before.azimuth());
    camera.approach(1e9);
    CHECK(camera.distance() == 0.01);
  }

  TEST_CASE("Panning takes what lies at the target's depth along with the cursor") {
    OrbitCamera camera = some_camera(0.7, 0.4);
    const Vec3 seen = camera.target();
    const Vec2 before = place_of(camera, seen);
    camera.pan({45.0, 30.0}, kHeight);
    const Vec2 after = place_of(camera, seen);
    CHECK(after.x() - before.x() == doctest::Approx(2.0 * 45.0 / kWidth));
    CHECK(after.y() - before.y() == doctest::Approx(-2.0 * 30.0 / kHeight));
  }

  TEST_CASE("Dragging to the right turns the scene to the right") {
    OrbitCamera camera = some_camera(0.7, 0.1);
    // A point in front of the target, towards the eye, moves with the cursor.
    const Vec3 front = camera.target() - 0.05 * camera.forward();
    const double before = place_of(camera, front).x();
    camera.orbit({20.0, 0.0}, kHeight);
    CHECK(place_of(camera, front).x() > before);
  }
}
