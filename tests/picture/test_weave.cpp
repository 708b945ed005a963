// Yarns and pictures on the cloth: there close by, of the right size, gone far away, and the light is kept.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <string>

#include "fuai/core/error.h"
#include "fuai/picture/offscreen_renderer.h"
#include "picture/png_reader.h"
#include "picture/sample_cloths.h"

using namespace fuai;

namespace {

constexpr int kSize = 160;          // side of the pictures [pixel]
constexpr double kPitch = 0.42e-3;  // of the yarns: 24 a centimetre [m]

/// A flat cloth that fills the picture. @param yarn how many pixels a yarn is wide
ClothPicture flat_cloth(double yarn, WeaveStructure structure, bool shown) {
  ClothPicture picture;
  ClothItem cloth;
  const double height = kSize / yarn * kPitch;
  cloth.mesh = test::make_flat(2.0 * height, 8);
  cloth.thread_spacing = 0.0;
  if (shown) cloth.yarns = {structure, kPitch, kPitch};
  picture.cloths = {cloth};
  picture.ground.shown = false;
  picture.triad.shown = false;
  picture.camera.eye = Vec3(0.0, 0.0, 1.0);
  picture.camera.up = Vec3::UnitY();
  picture.camera.parallel_height = height;
  picture.ambient_directions = 8;
  return picture;
}

double lightness(const std::uint8_t* p) { return (p[0] + p[1] + p[2]) / 3.0; }

/// Mean difference of two pictures' lightness, of 255.
double difference(const Image& a, const Image& b) {
  double sum = 0.0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) sum += std::abs(lightness(a.at(x, y)) - lightness(b.at(x, y)));
  return sum / (kSize * kSize);
}

/// Mean of linear light.
double mean_light(const Image& image) {
  double sum = 0.0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) sum += srgb_to_linear(image.at(x, y)[1] / 255.0);
  return sum / (kSize * kSize);
}

constexpr WeaveStructure kAll[] = {WeaveStructure::kPlain, WeaveStructure::kTwill, WeaveStructure::kSatin,
                                   WeaveStructure::kKnit};

/// A picture of four fields: red, green over blue, white.
std::shared_ptr<Image> four_fields() {
  auto image = std::make_shared<Image>();
  image->width = image->height = 16;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const bool right = x >= 8, low = y >= 8;
      const auto part = [](bool on) { return static_cast<std::uint8_t>(on ? 230 : 20); };
      for (const std::uint8_t value : {part(right == low), part(right), part(low), part(true)})
        image->pixels.push_back(value);
      image->pixels[image->pixels.size() - 1] = 255;
    }
  return image;
}

}  // namespace

TEST_SUITE("property") {
  TEST_CASE("yarns are seen close by, are gone far away, and keep the mean light") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    // Half a step of 255: nothing that an eye or a file can tell. Close by the relief changes the light by a
    // tenth or more, which is a dozen steps.
    constexpr double kUnseen = 0.5, kSeen = 5.0;
    for (const WeaveStructure structure : kAll) {
      const std::string name = to_string(structure);
      CAPTURE(name);
      const auto drawn = [&](double yarn, bool shown) {
        return renderer.render(flat_cloth(yarn, structure, shown), kSize, kSize);
      };
      const Image close = drawn(16.0, true), bare = drawn(16.0, false);
      CHECK(difference(close, bare) > kSeen);
      // 160 pixels are ten yarns, two periods of the longest repeat: what is left is the rounding of the
      // picture's edge to the yarns' and of light to steps, each less than a part of a hundred.
      CHECK(mean_light(close) == doctest::Approx(mean_light(bare)).epsilon(0.01));
      double before = difference(close, bare);
      for (const double yarn : {5.0, 3.3, 2.5}) {
        const double now = difference(drawn(yarn, true), drawn(yarn, false));
        CAPTURE(yarn);
        CHECK(now <= 1.05 * before);  // it only fades; a twentieth for where the pixels happen to lie
        before = now;
      }
      for (const double yarn : {1.9, 1.0, 0.3}) {
        CAPTURE(yarn);
        CHECK(difference(drawn(yarn, true), drawn(yarn, false)) < kUnseen);
      }
    }
  }

  TEST_CASE("structures differ from each other, and a face from its back where it does in cloth") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    const auto drawn = [&](WeaveStructure structure, bool back) {
      ClothPicture picture = flat_cloth(16.0, structure, true);
      picture.cloths[0].back_colour = picture.cloths[0].face_colour;
      if (back) picture.camera.eye.z() = -1.0;
      return renderer.render(picture, kSize, kSize);
    };
    for (const WeaveStructure a : kAll)
      for (const WeaveStructure b : kAll) {
        if (a < b) CHECK(difference(drawn(a, false), drawn(b, false)) > 2.0);
      }
    // Seen from behind, a satin floats along the other yarns and a jersey has no legs.
    for (const WeaveStructure s : {WeaveStructure::kSatin, WeaveStructure::kKnit})
      CHECK(difference(drawn(s, false), drawn(s, true)) > 2.0);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("there are as many yarns as the pitch says, in each direction") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture picture = flat_cloth(16.0, WeaveStructure::kPlain, true);
    picture.cloths[0].yarns.weft_pitch = 2.0 * kPitch;  // five in the height
    const Image image = renderer.render(picture, kSize, kSize);
    // Along the middle of a row of crossings: each seam between two yarns is darker than both crowns.
    const auto seams = [&](bool along_x, int at) {
      int count = 0;
      double mean = 0.0;
      const auto light = [&](int i) { return lightness(along_x ? image.at(i, at) : image.at(at, i)); };
      for (int i = 0; i < kSize; ++i) mean += light(i) / kSize;
      bool dark = light(0) < mean;
      for (int i = 1; i < kSize; ++i) {
        const bool now = light(i) < mean;
        count += now && !dark ? 1 : 0;
        dark = now;
      }
      return count;
    };
    // A crossing begins in the middle of the picture, so that one lies at each side of it.
    CHECK(std::abs(seams(true, kSize / 2 + 16) - 10) <= 1);
    CHECK(std::abs(seams(false, kSize / 2 + 8) - 5) <= 1);
  }

  TEST_CASE("a picture lies on the cloth upright, at its width, repeated") {
    OffscreenRenderer renderer = make_offscreen_renderer();
    ClothPicture picture = flat_cloth(16.0, WeaveStructure::kPlain, false);
    const double side = picture.camera.parallel_height;
    picture.cloths[0].mesh = test::make_flat(side, 4);
    picture.cloths[0].texture = four_fields();
    picture.cloths[0].texture_width = 0.5 * side;  // twice each way
    const Image image = renderer.render(picture, kSize, kSize);
    const auto is = [&](double x, double y, bool red, bool green, bool blue) {
      const std::uint8_t* p = image.at(static_cast<int>(x * kSize), static_cast<int>(y * kSize));
      return (p[0] > 128) == red && (p[1] > 128) == green && (p[2] > 128) == blue;
    };
    for (const double x : {0.0, 0.5})
      for (const double y : {0.0, 0.5}) {
        CHECK(is(x + 0.125, y + 0.125, true, false, false));
        CHECK(is(x + 0.375, y + 0.125, false, true, false));
        CHECK(is(x + 0.125, y + 0.375, false, false, true));
        CHECK(is(x + 0.375, y + 0.375, true, true, true));
      }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("a PNG is read back as it was written; what is wrong with one is told with its name") {
    const std::shared_ptr<Image> image = four_fields();
    const std::string bytes = encode_png(*image);
    CHECK(decode_png(bytes, "a.png").pixels == image->pixels);
    const auto message = [](const std::string& broken) {
      try {
        decode_png(broken, "a.png");
        return std::string("nothing");
      } catch (const Error& e) {
        CHECK(e.kind() == ErrorKind::kBadInput);
        return std::string(e.what());
      }
    };
    CHECK(message("").find("a.png: this is no PNG picture") == 0);
    CHECK(message("GIF89a").find("this is no PNG picture") != std::string::npos);
    CHECK(message(bytes.substr(0, bytes.size() / 2)).find("broken or cut off") != std::string::npos);
    CHECK(message(bytes.substr(0, 20)).find("broken or cut off") != std::string::npos);
    std::string huge = bytes;
    huge[18] = '\x7f';  // width in its second byte but last
    huge[17] = '\x7f';
    CHECK(message(huge).find("pixels, more than 8192 a side") != std::string::npos);
  }
}
