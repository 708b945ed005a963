// Projection and automatic framing.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>

#include "fuai/core/error.h"
#include "fuai/picture/cloth_picture.h"
#include "fuai/picture/image.h"

using namespace fuai;

TEST_SUITE("analytic") {
  TEST_CASE("a parallel camera from above maps metres to pixels by its height") {
    Camera camera;
    camera.target = Vec3(0.1, 0.2, 0.0);
    camera.eye = Vec3(0.1, 0.2, 1.0);
    camera.up = Vec3::UnitY();
    camera.parallel_height = 0.5;  // 200 pixels are 0.5 m: 400 pixels a metre
    const Vec3 pixel = project_to_pixel(camera, 300, 200, Vec3(0.2, 0.25, 0.3));
    CHECK(pixel.x() == doctest::Approx(150.0 + 40.0));
    CHECK(pixel.y() == doctest::Approx(100.0 - 20.0));
    CHECK(pixel.z() == doctest::Approx(0.7));
  }

  TEST_CASE("a perspective camera shows the edge of its opening at the border of the picture") {
    Camera camera;
    camera.eye = Vec3(0.0, -2.0, 0.0);
    camera.target = Vec3::Zero();
    camera.field_of_view = 0.8;
    const Vec3 pixel = project_to_pixel(camera, 400, 300, Vec3(0.0, 0.0, 2.0 * std::tan(0.4)));
    CHECK(pixel.x() == doctest::Approx(200.0));
    CHECK(pixel.y() == doctest::Approx(0.0));
    CHECK(pixel.z() == doctest::Approx(2.0));
  }
}

TEST_SUITE("property") {
  TEST_CASE("a framed box lies wholly inside the picture, with a margin, and touches it closely") {
    const bool held = rc::check([] {
      const auto number = [](int low, int high) { return *rc::gen::inRange(low, high) / 1000.0; };
      Bounds bounds;
      bounds.include(Vec3(number(-500, 500), number(-500, 500), number(-500, 500)));
      bounds.include(bounds.low + Vec3(number(10, 900), number(10, 900), number(0, 900)));
      const double strip = *rc::gen::element(0.0, kColourBarStrip);
      const double aspect = number(600, 2000);
      const int height = 500, width = static_cast<int>(height * aspect);
      const Camera camera = frame_camera(bounds, number(-4000, 4000), number(-1500, 1571), aspect, strip);
      double widest = 0.0;
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p((corner & 1) ? bounds.low.x() : bounds.high.x(),
                     (corner & 2) ? bounds.low.y() : bounds.high.y(),
                     (corner & 4) ? bounds.low.z() : bounds.high.z());
        const Vec3 pixel = project_to_pixel(camera, width, height, p);
        RC_ASSERT(pixel.z() > 0.0);
        // Distance from the middle of the free part, as a fraction of its half width and height.
        const double free = width * (1.0 - strip);
        const double x = std::abs(pixel.x() - 0.5 * free) / (0.5 * free);
        const double y = std::abs(pixel.y() - 0.5 * height) / (0.5 * height);
        widest = std::max({widest, x, y});
      }
      // One corner lies at 1/1.16 of the half width up to rounding of the width to whole pixels.
      RC_ASSERT(widest < 0.87);
      RC_ASSERT(widest > 0.85);
    });
    CHECK(held);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("bounds hold cloths, obstacles and, if asked, arrows") {
    ClothPicture picture;
    CHECK(bounds_of(picture).empty());
    picture.boxes = {{Vec3(-1.0, 0.0, 0.0), Vec3(0.0, 1.0, 1.0)}};
    picture.cylinders = {{Vec3(0.0, 0.0, 2.0), 0.5, 3.0}};
    picture.arrows = {{Vec3::Zero(), Vec3(0.0, 0.0, 9.0)}};
    CHECK(bounds_of(picture, false).low.isApprox(Vec3(-1.0, -0.5, -1.0)));
    CHECK(bounds_of(picture, false).high.isApprox(Vec3(0.5, 1.0, 2.0)));
    CHECK(bounds_of(picture).high.z() == 9.0);
  }

  TEST_CASE("impossible image sizes are refused") {
    CHECK_NOTHROW(check_image_size(16, 16384));
    CHECK_THROWS_AS(check_image_size(0, 100), Error);
    CHECK_THROWS_AS(check_image_size(100, -5), Error);
    CHECK_THROWS_AS(check_image_size(16385, 100), Error);
  }
}
