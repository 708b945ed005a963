// Whole pictures of bent and draped cloth: folds show as light and dark; the files are kept for the eye.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "fuai/picture/offscreen_renderer.h"
#include "picture/png_reader.h"
#include "picture/sample_cloths.h"

using namespace fuai;

namespace {

Image keep(const std::string& name, const Image& image) {
  const std::filesystem::path folder = std::filesystem::path(FUAI_BINARY_DIR) / "pictures";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name, std::ios::binary) << encode_png(image);
  return image;
}

/// Mean lightness of the 5 x 5 pixels around the place where a point of the scene is seen.
double lightness_at(const Image& image, const Camera& camera, const Vec3& point) {
  const Vec3 pixel = project_to_pixel(camera, image.width, image.height, point);
  const bool inside =
      pixel.x() > 3.0 && pixel.x() < image.width - 3.0 && pixel.y() > 3.0 && pixel.y() < image.height - 3.0;
  REQUIRE(inside);
  double sum = 0.0;
  for (int j = -2; j <= 2; ++j) {
    for (int i = -2; i <= 2; ++i) {
      const std::uint8_t* p = image.at(static_cast<int>(pixel.x()) + i, static_cast<int>(pixel.y()) + j);
      sum += 0.3 * p[0] + 0.6 * p[1] + 0.1 * p[2];
    }
  }
  return sum / 25.0;
}

}  // namespace

TEST_SUITE("unit+slow") {
  TEST_CASE("a half cylinder is light towards the light, darker away from it and dark inside") {
    ClothPicture picture;
    ClothItem cloth;
    cloth.mesh = test::make_arch(0.2, 40);
    picture.cloths = {cloth};
    const double radius = 0.2 / std::numbers::pi;
    picture.arrows = {{Vec3(0.0, 0.0, radius), Vec3(0.0, 0.0, 0.05), {0.80, 0.10, 0.25, 1.0}, "0.25 N"}};
    picture.caption = "Bent to a half cylinder about the warp, 20 cm × 20 cm";
    picture.camera = frame_camera(bounds_of(picture), -1.1, 0.45);
    OffscreenRenderer renderer = make_offscreen_renderer();
    const Image image = keep("arch.png", renderer.render(picture, 800, 600));
    const auto on_arch = [&](double angle) {
      return lightness_at(image, picture.camera, radius * Vec3(-std::cos(angle), 0.0, std::sin(angle)));
    };
    CHECK(on_arch(1.2) > 1.25 * on_arch(2.9));
    CHECK(on_arch(1.2) > 190.0);
    CHECK(on_arch(2.9) > 60.0);  // shaded, not black
    // Ground under the arch, seen through its opening, against ground in the open.
    CHECK(lightness_at(image, picture.camera, Vec3(0.0, -0.06, 0.0)) <
          0.92 * lightness_at(image, picture.camera, Vec3(-0.15, 0.0, 0.0)));
  }

  TEST_CASE("the folds of a drape alternate in light and dark around the disc") {
    ClothPicture picture;
    ClothItem cloth;
    cloth.mesh = test::make_on_disc(0.3, 0.09, 8, 80);
    picture.cloths = {cloth};
    picture.cylinders = {{Vec3::Zero(), 0.09, 0.15}};
    picture.ground.height = -0.15;
    picture.caption = "Drape on a disc of 18 cm\n18 cm 円盤上のドレープ";
    picture.camera = frame_camera(bounds_of(picture), -1.0, 0.5);
    OffscreenRenderer renderer = make_offscreen_renderer();
    keep("drape.png", renderer.render(picture, 800, 600));
    // Without lines, seen from above, 3 cm below the rim: where the folds run across the light (which comes
    // from the left), their two flanks differ by far more than the 2 or 3 steps that an eye can tell.
    picture.cloths[0].thread_spacing = 0.0;
    picture.camera = frame_camera(bounds_of(picture), -std::numbers::pi / 2, std::numbers::pi / 2);
    const Image image = keep("drape_above.png", renderer.render(picture, 600, 600));
    const auto flank = [&](double turns) {
      const double angle = 2.0 * std::numbers::pi * turns, wave = std::cos(8.0 * angle), s = 0.03;
      const double r = 0.09 + s * (0.30 + 0.28 * wave) + 0.006 * (1.0 - std::exp(-s / 0.01));
      const Vec3 place(r * std::cos(angle), r * std::sin(angle), -s * (0.92 - 0.12 * wave));
      return lightness_at(image, picture.camera, place);
    };
    for (int k : {1, 2, 3, 5, 6, 7}) {
      CAPTURE(k);
      const double behind = flank((k + 0.25) / 8.0), before = flank((k - 0.25) / 8.0);
      CHECK((k < 4 ? behind - before : before - behind) > 10.0);
    }
  }

  TEST_CASE("cloth over the corner of a table, and a saddle with values") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture table;
    ClothItem cloth;
    cloth.mesh = test::make_over_corner(0.4, 0.15, 80);
    table.cloths = {cloth};
    table.boxes = {{Vec3(-0.4, -0.4, -0.3), Vec3::Zero()}};
    table.ground.height = -0.3;
    table.arrows = {
        {Vec3(0.10, 0.085, -0.17), Vec3(0.02, 0.09, 0.03), {0.80, 0.10, 0.25, 1.0}, "pull 0.31 N"}};
    table.caption = "Over the corner of a table";
    table.camera = frame_camera(bounds_of(table), 0.6, 0.4);
    const Image corner = keep("corner.png", renderer.render(table, 800, 600));
    // Both hanging sides differ from each other and from the top, as the sides of the table do.
    const double top = lightness_at(corner, table.camera, Vec3(-0.3, -0.3, 0.0));
    const double side_x = lightness_at(corner, table.camera, Vec3(0.0, -0.3, -0.25));
    const double side_y = lightness_at(corner, table.camera, Vec3(-0.3, 0.0, -0.25));
    CHECK(top > side_x + 15.0);
    CHECK(std::abs(side_x - side_y) > 10.0);

    ClothPicture saddle;
    cloth.mesh = test::make_rippled_saddle(0.3, 60);
    for (const Vec3& p : cloth.mesh.positions) cloth.mesh.values.push_back(100.0 * p.z());
    saddle.cloths = {cloth};
    saddle.ground.height = -0.03;
    saddle.colour_bar = ColourBar{"height [cm]", 0.0, 8.0};
    saddle.caption = "Saddle with ripples 波打つ布の高さ";
    saddle.camera = frame_camera(bounds_of(saddle), -0.8, 0.6, 4.0 / 3.0, kColourBarStrip);
    const Image image = keep("saddle.png", renderer.render(saddle, 800, 600));
    // The strip of the colour bar is free of cloth: nothing but ground, bar and text, all but the bar grey.
    const auto coloured = [](const std::uint8_t* p) {
      return std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]}) > 40;
    };
    int in_strip = 0;
    const int first = static_cast<int>(800 * (1.0 - kColourBarStrip));
    for (int y = 0; y < 600; ++y) {
      for (int x = first; x < 800; ++x) in_strip += coloured(image.at(x, y)) ? 1 : 0;
    }
    const double bar_area = 1.2 * 0.026 * 600 * (0.84 - 0.26) * 600;
    CHECK(in_strip == doctest::Approx(bar_area).epsilon(0.1));
  }
}
