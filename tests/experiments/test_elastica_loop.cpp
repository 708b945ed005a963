// Heavy loops against the tabulated shapes, closed forms and each other.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/elastica_loop.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "fuai/core/error.h"

using namespace fuai;

TEST_SUITE("analytic") {
  TEST_CASE("heights of the table: shooting by another program, six digits") {
    const struct {
      LoopKind kind;
      double load, height;
    } table[] = {
        {LoopKind::kPear, 0, .424308},    {LoopKind::kPear, 1, .424390},   {LoopKind::kPear, 10, .425114},
        {LoopKind::kPear, 50, .428083},   {LoopKind::kPear, 100, .431306}, {LoopKind::kPear, 200, .436525},
        {LoopKind::kPear, 500, .446512},  {LoopKind::kHeart, 0, .133860},  {LoopKind::kHeart, 1, .134436},
        {LoopKind::kHeart, 10, .139540},  {LoopKind::kHeart, 50, .160694}, {LoopKind::kHeart, 100, .184043},
        {LoopKind::kHeart, 200, .222389}, {LoopKind::kHeart, 500, .294065}};
    for (const auto& row : table) {
      CAPTURE(to_string(row.kind));
      CAPTURE(row.load);
      CHECK(std::abs(elastica_loop(row.kind, row.load).height - row.height) <
            1e-6);  // last digit of the table
    }
  }

  TEST_CASE("the weightless ring is a circle, and moments follow from the level force") {
    const ElasticaLoop ring = elastica_loop(LoopKind::kRing, 0.0);
    CHECK(ring.height == doctest::Approx(1.0 / std::numbers::pi).epsilon(1e-9));
    CHECK(ring.bottom_curvature == doctest::Approx(2.0 * std::numbers::pi).epsilon(1e-9));
    CHECK(std::abs(ring.level_force) < 1e-8);
    for (LoopKind kind : {LoopKind::kPear, LoopKind::kHeart}) {
      // Without weight M + H y is the same all along: kappa_bottom - kappa_clamp = -h height.
      const ElasticaLoop loop = elastica_loop(kind, 0.0);
      CHECK(loop.clamp_curvature - loop.bottom_curvature ==
            doctest::Approx(loop.level_force * loop.height).epsilon(1e-8));
    }
  }
}

TEST_SUITE("analytic+slow") {
  TEST_CASE("the load comes back from the height") {
    for (LoopKind kind : {LoopKind::kPear, LoopKind::kRing, LoopKind::kHeart}) {
      for (double load : {5.0, 300.0}) {
        const double height = elastica_loop(kind, load).height;
        // Bisection to 1e-9 of the range, heights to 1e-11 that change by some 1e-5 a unit of load.
        CHECK(elastica_loop_load(kind, height) == doctest::Approx(load).epsilon(1e-5));
      }
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("loads and heights out of range are refused") {
    CHECK_THROWS_AS(elastica_loop(LoopKind::kHeart, -1.0), Error);
    CHECK_THROWS_AS(elastica_loop(LoopKind::kHeart, 1e5), Error);
    CHECK_THROWS_AS(elastica_loop_load(LoopKind::kHeart, 0.1), Error);
    CHECK_THROWS_AS(elastica_loop_load(LoopKind::kPear, 0.5), Error);
  }
}
