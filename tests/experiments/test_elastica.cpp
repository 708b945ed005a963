// The heavy elastica against reference values by Runge-Kutta shooting, six digits and more.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>

#include "fuai/core/error.h"
#include "fuai/experiments/elastica.h"
#include "fuai/units/constants.h"
#include "support/elastica_table.h"

using namespace fuai;

TEST_SUITE("analytic") {
  TEST_CASE("the heavy elastica has the shape of the reference at every load") {
    for (const fuai_test::HeavyRow& row : fuai_test::kHeavyRows) {
      CAPTURE(row.load);
      const HeavyElastica shape = heavy_elastica(row.load);
      // Half a unit of the reference's last digit, and a little.
      CHECK(std::abs(shape.tip_angle / unit::kDegree - row.tip_deg) < 6e-7);
      CHECK(std::abs(shape.reach - row.reach) < 6e-9);
      CHECK(std::abs(shape.droop - row.droop) < 6e-9);
      CHECK(std::abs(shape.chord_angle / unit::kDegree - row.chord_deg) < 6e-6);
      CHECK(std::abs(shape.root_curvature - row.root) < 6e-8);
      CHECK(std::abs(row.load / peirce_load(shape.chord_angle) - row.peirce) < 6e-5);
    }
  }

  TEST_CASE("the load of a chord angle is the reference's") {
    constexpr double kRows[][2] = {{41.5, 8.004197}, {43, 8.516299},  {45, 9.253808}, {30, 4.920940},
                                   {20, 2.994370},   {60, 18.216894}, {7.1, 0.999958}};
    for (const auto& [angle_deg, load] : kRows) {
      CAPTURE(angle_deg);
      CHECK(std::abs(heavy_elastica_load(angle_deg * unit::kDegree) - load) < 6e-7);
    }
  }

  TEST_CASE("small loads: droop lambda / 8; long limp strips: balance of moments and forces") {
    // Next order: lambda^2 of order 1e-2 of it.
    CHECK(heavy_elastica(1e-4).droop == doctest::Approx(1e-4 / 8.0).epsilon(1e-6));
    for (double load : {150.0, 200.0, 1e4, 1e6}) {
      CAPTURE(load);
      const HeavyElastica shape = heavy_elastica(load);
      // Far above the clamp's bend a limp strip is straight and B K^2 / 2 = w L at the clamp, up to the
      // weight of the bend itself, some c of L: first integral of the curve.
      CHECK(shape.root_curvature == doctest::Approx(std::sqrt(2.0 * load)).epsilon(1.5 / std::cbrt(load)));
      CHECK(shape.reach > 0.0);
      CHECK(shape.reach < heavy_elastica(0.9 * load).reach);
      // The inverse stops at 1e-13 of the angle, which grows by some c / L of the log of the load.
      if (load < kMostElasticaLoad)
        CHECK(heavy_elastica_load(shape.chord_angle) == doctest::Approx(load).epsilon(1e-9));
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("loads and angles that no strip has are refused") {
    for (double load : {0.0, -1.0, 2e6, std::nan("")}) CHECK_THROWS_AS(heavy_elastica(load), Error);
    for (double angle : {0.0, -0.1, 1.57079, 2.0, std::nan("")})
      CHECK_THROWS_AS(heavy_elastica_load(angle), Error);
  }
}
