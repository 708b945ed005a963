// Outlines and clamp regions: measures, checks, splitting, triangles, distances.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "cloth/piece_shapes.h"
#include "fuai/cloth/clamp.h"
#include "fuai/cloth/outline.h"
#include "fuai/cloth/piece_mesh.h"
#include "fuai/core/error.h"

using namespace fuai;
using namespace fuai::test;

namespace {

/// A square of side 4 with a notch from above down to y = 1, between x = 1 and x = 2.
Polygon notched() {
  return {Vec2(0, 0), Vec2(4, 0), Vec2(4, 4), Vec2(2, 4), Vec2(2, 1), Vec2(1, 1), Vec2(1, 4), Vec2(0, 4)};
}

double total_area(const std::vector<Polygon>& polygons) {
  double area = 0.0;
  for (const Polygon& p : polygons) area += polygon_area(p);
  return area;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a disc has the area of the circle whatever its segments") {
    const double pi = std::numbers::pi;
    for (int segments : {3, 16, 33, 720}) {
      const Polygon disc = make_disc_outline(0.3, segments);
      CHECK(disc.size() % 4 == 0);
      CHECK(polygon_area(disc) == relative(pi * 0.0225, 1e-13));
      CHECK(polygon_centroid(disc).norm() < 1e-15);  // rounding of 720 terms of 0.1
      // Isoperimetric: longer than the circle by (pi / n)^2 / 6, next term (pi / n)^4 / 40 or so.
      const double step = pi / static_cast<double>(disc.size());
      const double excess = polygon_perimeter(disc) / (pi * 0.3) - 1.0;
      CHECK(excess == relative(step * step / 6.0, step * step + 1e-9));
    }
  }

  TEST_CASE("area, centroid and perimeter; the grain angle turns without stretch") {
    const Polygon box = make_rectangle_outline(0.3, 0.2);
    CHECK(polygon_area(box) == relative(0.06, 1e-15));
    CHECK(polygon_perimeter(box) == relative(1.0, 1e-15));
    CHECK((polygon_centroid(box) - Vec2(0.15, 0.1)).norm() < 1e-16);
    CHECK((polygon_centroid(notched()) - Vec2((32.0 - 4.5) / 13.0, (32.0 - 7.5) / 13.0)).norm() < 1e-14);
    const Polygon turned = rotate_outline(box, 0.25 * std::numbers::pi);
    CHECK(polygon_area(turned) == relative(0.06, 1e-14));
    CHECK((turned[1] - Vec2(1.0, 1.0) * 0.3 / std::numbers::sqrt2).norm() < 1e-16);
    CHECK(polygon_area(Polygon(box.rbegin(), box.rend())) == -polygon_area(box));
  }

  TEST_CASE("inside and distance") {
    const Polygon p = notched();
    CHECK(polygon_contains(p, Vec2(0.5, 3.0)));
    CHECK_FALSE(polygon_contains(p, Vec2(1.5, 3.0)));
    CHECK(polygon_contains(p, Vec2(1.5, 0.5)));
    CHECK_FALSE(polygon_contains(p, Vec2(5.0, 1.0)));
    CHECK(polygon_signed_distance(p, Vec2(1.5, 3.0)) == relative(0.5, 1e-12));
    CHECK(polygon_signed_distance(p, Vec2(3.0, 3.2)) == relative(-0.8, 1e-12));
    CHECK(polygon_signed_distance(p, Vec2(7.0, 8.0)) == relative(5.0, 1e-12));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("outlines are put in order") {
    const Polygon clockwise = {Vec2(0, 0), Vec2(0, 1), Vec2(0, 1), Vec2(1, 1), Vec2(1, 0), Vec2(0, 0)};
    const Polygon outline = make_outline(clockwise);
    CHECK(outline.size() == 4);
    CHECK(polygon_area(outline) == 1.0);
    CHECK_NOTHROW(make_outline(notched()));
    CHECK_NOTHROW(
        make_outline(Polygon{Vec2(0, 0), Vec2(1, 0), Vec2(2, 0), Vec2(2, 1)}));  // a corner in a side
    CHECK_THROWS_AS(make_rectangle_outline(0.1, -0.1), Error);
    CHECK_THROWS_AS(make_disc_outline(std::numeric_limits<double>::infinity()), Error);
    CHECK_THROWS_AS(make_disc_outline(0.1, 2), Error);
  }

  TEST_CASE("splitting gives the right number of simple polygons") {
    struct Case {
      int axis;
      double at;
      std::size_t low, high;
      double low_area;
    };
    // Through the notch, along its bottom and sides, along and beyond the outside.
    for (const Case& c : {Case{1, 2.0, 1, 2, 7.0}, Case{1, 1.0, 1, 2, 4.0}, Case{0, 1.0, 1, 1, 4.0},
                          Case{0, 1.5, 1, 1, 4.5}, Case{0, 2.0, 1, 1, 5.0}, Case{1, 4.0, 1, 0, 13.0},
                          Case{1, 0.0, 0, 1, 0.0}, Case{0, -1.0, 0, 1, 0.0}, Case{0, 5.0, 1, 0, 13.0}}) {
      CAPTURE(c.axis);
      CAPTURE(c.at);
      const SplitPolygon split = split_polygon(notched(), c.axis, c.at);
      CHECK(split.low.size() == c.low);
      CHECK(split.high.size() == c.high);
      CHECK(total_area(split.low) == c.low_area);
      CHECK(total_area(split.high) == 13.0 - c.low_area);
    }
    // A corner that only touches the line from above or below makes no cut.
    const Polygon tooth = {Vec2(0, 0), Vec2(4, 0), Vec2(4, 2), Vec2(2, 1), Vec2(0, 2)};
    CHECK(split_polygon(tooth, 1, 1.0).low.size() == 1);
    CHECK(split_polygon(tooth, 1, 1.0).high.size() == 2);
    CHECK(total_area(split_polygon(tooth, 1, 1.0).high) == 2.0);
  }

  TEST_CASE(
      "corners on the line leave simple polygons: spikes beside an edge on the line, tips that touch it") {
    // Above y = 3 a body whose bottom lies on the line, with a spike to the left on the line and one below
    // it.
    const Polygon spikes = {Vec2(5, 5), Vec2(3, 5), Vec2(3, 4), Vec2(0, 3),
                            Vec2(3, 3), Vec2(2, 0), Vec2(4, 3), Vec2(5, 3)};
    const SplitPolygon split = split_polygon(spikes, 1, 3.0);
    REQUIRE(split.low.size() == 1);
    REQUIRE(split.high.size() == 1);
    CHECK(split.low[0].size() == 3);   // the lower spike and nothing along the line
    CHECK(split.high[0].size() == 7);  // keeps the ends of the lower spike, so that both sides share them
    // A notch from below whose tip touches the line: two polygons below, and the tip is a corner above.
    const Polygon notch = {Vec2(0, 0), Vec2(1, 0), Vec2(2, 2), Vec2(3, 0),
                           Vec2(4, 0), Vec2(4, 3), Vec2(0, 3)};
    const SplitPolygon tips = split_polygon(notch, 1, 2.0);
    CHECK(tips.low.size() == 2);
    REQUIRE(tips.high.size() == 1);
    CHECK(tips.high[0].size() == 5);
    // The same upside down, and turned so that the line is x = 2.
    Polygon above, aside;
    for (const Vec2& p : notch) above.emplace_back(-p.x(), 4.0 - p.y());
    for (const Vec2& p : notch) aside.emplace_back(4.0 - p.y(), p.x());
    CHECK(split_polygon(above, 1, 2.0).high.size() == 2);
    CHECK(split_polygon(above, 1, 2.0).low.size() == 1);
    CHECK(split_polygon(aside, 0, 2.0).high.size() == 2);
    CHECK(split_polygon(aside, 0, 2.0).low.size() == 1);
  }

  TEST_CASE("triangles of a hollow polygon") {
    const Polygon p = notched();
    double area = 0.0;
    for (const auto& t : triangulate(p)) {
      const auto corner = [&](std::size_t k) { return p[static_cast<std::size_t>(t[k])]; };
      const double triangle = polygon_area(Polygon{corner(0), corner(1), corner(2)});
      CHECK(triangle > 0.0);
      CHECK(polygon_contains(p, (corner(0) + corner(1) + corner(2)) / 3.0));
      area += triangle;
    }
    CHECK(area == 13.0);
  }

  TEST_CASE("a yarn beside a region, or one that never leaves it") {
    const double inf = std::numeric_limits<double>::infinity();
    const DiscRegion disc{Vec2(0, 0), 1.0};
    CHECK(region_exit_distance(disc, Vec2(0.0, 1.2), Vec2::UnitX()) == -inf);
    CHECK(region_exit_distance(disc, Vec2(-2.0, 0.0), Vec2::UnitX()) == -inf);  // still before it
    CHECK(region_exit_distance(disc, Vec2(1.25, 0.0), Vec2::UnitX()) == relative(-0.25, 1e-12));
    const HalfPlaneRegion half{Vec2::UnitX(), 0.5};
    CHECK(region_exit_distance(half, Vec2(0.0, 0.0), Vec2::UnitY()) == inf);
    CHECK(region_exit_distance(half, Vec2(1.0, 0.0), Vec2::UnitY()) == -inf);
    CHECK(region_exit_distance(half, Vec2(0.75, 0.0), Vec2::UnitX()) == relative(-0.25, 1e-12));
    const PolygonRegion box = make_rectangle_region(Vec2(0, 0), Vec2(1, 1));
    CHECK(region_exit_distance(box, Vec2(1.0, 0.5), Vec2::UnitX()) == 0.0);
    CHECK(region_exit_distance(box, Vec2(0.25, 0.5), -Vec2::UnitX()) == relative(0.25, 1e-12));
    CHECK(region_exit_distance(box, Vec2(1.0, 1.5), Vec2::UnitX()) == -inf);
  }
}

TEST_SUITE("crosscheck") {
  TEST_CASE("a disc region and a polygon with many sides measure the same") {
    const DiscRegion disc{Vec2(0.0, 0.0), 0.09};
    const PolygonRegion polygon{make_disc_outline(0.18, 4096)};
    CHECK(rc::check("distances", [&] {
      const Vec2 p(0.001 * *rc::gen::inRange(-130, 130) + 0.0003,
                   0.001 * *rc::gen::inRange(-130, 130) + 0.0004);
      const Vec2 direction = *rc::gen::element(Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1));
      // Sides stray from the circle by r (pi / 4096)^2 / 2 = 2.6e-8 m.
      RC_ASSERT(std::abs(region_signed_distance(disc, p) - region_signed_distance(polygon, p)) < 6e-8);
      const double a = region_exit_distance(disc, p, direction),
                   b = region_exit_distance(polygon, p, direction);
      const bool both_miss = std::isinf(a) && a == b;
      // Along a yarn that grazes the circle the difference grows as 1 / cosine, 15 at most off this grid.
      RC_ASSERT(both_miss || std::abs(a - b) < 1e-6);
    }));
  }
}
