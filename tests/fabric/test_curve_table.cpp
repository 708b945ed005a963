// Curve tables: nodes, monotony, integrals, extrapolation.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/fabric/curve_table.h"

using namespace fuai;

namespace {

std::vector<double> monotone_values(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::exponential_distribution<double> step(1.0);
  std::vector<double> values{-3.0};
  for (std::size_t i = 1; i < n; ++i) values.push_back(values.back() + (i % 7 == 3 ? 0.0 : step(random)));
  return values;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a table returns its nodes and its low and high ends") {
    const std::vector<double> values = monotone_values(41, 1);
    const CurveTable table = make_curve_table(-2.0, 2.0, values);
    for (std::size_t i = 0; i < values.size(); ++i) {
      CHECK(table.evaluate(table.node_position(i)).value == doctest::Approx(values[i]).epsilon(1e-13));
    }
    CHECK(table.evaluate(2.0).value == doctest::Approx(values.back()).epsilon(1e-14));
  }

  TEST_CASE("a table without nodes is zero everywhere") {
    const CurveTable empty;
    for (double x : {-1.0, 0.0, 0.5, 1.0, 2.0}) {
      CAPTURE(x);
      CHECK(empty.evaluate(x).value == 0.0);
      CHECK(empty.evaluate(x).slope == 0.0);
      CHECK(empty.integral(x) == 0.0);
      CHECK(empty.first_moment(x) == 0.0);
    }
  }

  TEST_CASE("bad tables are refused") {
    const std::vector<double> one{1.0}, bad{0.0, NAN}, good{0.0, 1.0};
    CHECK_THROWS_AS(make_curve_table(0, 1, one), Error);
    CHECK_THROWS_AS(make_curve_table(0, 1, bad), Error);
    CHECK_THROWS_AS(make_curve_table(1, 0, good), Error);
    CHECK_THROWS_AS(make_curve_table(0, 1, good, jamming_outside(0.9)), Error);
  }
}

TEST_SUITE("property") {
  TEST_CASE("a rising table rises everywhere and stays between its neighbours") {
    for (unsigned seed = 0; seed < 20; ++seed) {
      const std::vector<double> values = monotone_values(33, seed);
      const CurveTable table = make_curve_table(-1.0, 3.0, values);
      double last = values.front();
      for (int k = 0; k <= 3200; ++k) {
        const CurveValue v = table.evaluate(-1.0 + 4.0 * k / 3200);
        CHECK(v.value >= last - 1e-13);
        CHECK(v.slope >= -1e-12);
        last = v.value;
      }
      CHECK(last <= values.back() + 1e-13);
    }
  }
}

TEST_SUITE("derivative") {
  TEST_CASE("slope and integrals are derivatives of one another, inside and outside, through every rule") {
    const std::vector<double> values = monotone_values(21, 5);
    for (const Extrapolation& rule : {Extrapolation{}, constant_outside(), jamming_outside(3.0)}) {
      const CurveTable table = make_curve_table(-1.0, 2.0, values, rule);
      for (double x = -2.93; x < 2.95; x += 0.0617) {
        CAPTURE(x);
        const double h = 1e-6;
        const CurveValue v = table.evaluate(x);
        const double scale = 1.0 + std::abs(v.value) + std::abs(v.slope);
        CHECK(std::abs((table.evaluate(x + h).value - table.evaluate(x - h).value) / (2 * h) - v.slope) <
              1e-3 * scale);
        CHECK(std::abs((table.integral(x + h) - table.integral(x - h)) / (2 * h) - v.value) < 1e-7 * scale);
        CHECK(std::abs((table.first_moment(x + h) - table.first_moment(x - h)) / (2 * h) - x * v.value) <
              1e-7 * scale);
      }
      CHECK(table.integral(0.0) == doctest::Approx(0.0));
      CHECK(table.first_moment(0.0) == doctest::Approx(0.0));
    }
  }

  TEST_CASE("a jammed table stays finite at and beyond its limit, and its stiffness grows") {
    const std::vector<double> line{-1.0, 0.0, 1.0};
    const CurveTable table = make_curve_table(-1.0, 1.0, line, jamming_outside(10.0));
    CHECK(table.evaluate(1.0).slope == doctest::Approx(1.0));
    CHECK(table.evaluate(9.9).slope > 1000.0);
    CHECK(std::isfinite(table.evaluate(1e6).value));
    CHECK(std::isfinite(table.integral(-1e6)));
    CHECK(table.evaluate(-5.0).value == doctest::Approx(-table.evaluate(5.0).value));
  }
}
