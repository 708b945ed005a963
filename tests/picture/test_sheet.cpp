// Pages: things stand where they were put, text that does not fit ends in dots, PNG and SVG alike.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <string>

#include "fuai/core/error.h"
#include "fuai/picture/sheet.h"
#include "picture/png_reader.h"

using namespace fuai;

namespace {

constexpr Colour kRed{0.8, 0.0, 0.0, 1.0}, kBlue{0.0, 0.0, 0.8, 1.0};

Image plain(int width, int height, const Colour& colour) {
  Image image;
  image.width = width, image.height = height;
  for (int i = 0; i < width * height; ++i) {
    for (const double part : {colour.red, colour.green, colour.blue, 1.0})
      image.pixels.push_back(static_cast<std::uint8_t>(255.0 * part + 0.5));
  }
  return image;
}

/// Pixels of a colour inside a box [pt] of a page drawn at one pixel a point.
int count_in(const Image& image, const SheetBox& box, const Colour& colour) {
  int count = 0;
  for (int y = static_cast<int>(box.top); y < static_cast<int>(box.top + box.height); ++y) {
    for (int x = static_cast<int>(box.left); x < static_cast<int>(box.left + box.width); ++x)
      count += test::is_near(image.at(x, y), colour, 60) ? 1 : 0;
  }
  return count;
}

Sheet page() {
  Sheet sheet;
  sheet.width = 300, sheet.height = 200;
  return sheet;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("an image fills its box as far as its sides allow, and nothing else") {
    Sheet sheet = page();
    sheet.images.push_back({{20.0, 10.0, 100.0, 100.0}, plain(64, 32, kBlue)});
    const Image drawn = test::read_png(sheet_png(sheet, 1.0));
    CHECK(drawn.width == 300);
    CHECK(drawn.height == 200);
    // 100 wide, 50 high, in the middle: rows 35 to 85. A rim of one pixel may be blurred.
    CHECK(count_in(drawn, {22.0, 37.0, 96.0, 46.0}, kBlue) == 96 * 46);
    CHECK(count_in(drawn, {0.0, 0.0, 300.0, 200.0}, kBlue) <= 102 * 52);
  }

  TEST_CASE("text keeps to its box: what does not fit is cut") {
    Sheet sheet = page();
    const SheetBox box{40.0, 30.0, 100.0, 26.0};  // two lines of 9 pt
    std::string words;
    for (int i = 0; i < 60; ++i) words += "wool ";
    sheet.texts.push_back({box, words, 9.0, true, kRed});
    const Image drawn = test::read_png(sheet_png(sheet, 1.0));
    const int inside = count_in(drawn, {39.0, 29.0, 103.0, 28.0}, kRed);
    CHECK(inside > 50);
    CHECK(count_in(drawn, {0.0, 0.0, 300.0, 200.0}, kRed) == inside);
  }

  TEST_CASE("cells of a table keep to their columns, to the left or to the right") {
    Sheet sheet = page();
    SheetTable table;
    table.box = {20.0, 20.0, 200.0, 0.0};
    table.columns = {1.0, 1.0};
    table.right = {false, true};
    table.size = 16.0;  // thick enough for whole pixels of the colour
    table.row_height = 20.0;
    table.head = {"", ""};
    table.rows = {{{"a very long text that never fits into a column", ""}, kRed}, {{"", "12"}, kBlue}};
    sheet.tables.push_back(table);
    const Image drawn = test::read_png(sheet_png(sheet, 1.0));
    CHECK(count_in(drawn, {20.0, 20.0, 98.0, 60.0}, kRed) > 20);
    CHECK(count_in(drawn, {120.0, 20.0, 180.0, 60.0}, kRed) == 0);
    CHECK(count_in(drawn, {180.0, 20.0, 40.0, 60.0}, kBlue) > 3);
    CHECK(count_in(drawn, {0.0, 20.0, 180.0, 60.0}, kBlue) == 0);
  }

  TEST_CASE("an SVG page holds its images") {
    Sheet sheet = page();
    sheet.images.push_back({{20.0, 10.0, 100.0, 100.0}, plain(64, 32, kBlue)});
    sheet.plots.push_back({{130.0, 10.0, 160.0, 150.0}, {{}, 1, {Plot{}}}});
    const std::string svg = sheet_svg(sheet);
    CHECK(svg.find("<svg") != std::string::npos);
    CHECK(svg.find("data:image/png;base64,") != std::string::npos);
  }

  TEST_CASE("impossible pages are refused") {
    Sheet sheet = page();
    sheet.tables.push_back({{}, {1.0, 1.0}, {}, {"a"}, {}});
    CHECK_THROWS_AS(sheet_png(sheet, 1.0), Error);
    sheet = page();
    sheet.width = 0;
    CHECK_THROWS_AS(sheet_svg(sheet), Error);
    sheet = page();
    sheet.plots.push_back({{0.0, 0.0, 10.0, 10.0}, {{}, 1, {Plot{}}}});
    CHECK_THROWS_AS(sheet_svg(sheet), Error);
  }
}
