// Colour maps and fixed colours.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "fuai/picture/colour_map.h"

using namespace fuai;

namespace {

double lightness(const Colour& c) {
  return 0.2126 * srgb_to_linear(c.red) + 0.7152 * srgb_to_linear(c.green) + 0.0722 * srgb_to_linear(c.blue);
}

double distance(const Colour& a, const Colour& b) {
  return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the sequential map becomes lighter all the way") {
    for (int i = 1; i <= 200; ++i)
      CHECK(lightness(sample_colour_map(ColourMap::kSequential, i / 200.0)) >
            lightness(sample_colour_map(ColourMap::kSequential, (i - 1) / 200.0)));
  }

  TEST_CASE("the diverging map is lightest in the middle, blue below and red above") {
    const double middle = lightness(sample_colour_map(ColourMap::kDiverging, 0.5));
    CHECK(middle > 0.9);
    for (double t : {0.0, 0.1, 0.3, 0.7, 0.9, 1.0}) {
      const Colour c = sample_colour_map(ColourMap::kDiverging, t);
      CHECK(lightness(c) < middle);
      CHECK((c.blue > c.red) == (t < 0.5));
    }
  }

  TEST_CASE("values outside take the end colours, NaN the grey of no value") {
    for (ColourMap map : {ColourMap::kSequential, ColourMap::kDiverging}) {
      CHECK(distance(sample_colour_map(map, -3.0), sample_colour_map(map, 0.0)) == 0.0);
      CHECK(distance(sample_colour_map(map, 7.0), sample_colour_map(map, 1.0)) == 0.0);
      CHECK(distance(sample_colour_map(map, std::numeric_limits<double>::quiet_NaN()), kNoValueColour) ==
            0.0);
    }
  }

  TEST_CASE("warp, weft and bias have three different colours, those of the first three series") {
    for (Direction a : {Direction::kWarp, Direction::kWeft, Direction::kBias}) {
      CHECK(distance(yarn_colour(a), series_colour(static_cast<int>(a))) == 0.0);
      for (Direction b : {Direction::kWarp, Direction::kWeft, Direction::kBias})
        CHECK((distance(yarn_colour(a), yarn_colour(b)) > 0.3) == (a != b));
    }
  }

  TEST_CASE("sRGB encoding and decoding are inverse") {
    // Both branches are exact inverses; what is left is rounding of pow, a few units in the last place.
    for (int i = 0; i <= 255; ++i)
      CHECK(linear_to_srgb(srgb_to_linear(i / 255.0)) == doctest::Approx(i / 255.0).epsilon(1e-6));
    CHECK(srgb_to_linear(0.5) == doctest::Approx(0.21404).epsilon(1e-4));
  }
}
