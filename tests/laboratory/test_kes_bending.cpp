// The virtual bending tester.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/fabric/cycle_comparison.h"
#include "fuai/laboratory/kes_instruments.h"
#include "fuai/units/constants.h"
#include "support/small_cloth.h"

using namespace fuai;
using fuai_test::uneven_laws;

namespace {

KesOptions narrow(Direction direction) {
  KesOptions options;
  options.direction = direction;
  options.width = 0.02;
  return options;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("pure bending gives the law back: face, back, reversals, warp and weft") {
    const FabricLaws laws = uneven_laws();
    for (Direction direction : {Direction::kWarp, Direction::kWeft}) {
      KesOptions options = narrow(direction);
      options.reversals = {{100.0, 20.0}, {150.0, 0.0}};
      const KesRecord record = run_kes_bending(laws, options);
      const PlayLaw& law = laws.bending[static_cast<std::size_t>(direction)];
      for (const CycleMisfit& cycle : compare_cycles(law, record.curve).cycles) {
        // 2e-5: the rational arc tangent of the curvature at 0.5 rad a segment.
        CHECK(cycle.max_fraction < 1e-4);
      }
    }
  }

  TEST_CASE("the moment does not depend on the width or the spacing") {
    const FabricLaws laws = uneven_laws();
    std::vector<double> moments;
    for (double width : {0.02, 0.05}) {
      for (double spacing : {0.002, 0.00125}) {
        KesOptions options = narrow(Direction::kWarp);
        options.width = width;
        options.spacing = spacing;
        options.high = 120.0;
        moments.push_back(run_kes_bending(laws, options).curve.branches[0].samples.back().stress);
      }
    }
    for (double m : moments) CHECK(m == doctest::Approx(moments[0]).epsilon(1e-5));  // as above
  }
}

TEST_SUITE("unit") {
  TEST_CASE("the path: 2.5, -2.5 and 0 /cm, split at zero") {
    const KesRecord record = run_kes_bending(uneven_laws(), narrow(Direction::kWarp));
    REQUIRE(record.curve.branches.size() == 4);
    CHECK(record.curve.branches[0].samples.front().stress == 0.0);
    CHECK(record.curve.branches[0].samples.back().strain == doctest::Approx(250.0).epsilon(1e-12));
    CHECK(record.curve.branches[2].samples.back().strain == doctest::Approx(-250.0).epsilon(1e-12));
    CHECK(std::abs(record.curve.branches[3].samples.back().strain) < 1e-9);
    CHECK(record.curve.branches[1].kind == Branch::kUnload);
    CHECK(record.curve.branches[2].kind == Branch::kLoad);
  }

  TEST_CASE("tests that cannot be done are refused") {
    KesOptions options = narrow(Direction::kWarp);
    options.high = 400.0;  // four radians
    CHECK_THROWS_AS(run_kes_bending(uneven_laws(), options), Error);
    options.high = 100.0;
    options.low = 50.0;
    CHECK_THROWS_AS(run_kes_bending(uneven_laws(), options), Error);
    options = narrow(Direction::kWarp);
    options.spacing = 0.003;
    CHECK_THROWS_AS(run_kes_bending(uneven_laws(), options), Error);
  }
}
