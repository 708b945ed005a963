// Fabrics through the virtual instruments and back.
// SPDX-License-Identifier: Apache-2.0
//
// On coarse lattices: the readings do not depend on the spacing (test_kes_*), and the whole sweep, 200 random
// fabrics at the instruments' own spacings, is `bench_round_trip` (figures: docs/laboratory.md).
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "fuai/fabric/from_curves.h"
#include "fuai/io/fabric_library.h"
#include "fuai/laboratory/kes_round_trip.h"
#include "fuai/units/constants.h"
#include "support/random_fabric.h"

using namespace fuai;

namespace {

KesTest coarse(Test test, Direction direction) {
  KesTest kes;
  kes.test = test;
  kes.direction = direction;
  kes.spacing = test == Test::kBending ? 0.01 / 3.0 : 0.05 / 3.0;
  return kes;
}

void check(const KesRoundTrip& trip, double tolerance) {
  CAPTURE(to_string(trip.test.test));
  CHECK(trip.loop_rms < tolerance);
  for (std::size_t i = 0; i < trip.simulated.size(); ++i) {
    CAPTURE(kes_quantity(trip.input[i].quantity).symbol);
    CHECK(trip.simulated[i].value == doctest::Approx(trip.input[i].value).epsilon(tolerance));
  }
}

void check_all(const Fabric& fabric, Direction direction, double tolerance) {
  CAPTURE(fabric.id);
  CAPTURE(to_string(direction));
  for (Test test : {Test::kBending, Test::kShear, Test::kTensile})
    check(run_kes_round_trip(fabric, coarse(test, direction)), tolerance);
}

}  // namespace

TEST_SUITE("crosscheck+slow") {
  TEST_CASE("every bundled fabric comes back from its instruments within 0.5 %") {
    int turn = 0;
    for (const std::string& id : bundled_fabric_ids()) {
      // Demanded 1 %; measured 0.05 % and less but for 0.2 % in the shear of the knit, whose yarns stretch by
      // a tenth under the tension. The directions take turns, to save time.
      check_all(load_fabric(id), turn++ % 2 == 0 ? Direction::kWarp : Direction::kWeft, 5e-3);
    }
  }

  TEST_CASE("random plausible fabrics come back within 2 %") {
    for (std::size_t family = 0; family < fuai_test::kFamilies.size(); ++family) {
      // Demanded; shear numbers are the mean of warp and weft, which differ where the yarns stretch.
      Fabric fabric = fuai_test::random_fabric(7 + family, family);
      fabric.tensile[1] = fabric.tensile[0];
      check_all(fabric, Direction::kWarp, 2e-2);
    }
  }

  TEST_CASE("what the instrument records can be read as a measurement, and comes back once more") {
    const Fabric wool = load_fabric("wool-tropical");
    Fabric again;
    again.name = "Again";
    again.areal_mass = wool.areal_mass;
    again.thickness = wool.thickness;
    for (Test test : {Test::kBending, Test::kShear}) {
      KesRoundTrip trip = run_kes_round_trip(wool, coarse(test, Direction::kWarp));
      add_measured_curve(again, {std::move(trip.record.curve), {}});
    }
    CHECK(again.warnings.empty());
    for (Test test : {Test::kBending, Test::kShear}) {
      const KesRoundTrip trip = run_kes_round_trip(again, coarse(test, Direction::kWarp));
      CHECK(trip.loop_measured);
      check(trip, 1e-2);  // demanded
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("shear is the mean of both specimens unless a direction is named") {
    const Fabric fabric = fuai_test::random_fabric(4, 4);
    KesTest test = coarse(Test::kShear, Direction::kWarp);
    const double warp = run_kes_round_trip(fabric, test).simulated[0].value;
    test.direction = Direction::kWeft;
    const double weft = run_kes_round_trip(fabric, test).simulated[0].value;
    test.direction.reset();
    const KesRoundTrip both = run_kes_round_trip(fabric, test);
    // The same slope read off the mean curve: rounding, and angles that are met to 1e-4 of a step.
    CHECK(both.simulated[0].value == doctest::Approx(0.5 * (warp + weft)).epsilon(1e-4));
    CHECK(std::abs(warp / weft - 1.0) > 1e-3);
  }

  TEST_CASE("reversals: law and instrument take the same path") {
    KesTest test = coarse(Test::kBending, Direction::kWarp);
    test.reversals = {{50.0, 0.0}, {150.0, 50.0}};
    const KesRoundTrip trip = run_kes_round_trip(load_fabric("polyester-faille"), test);
    CHECK_FALSE(trip.loop_measured);
    CHECK(trip.record.curve.branches.size() == 8);
    check(trip, 1e-3);  // the rational arc tangent at 0.8 rad a segment
  }

  TEST_CASE("a loop that is closed has no width") {
    const KesRoundTrip trip =
        run_kes_round_trip(load_fabric("cupro-woven-su1098"), coarse(Test::kShear, Direction::kWarp));
    CHECK(trip.simulated[1].value == 0.0);  // 2HG: the bias strip shows none
    CHECK(trip.input[1].value == 0.0);
    CHECK(std::isnan(trip.stated[1].value));
  }
}
