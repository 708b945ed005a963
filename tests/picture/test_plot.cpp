// Plots: counted pixels, gaps, legend, arrowheads, SVG, and what is refused.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/picture/plot.h"
#include "picture/png_reader.h"

using namespace fuai;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A horizontal line across the whole of a plot of [0, 1] x [0, 1].
Plot make_level(double y, int points = 101) {
  Plot plot;
  plot.x_range = plot.y_range = Range{0.0, 1.0};
  Series series;
  for (int i = 0; i < points; ++i) {
    series.x.push_back(static_cast<double>(i) / (points - 1));
    series.y.push_back(y);
  }
  plot.series = {series};
  return plot;
}

int count_colour(const Plot& plot, int series, double scale = 2.0) {
  const Image image = test::read_png(plot_png(plot, 400, 300, scale));
  return test::count_pixels(
      image, [&](const std::uint8_t* p) { return test::is_near(p, series_colour(series), 12); });
}

/// Well-formedness as far as it goes without a parser: tags nest, attributes are quoted, one root.
bool is_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  int roots = 0;
  for (std::size_t i = 0; i < xml.size();) {
    if (xml[i] != '<') {
      if (xml[i] == '&' && xml.find(';', i) > i + 8) return false;
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    for (char quote = 0; end < xml.size() && (quote != 0 || xml[end] != '>'); ++end) {
      if (quote != 0 ? xml[end] == quote : (xml[end] == '"' || xml[end] == '\''))
        quote = quote != 0 ? '\0' : xml[end];
      if (xml[end] == '<') return false;
    }
    if (end >= xml.size()) return false;
    const std::string tag = xml.substr(i + 1, end - i - 1);
    i = end + 1;
    if (tag.empty()) return false;
    if (tag[0] == '?' || tag[0] == '!') continue;
    const std::string name =
        tag.substr(tag[0] == '/' ? 1 : 0, tag.find_first_of(" \n/", 1) - (tag[0] == '/' ? 1 : 0));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != name) return false;
      open.pop_back();
    } else {
      if (open.empty()) ++roots;
      if (tag.back() != '/') open.push_back(name);
    }
  }
  return open.empty() && roots == 1;
}

/// A bending loop: the law with arrowheads, and points beside it.
Plot make_loop() {
  Plot plot;
  plot.title = "Bending, warp";
  plot.x_label = "curvature [1/cm]";
  plot.y_label = "moment [gf·cm/cm]";
  Series law, measured;
  law.label = "law";
  law.arrows = true;
  measured.label = "measured";
  measured.style = SeriesStyle::kPoints;
  measured.colour = 6;
  const double stiffness = 0.067, width = 0.0165, reach = 2.5, decay = 6.0;
  for (int side : {1, -1}) {
    for (int i = 0; i <= 200; ++i) {
      const double k = side * reach * (i / 100.0 - 1.0), from_turn = std::abs(k + side * reach);
      law.x.push_back(k);
      law.y.push_back(stiffness * k + side * width * (1.0 - 2.0 * std::exp(-decay * from_turn)));
      if (i % 8 != 0) continue;
      measured.x.push_back(k);
      measured.y.push_back(law.y.back() + 0.004 * std::sin(1.7 * i));
    }
  }
  plot.series = {law, measured};
  plot.annotations = {{0.5, -0.05, "2HB = 0.033 gf·cm/cm"}};
  return plot;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a level line covers its length times its width") {
    Plot plot = make_level(0.37);
    plot.series[0].line_width = 6.0;
    // Frame: 400 - 8 (page) - margins. The width is found from the axis line instead of repeating the layout:
    // twice the line width gives twice the pixels, which the antialiased rims (1 pixel each) blur by 2 in 12.
    const int thin = count_colour(plot, 0);
    plot.series[0].line_width = 12.0;
    const int thick = count_colour(plot, 0);
    CHECK(thin > 6 * 2 * 2 * 300);  // 6 pt by at least 300 pt at 4 pixels a square pt
    CHECK(static_cast<double>(thick) / thin == doctest::Approx(2.0).epsilon(2.0 / 12.0));
  }

  TEST_CASE("missing numbers leave a gap of their length") {
    Plot plot = make_level(0.37);
    plot.series[0].line_width = 6.0;
    const int whole = count_colour(plot, 0);
    for (std::size_t i = 41; i < 80; ++i) plot.series[0].y[i] = i % 2 == 0 ? kNaN : INFINITY;
    // Lines end at points 40 and 80 of 0..100: 0.6 of the line is left, with a pixel or two of blur at the
    // ends.
    CHECK(count_colour(plot, 0) == doctest::Approx(0.6 * whole).epsilon(0.01));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("dashes draw less than a line, points less than both, arrowheads more") {
    Plot plot = make_level(0.37, 11);
    const int line = count_colour(plot, 0);
    plot.series[0].arrows = true;
    CHECK(count_colour(plot, 0) > line + 100);
    plot.series[0].arrows = false;
    plot.series[0].style = SeriesStyle::kDashed;
    const int dashed = count_colour(plot, 0);
    CHECK(dashed < 0.75 * line);
    CHECK(dashed > 0.45 * line);
    plot.series[0].style = SeriesStyle::kPoints;
    CHECK(count_colour(plot, 0) > 0);
    CHECK(count_colour(plot, 0) < 0.75 * line);
  }

  TEST_CASE("the legend goes to the empty corner") {
    // A diagonal leaves two corners empty; points in one of them leave the other.
    for (bool points_upper_left : {true, false}) {
      Plot plot;
      plot.x_range = plot.y_range = Range{0.0, 1.0};
      Series diagonal, cloud;
      diagonal.x = diagonal.y = {0.0, 1.0};
      diagonal.label = "diagonal";
      cloud.style = SeriesStyle::kPoints;
      for (int i = 0; i < 40; ++i) {
        const double a = 0.02 + 0.3 * (i % 8) / 8.0, b = 0.75 + 0.24 * (i / 8) / 5.0;
        cloud.x.push_back(points_upper_left ? a : b);
        cloud.y.push_back(points_upper_left ? b : a);
      }
      plot.series = {diagonal, cloud};
      Plot bare = plot;
      bare.legend = false;
      const Image with = test::read_png(plot_png(plot, 400, 300, 1.0));
      const Image without = test::read_png(plot_png(bare, 400, 300, 1.0));
      double x = 0.0, y = 0.0, n = 0.0;
      for (int row = 0; row < 300; ++row) {
        for (int column = 0; column < 400; ++column) {
          if (with.at(column, row)[1] == without.at(column, row)[1]) continue;
          x += column;
          y += row;
          n += 1.0;
        }
      }
      REQUIRE(n > 50.0);
      CHECK((x / n > 200.0) == points_upper_left);
      CHECK((y / n > 150.0) == points_upper_left);
    }
  }

  TEST_CASE("numbers that a logarithmic axis cannot show are counted in the legend") {
    Plot plot;
    plot.y_log = true;
    plot.series = {{{1.0, 2.0, 3.0}, {0.1, 1.0, 10.0}, ""}};
    const std::string clean = plot_png(plot, 300, 200, 1.0);
    Plot worse = plot;
    worse.series[0].x.push_back(2.5);
    worse.series[0].y.push_back(-4.0);
    CHECK(plot_png(worse, 300, 200, 1.0) != clean);  // the note appears although the series has no label
    worse.legend = false;
    CHECK(plot_png(worse, 300, 200, 1.0) == clean);  // and nothing else changes
  }

  TEST_CASE("SVG documents are well formed, also with markup, Japanese and broken UTF-8 in the labels") {
    Plot plot = make_loop();
    plot.title = "<b>\"B & 2HB\"</b> 曲げ \xff";
    plot.reference_lines = {{0.1, false, "limit"}, {1.0, true, "&"}};
    plot.bands = {{0.5, 1.5, true, "band <"}};
    const std::string svg = plot_svg(PlotGrid{"two", 2, {plot, make_loop()}}, 800, 400);
    CHECK(svg.find("<svg") != std::string::npos);
    CHECK(is_well_formed(svg));
    CHECK_FALSE(is_well_formed("<a><b></a></b>"));
    CHECK_FALSE(is_well_formed("<a x=\"1>"));
  }

  TEST_CASE("the ids of two documents differ, and every reference finds its id") {
    Plot other = make_loop();
    other.title = "Another";
    const std::string first = plot_svg(make_loop(), 400, 300), second = plot_svg(other, 400, 300);
    const auto names = [](const std::string& svg, const std::string& mark) {
      std::set<std::string> found;
      for (std::size_t i = svg.find(mark); i != std::string::npos; i = svg.find(mark, i + 1)) {
        const std::size_t begin = i + mark.size();
        found.insert(svg.substr(begin, svg.find_first_of("\")", begin) - begin));
      }
      return found;
    };
    const std::set<std::string> ids = names(first, " id=\"");
    CHECK(ids.size() > 20);
    for (const char* mark : {"\"#", "(#"}) {
      CHECK_FALSE(names(first, mark).empty());
      for (const std::string& name : names(first, mark)) CHECK(ids.count(name) == 1);
    }
    for (const std::string& name : names(second, " id=\"")) CHECK(ids.count(name) == 0);
  }

  TEST_CASE("a plot without data, with one point, with equal numbers or of huge numbers is drawn") {
    CHECK_NOTHROW(plot_png(Plot{}, 300, 200));
    for (double value : {0.0, 5.0, -1e-12, 1e300}) {
      Plot plot;
      plot.series = {{{1.0, 1.0}, {value, value}, "same"}};
      CHECK_NOTHROW(plot_png(plot, 300, 200));
      plot.series[0].y[1] = kNaN;
      CHECK_NOTHROW(plot_svg(plot, 300, 200));
    }
    Plot far = make_level(0.5);
    far.series[0].y[50] = 1e30;  // far outside the given range
    CHECK_NOTHROW(plot_png(far, 300, 200));
  }

  TEST_CASE("impossible plots are refused") {
    Plot plot = make_level(0.5);
    CHECK_THROWS_AS(plot_png(plot, 5, 200), Error);
    CHECK_THROWS_AS(plot_png(plot, 300, 200, 0.0), Error);
    CHECK_THROWS_AS(plot_png(plot, 3000, 2000, 60.0), Error);
    CHECK_THROWS_AS(plot_png(plot, 40, 40), Error);  // no room for the frame
    CHECK_THROWS_AS(plot_png(PlotGrid{"", 0, {plot}}, 300, 200), Error);
    Plot wrong = plot;
    wrong.series[0].y.pop_back();
    CHECK_THROWS_AS(plot_png(wrong, 300, 200), Error);
    wrong = plot;
    wrong.x_range = Range{2.0, 1.0};
    CHECK_THROWS_AS(plot_png(wrong, 300, 200), Error);
    wrong = plot;
    wrong.x_log = true;  // with a range from 0
    CHECK_THROWS_AS(plot_png(wrong, 300, 200), Error);
  }

  TEST_CASE("two bending loops side by side, kept for the eye") {
    Plot weft = make_loop();
    weft.title = "曲げ特性（緯糸方向）";
    weft.x_label = "曲率 [1/cm]";
    weft.series[0].colour = series_index(Direction::kWeft);
    weft.bands = {{0.5, 1.5, true, "0.5 ... 1.5 1/cm"}};
    const PlotGrid grid{"KES bending", 2, {make_loop(), weft}};
    const std::filesystem::path folder = std::filesystem::path(FUAI_BINARY_DIR) / "pictures";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "loops.svg", std::ios::binary) << plot_svg(grid, 860, 400);
    const std::string png = plot_png(grid, 860, 400, 1.5);
    std::ofstream(folder / "loops.png", std::ios::binary) << png;
    // Both laws are drawn in the colours of warp and weft: at least 300 pt of line, 1.8 pt wide, half of it
    // away from antialiased rims and markers.
    const Image image = test::read_png(png);
    for (Direction direction : {Direction::kWarp, Direction::kWeft})
      CHECK(test::count_pixels(image, [&](const std::uint8_t* p) {
              return test::is_near(p, yarn_colour(direction), 20);
            }) > 0.5 * 300 * 1.8 * 1.5 * 1.5);
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("the same plot gives the same bytes") {
    CHECK(plot_png(make_loop(), 400, 300) == plot_png(make_loop(), 400, 300));
    CHECK(plot_svg(make_loop(), 400, 300) == plot_svg(make_loop(), 400, 300));
  }
}
