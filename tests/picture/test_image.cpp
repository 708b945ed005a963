// Images in memory.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include "fuai/core/error.h"
#include "fuai/picture/image.h"

using namespace fuai;

namespace {

Image plain(int size, std::uint8_t grey) {
  Image image;
  image.width = image.height = size;
  image.pixels.assign(4 * static_cast<std::size_t>(size * size), grey);
  return image;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("tiles stand row by row, the rest is white") {
    const Image sheet = tile_images({plain(16, 10), plain(16, 20), plain(16, 30)}, 2);
    CHECK(sheet.width == 32);
    CHECK(sheet.height == 32);
    CHECK(*sheet.at(0, 0) == 10);
    CHECK(*sheet.at(31, 15) == 20);
    CHECK(*sheet.at(0, 16) == 30);
    CHECK(*sheet.at(16, 16) == 255);
    CHECK_THROWS_AS(tile_images({}, 2), Error);
    CHECK_THROWS_AS(tile_images({plain(16, 1), plain(17, 1)}, 2), Error);
  }
}
