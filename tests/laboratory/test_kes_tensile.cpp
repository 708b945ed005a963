// The virtual tensile tester.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>

#include "fuai/core/error.h"
#include "fuai/fabric/cycle_comparison.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/laboratory/kes_instruments.h"
#include "fuai/units/constants.h"
#include "support/small_cloth.h"

using namespace fuai;
using fuai_test::uneven_laws;

namespace {

constexpr double kLoad = 500.0 * unit::kGfPerCm;

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("the law comes back, the stop is the load, the end is no load") {
    const FabricLaws laws = uneven_laws();
    for (Direction direction : {Direction::kWarp, Direction::kWeft}) {
      KesOptions options;
      options.direction = direction;
      options.reversals = {{0.01, 0.005}, {0.02, 0.0}};
      const KesRecord record = run_kes_tensile(laws, options);
      REQUIRE(record.curve.branches.size() == 6);
      const auto last = [&](std::size_t b) { return record.curve.branches[b].samples.back(); };
      CHECK(last(0).strain == doctest::Approx(0.01).epsilon(1e-12));
      CHECK(last(1).strain == doctest::Approx(0.005).epsilon(1e-12));
      CHECK(last(2).strain == doctest::Approx(0.02).epsilon(1e-12));
      // A stop is met to 1e-9 of the load.
      CHECK(std::abs(last(3).stress) < 2e-9 * kLoad);
      CHECK(last(4).stress == doctest::Approx(kLoad).epsilon(2e-9));
      CHECK(std::abs(last(5).stress) < 2e-9 * kLoad);
      const PlayLaw& law = laws.tensile[static_cast<std::size_t>(direction)];
      // What the solver leaves open.
      for (const CycleMisfit& c : compare_cycles(law, record.curve).cycles) CHECK(c.max_fraction < 1e-7);
    }
  }

  TEST_CASE("a stop at a strain") {
    KesOptions options;
    options.stop_strain = 0.025;
    const KesRecord record = run_kes_tensile(uneven_laws(), options);
    CHECK(record.curve.branches[0].samples.back().strain == doctest::Approx(0.025).epsilon(1e-12));
    CHECK(record.curve.branches[0].samples.size() == 101);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("a cloth that never carries the load is reported") {
    FabricLaws laws = uneven_laws();
    laws.tensile[0] = fuai_test::straight_law(1.0, 0.0, 0.5);
    CHECK_THROWS_AS(run_kes_tensile(laws, {}), Error);
  }
}
