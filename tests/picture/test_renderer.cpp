// The off-screen renderer: silhouettes, sides, weave lines, values, shadows, arrows and refusals, by counted
// pixels.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "fuai/core/error.h"
#include "fuai/picture/offscreen_renderer.h"
#include "picture/png_reader.h"
#include "picture/sample_cloths.h"

using namespace fuai;
using test::count_pixels;

namespace {

/// A camera straight above the origin; the picture is `height` metres high.
Camera from_above(double height) {
  Camera camera;
  camera.eye = Vec3(0.0, 0.0, 1.0);
  camera.target = Vec3::Zero();
  camera.up = Vec3::UnitY();
  camera.parallel_height = height;
  return camera;
}

/// A flat cloth without lines on a transparent background, without ground and text.
ClothPicture bare_cloth(double side) {
  ClothPicture picture;
  ClothItem cloth;
  cloth.mesh = test::make_flat(side, 8);
  cloth.thread_spacing = 0.0;
  picture.cloths = {cloth};
  picture.ground.shown = false;
  picture.triad.shown = false;
  picture.background.alpha = 0.0;
  picture.camera = from_above(0.3);
  picture.ambient_directions = 8;
  return picture;
}

double lightness(const std::uint8_t* p) { return 0.3 * p[0] + 0.6 * p[1] + 0.1 * p[2]; }
bool covered(const std::uint8_t* p) { return p[3] > 127; }

/// How far a pixel's colour is from grey towards the hue of `colour`: the cosine between the two.
double likeness(const std::uint8_t* p, const Colour& colour) {
  const Vec3 a(p[0], p[1], p[2]), b(colour.red, colour.green, colour.blue);
  const Vec3 x = a.array() - a.mean(), y = b.array() - b.mean();
  return x.norm() < 12.0 ? 0.0 : x.dot(y) / (x.norm() * y.norm());
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a square cloth from above covers its area within 1 %, also turned, also with another aspect") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    for (double turn : {0.0, 0.4}) {
      for (int width : {240, 400}) {
        ClothPicture picture = bare_cloth(0.2);
        picture.camera.up = Vec3(std::sin(turn), std::cos(turn), 0.0);
        const Image image = renderer.render(picture, width, 240);
        // 240 pixels are 0.3 m.
        const double expected = std::pow(0.2 * 240 / 0.3, 2);
        CHECK(count_pixels(image, covered) == doctest::Approx(expected).epsilon(0.01));
      }
    }
  }

  TEST_CASE("the perspective projection of OpenGL agrees with project_to_pixel") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture picture = bare_cloth(0.01);
    Bounds room;
    room.include(Vec3(-0.2, -0.2, -0.2));
    room.include(Vec3(0.2, 0.2, 0.2));
    for (double parallel_height : {0.0, 0.6}) {
      picture.camera = frame_camera(room, 0.7, 0.8, 4.0 / 3.0, kColourBarStrip);
      picture.camera.parallel_height = parallel_height;
      const Vec3 place(0.1, -0.05, 0.12);
      picture.cloths[0].mesh = test::make_flat(0.02, 1);
      for (Vec3& p : picture.cloths[0].mesh.positions) p += place;
      const Image image = renderer.render(picture, 400, 300);
      Vec2 sum = Vec2::Zero();
      double count = 0.0;
      for (int y = 0; y < 300; ++y) {
        for (int x = 0; x < 400; ++x) {
          if (!covered(image.at(x, y))) continue;
          sum += Vec2(x + 0.5, y + 0.5);
          count += 1.0;
        }
      }
      REQUIRE(count > 20.0);
      // The middle of a patch of some ten pixels is known to about a fifth of a pixel.
      CHECK((sum / count - project_to_pixel(picture.camera, 400, 300, place).head<2>()).norm() < 0.3);
    }
  }

  TEST_CASE("the lines of the weave are as many as the spacing says, in the colours of warp and weft") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture picture = bare_cloth(0.21);
    picture.cloths[0].thread_spacing = 0.02;
    const Image image = renderer.render(picture, 600, 600);  // 40 pixels a line
    // Across the warp, between two weft lines: material 0.21 / 0.02 = 10.5, the first line at the cloth's
    // edge.
    const auto runs = [&](bool along_x, Direction direction) {
      int found = 0;
      bool inside = false;
      // The middle of the picture is a quarter of a cell off a line; 10 pixels further is half a cell.
      for (int i = 0; i < 600; ++i) {
        const std::uint8_t* p = along_x ? image.at(i, 300 - 10) : image.at(300 + 10, i);
        const bool now = covered(p) && likeness(p, yarn_colour(direction)) > 0.8 && lightness(p) < 190.0;
        found += now && !inside ? 1 : 0;
        inside = now;
      }
      return found;
    };
    CHECK(runs(true, Direction::kWarp) == 11);
    CHECK(runs(true, Direction::kWeft) == 0);
    CHECK(runs(false, Direction::kWeft) == 11);
    CHECK(runs(false, Direction::kWarp) == 0);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("face and back have their own colours") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture picture = bare_cloth(0.2);
    picture.cloths[0].face_colour = {0.9, 0.2, 0.2, 1.0};
    picture.cloths[0].back_colour = {0.2, 0.2, 0.9, 1.0};
    const Image face = renderer.render(picture, 120, 120);
    picture.camera.eye.z() = -1.0;
    const Image back = renderer.render(picture, 120, 120);
    CHECK(face.at(60, 60)[0] > 2 * face.at(60, 60)[2]);
    CHECK(back.at(60, 60)[2] > 2 * back.at(60, 60)[0]);
  }

  TEST_CASE("no pixel is black where a cloth faces the eye exactly") {
    // Rounding makes the cosine there more than 1 in one picture of eight. An odd size has a middle pixel.
    OffscreenRenderer renderer = make_offscreen_renderer();
    constexpr int kOdd = 161;
    for (int k = 0; k < 24; ++k) {
      CAPTURE(k);
      const double turn = 0.13 * k, lean = 0.2 + 0.03 * k;
      Mat3 axes;
      axes.col(0) = Vec3(std::cos(turn), std::sin(turn), 0.0);
      axes.col(2) = Vec3(std::sin(turn) * std::sin(lean), -std::cos(turn) * std::sin(lean), std::cos(lean));
      axes.col(1) = axes.col(2).cross(axes.col(0));
      ClothPicture picture = bare_cloth(0.2);
      for (Vec3& p : picture.cloths[0].mesh.positions) p = axes * p;
      picture.camera.eye = 0.3 * axes.col(2);
      picture.camera.up = Vec3::UnitZ();
      picture.camera.parallel_height = 0.0;
      const Image image = renderer.render(picture, kOdd, kOdd);
      // White in full light is 255; what the lights leave of it here is above 150.
      CHECK(count_pixels(image, [](const std::uint8_t* p) { return covered(p) && lightness(p) < 100.0; }) ==
            0.0);
    }
  }

  TEST_CASE("values are shown in the colours of the bar, unknown ones in grey") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    for (double value : {0.0, 5.0, 10.0, std::numeric_limits<double>::quiet_NaN()}) {
      ClothPicture picture = bare_cloth(0.2);
      picture.cloths[0].mesh.values.assign(picture.cloths[0].mesh.positions.size(), value);
      picture.colour_bar = ColourBar{"v [1]", 0.0, 10.0, ColourMap::kSequential};
      const Image image = renderer.render(picture, 200, 120);
      // Seen from above in the open the light is 1 within a tenth, which moves an encoded channel by less
      // than 12.
      CHECK(test::is_near(image.at(100, 60), sample_colour_map(ColourMap::kSequential, value / 10.0), 12));
    }
  }

  TEST_CASE("a block casts a shadow on the ground on its right and darkens it around") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture picture;
    picture.boxes = {{Vec3(-0.05, -0.05, 0.0), Vec3(0.05, 0.05, 0.08)}};
    picture.triad.shown = false;
    picture.ground.grid = 0.0;
    picture.ground.size = 2.0;
    picture.camera = from_above(0.4);
    const Image image = renderer.render(picture, 200, 200);
    const auto at = [&](double x, double y) {
      const Vec3 p = project_to_pixel(picture.camera, 200, 200, Vec3(x, y, 0.0));
      return lightness(image.at(static_cast<int>(p.x()), static_cast<int>(p.y())));
    };
    CHECK(at(0.07, 0.0) < 0.8 * at(-0.17, 0.0));     // key light from the left
    CHECK(at(-0.055, 0.0) < 0.97 * at(-0.17, 0.0));  // soft light only
    CHECK(at(-0.17, 0.0) > 200.0);
  }

  TEST_CASE("cloth that lies exactly on a block hides it everywhere") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture picture = bare_cloth(0.2);
    picture.cloths[0].face_colour = {0.1, 0.8, 0.1, 1.0};
    picture.boxes = {{Vec3(-0.14, -0.14, -0.1), Vec3(0.14, 0.14, 0.0), {0.8, 0.1, 0.8, 1.0}}};
    const Image image = renderer.render(picture, 240, 240);
    CHECK(count_pixels(image, [](const std::uint8_t* p) { return p[1] > p[0] && p[1] > p[2]; }) ==
          doctest::Approx(160.0 * 160.0).epsilon(0.01));
    // The same from the side, where depths differ little.
    picture.camera = frame_camera(bounds_of(picture), 0.9, 0.25, 1.0);
    const Image with = renderer.render(picture, 240, 240);
    picture.boxes.clear();
    const Image without = renderer.render(picture, 240, 240);
    // Three of four samples green: half covered pixels count in neither picture.
    const auto green = [](const std::uint8_t* p) { return p[3] > 150 && p[1] > p[0] && p[1] > p[2]; };
    CHECK(count_pixels(with, green) == doctest::Approx(count_pixels(without, green)).epsilon(0.01));
  }

  TEST_CASE("an arrow is seen in its colour, as large as it is, and its label beside it") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture picture = bare_cloth(0.2);
    const Image before = renderer.render(picture, 300, 300);
    ArrowItem arrow{Vec3(-0.05, 0.0, 0.05), Vec3(0.1, 0.0, 0.0), {0.1, 0.1, 0.9, 1.0}, ""};
    arrow.radius = 0.004;
    picture.arrows = {arrow};
    const auto blue = [&](const std::uint8_t* p) { return likeness(p, arrow.colour) > 0.95 && p[2] > 90; };
    CHECK(count_pixels(before, blue) == 0);
    const Image after = renderer.render(picture, 300, 300);
    // Shaft 0.076 x 0.008, head a triangle 0.024 by 0.0192; 1000 pixels a metre.
    const double expected = (0.076 * 0.008 + 0.5 * 0.024 * 0.0192) * 1e6;
    CHECK(count_pixels(after, blue) == doctest::Approx(expected).epsilon(0.05));
    picture.arrows[0].label = "1.5 N";
    const Image labelled = renderer.render(picture, 300, 300);
    int changed_left = 0, changed_right = 0;
    for (int y = 0; y < 300; ++y) {
      for (int x = 0; x < 300; ++x) {
        if (std::equal(labelled.at(x, y), labelled.at(x, y) + 4, after.at(x, y))) continue;
        (x < 200 ? changed_left : changed_right) += 1;
      }
    }
    CHECK(changed_left == 0);  // the tip is at pixel 200
    CHECK(changed_right > 40);
  }

  TEST_CASE("the background is transparent or as asked, and edges are clean") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture picture = bare_cloth(0.2);
    picture.camera.up = Vec3(0.4, 1.0, 0.0);
    const Image clear = renderer.render(picture, 120, 120);
    CHECK(clear.at(2, 2)[3] == 0);
    CHECK(clear.at(60, 60)[3] == 255);
    // Half covered pixels have the colour of the cloth, not one mixed with the background. One step of 8 bits
    // of a premultiplied dark tone is up to 4 steps of the straight one at a quarter coverage.
    int edge = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 120; ++x) {
        const std::uint8_t* p = clear.at(x, y);
        if (p[3] == 0 || p[3] == 255) continue;
        ++edge;
        CHECK(std::abs(p[0] - clear.at(60, 60)[0]) < 16);
      }
    }
    CHECK(edge > 50);
    picture.background = {0.1, 0.2, 0.3, 1.0};
    const Image solid = renderer.render(picture, 120, 120);
    CHECK(test::is_near(solid.at(2, 2), picture.background, 1));
    CHECK(count_pixels(solid, [](const std::uint8_t* p) { return p[3] != 255; }) == 0);
  }

  TEST_CASE("caption, colour bar, triad and grid size write on the picture, and only they") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    const ClothPicture plain = bare_cloth(0.02);
    const int nothing = count_pixels(renderer.render(plain, 400, 300), covered);
    ClothPicture picture = plain;
    picture.caption = "落ちる布 drape";
    CHECK(count_pixels(renderer.render(picture, 400, 300), covered) > nothing + 200);
    picture = plain;
    picture.triad.shown = true;
    CHECK(count_pixels(renderer.render(picture, 400, 300), covered) > nothing + 100);
    picture = plain;
    picture.colour_bar = ColourBar{"moment [gf cm/cm]", -1.0, 1.0, ColourMap::kDiverging};
    CHECK(count_pixels(renderer.render(picture, 400, 300), covered) > nothing + 1000);
  }

  TEST_CASE("text stays inside the picture") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture picture = bare_cloth(0.02);
    picture.caption =
        "A very long caption that has to be wrapped because the picture is narrow, 非常に長い説明文";
    picture.arrows = {{Vec3::Zero(), Vec3(0.13, 0.0, 0.0), {0.8, 0.0, 0.0, 1.0}, "a long label 12.3 N"},
                      {Vec3::Zero(), Vec3(0.0, 0.148, 0.0), {0.8, 0.0, 0.0, 1.0}, "up 1 N"}};
    picture.colour_bar = ColourBar{"bending moment [gf cm/cm]", -1e-3, 1e-3};
    picture.triad.shown = true;
    const Image image = renderer.render(picture, 300, 300);
    int border = 0;
    for (int i = 0; i < 300; ++i) {
      for (const std::uint8_t* p : {image.at(i, 0), image.at(i, 299), image.at(0, i), image.at(299, i)})
        border += p[3] > 0 ? 1 : 0;
    }
    CHECK(border == 0);
  }

  TEST_CASE("an empty picture is background and ground") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    const Image image = renderer.render(ClothPicture{}, 100, 80);
    CHECK(image.width == 100);
    CHECK(image.height == 80);
    CHECK(count_pixels(image, [](const std::uint8_t* p) { return p[3] == 255; }) == 100 * 80);
  }

  TEST_CASE("impossible pictures are refused and the renderer goes on") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    const ClothPicture good = bare_cloth(0.2);
    CHECK_THROWS_AS(renderer.render(good, 0, 100), Error);
    CHECK_THROWS_AS(renderer.render(good, 100, 100000), Error);
    ClothPicture bad = good;
    bad.cloths[0].mesh.positions[7].x() = INFINITY;
    CHECK_THROWS_AS(renderer.render(bad, 100, 100), Error);
    bad = good;
    bad.colour_bar = ColourBar{"none", 1.0, 1.0};
    CHECK_THROWS_AS(renderer.render(bad, 100, 100), Error);
    CHECK(count_pixels(renderer.render(good, 100, 100), covered) > 1000);
  }

  TEST_CASE("several renderers live side by side and die in any order") {
    std::optional<OffscreenRenderer> first = make_offscreen_renderer();
    std::optional<OffscreenRenderer> second = make_offscreen_renderer();
    const ClothPicture picture = bare_cloth(0.2);
    const Image expected = first->render(picture, 100, 100);
    CHECK(second->render(picture, 100, 100).pixels == expected.pixels);
    first.reset();
    CHECK(second->render(picture, 100, 100).pixels == expected.pixels);
    OffscreenRenderer moved = std::move(*second);
    second.reset();
    CHECK(moved.render(picture, 100, 100).pixels == expected.pixels);
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("the same picture gives the same bytes, whatever was drawn between") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture picture = bare_cloth(0.2);
    picture.cloths[0].mesh = test::make_arch(0.2, 20);
    picture.cloths[0].thread_spacing = 0.01;
    picture.ground.shown = true;
    picture.caption = "twice";
    picture.camera = frame_camera(bounds_of(picture), 0.5, 0.5);
    const std::string first = encode_png(renderer.render(picture, 320, 240));
    ClothPicture other = bare_cloth(0.1);
    other.ambient_directions = 33;
    other.colour_bar = ColourBar{"x", 0.0, 1.0};
    renderer.render(other, 200, 100);
    CHECK(encode_png(renderer.render(picture, 320, 240)) == first);
  }
}
