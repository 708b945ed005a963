// The cantilever test with a slanting line.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/overhang.h"

#include <doctest/doctest.h>

#include <cmath>

#include "fuai/core/error.h"
#include "fuai/experiments/elastica.h"
#include "fuai/units/constants.h"
#include "support/linear_laws.h"
#include "support/small_cloth.h"

using namespace fuai;

namespace {

constexpr double kB_gf_cm2_per_cm = 0.1, kMass_g_per_m2 = 160.0;

FabricLaws linear_fabric() {
  FabricLaws laws = fuai_test::linear_laws(kB_gf_cm2_per_cm, 0.0, kMass_g_per_m2);
  laws.tensile = {fuai_test::straight_law(1e4, 0.0, 1.0), fuai_test::straight_law(1e4, 0.0, 1.0)};
  laws.shear = fuai_test::straight_law(50.0, 0.0, 1.0);
  return laws;
}

}  // namespace

TEST_SUITE("analytic+slow") {
  TEST_CASE("the overhang at 41.5 and 43 degrees is that of the elastica, within 0.3 %") {
    const double c =
        std::cbrt(kB_gf_cm2_per_cm * unit::kGfCm2PerCm / (kMass_g_per_m2 * unit::kGPerM2 * kStandardGravity));
    for (double angle : {kFlexometerAngle, kOtherFlexometerAngle}) {
      CantileverOptions options;
      options.load_steps = 1;  // no friction, no path
      const OverhangResult r = find_overhang(linear_fabric(), options, angle);
      // Demanded; measured 0.04 %.
      CHECK(r.overhang == doctest::Approx(c * std::cbrt(heavy_elastica_load(angle))).epsilon(3e-3));
      CHECK(r.cantilever.bending_length == doctest::Approx(c).epsilon(3e-3));
      CHECK(r.cantilever.chord_angle == doctest::Approx(angle).epsilon(2e-4));
    }
    // Half the overhang is the bending length at 41.5 degrees, to 0.02 %, and 2.1 % too much at 43.
    CHECK(0.5 * std::cbrt(heavy_elastica_load(kFlexometerAngle)) == doctest::Approx(1.0).epsilon(2e-4));
    CHECK(0.5 * std::cbrt(heavy_elastica_load(kOtherFlexometerAngle)) ==
          doctest::Approx(1.021).epsilon(1e-3));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("angles and spacings that make no test are refused") {
    CantileverOptions options;
    CHECK_THROWS_AS(find_overhang(linear_fabric(), options, 0.0), Error);
    CHECK_THROWS_AS(find_overhang(linear_fabric(), options, 1.5), Error);
    options.spacing = 0.001;
    CHECK_THROWS_AS(find_overhang(linear_fabric(), options, kFlexometerAngle), Error);
  }
}
