// Loops of the engine against the exact heavy elastica.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "fuai/core/constants.h"
#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/laboratory/hanging_loop.h"
#include "fuai/units/constants.h"
#include "support/linear_laws.h"
#include "support/small_cloth.h"

using namespace fuai;

namespace {

constexpr double kLength = 0.2, kMass_g_per_m2 = 160.0;

/// No friction, a rigidity that makes the load, and yarns that stretch by some 1e-6.
FabricLaws linear_fabric(double load) {
  const double B = kMass_g_per_m2 * unit::kGPerM2 * kStandardGravity * std::pow(kLength, 3) / load;
  FabricLaws laws = fuai_test::linear_laws(B / unit::kGfCm2PerCm, 0.0, kMass_g_per_m2);
  laws.tensile = {fuai_test::straight_law(1e5, 0.0, 1.0), fuai_test::straight_law(1e5, 0.0, 1.0)};
  laws.shear = fuai_test::straight_law(50.0, 0.0, 1.0);
  return laws;
}

HangingLoopResult hang(LoopKind kind, double load, int segments) {
  HangingLoopOptions options;
  options.kind = kind;
  options.length = kLength;
  options.segments = segments;
  options.load_steps = 5;  // without friction the path makes no difference
  return run_hanging_loop(linear_fabric(load), options);
}

}  // namespace

TEST_SUITE("analytic+slow") {
  TEST_CASE("hearts, pears and rings hang as the heavy elastica does, within 0.3 %") {
    for (LoopKind kind : {LoopKind::kHeart, LoopKind::kPear, LoopKind::kRing}) {
      for (double load : {10.0, 200.0}) {
        CAPTURE(to_string(kind));
        CAPTURE(load);
        const HangingLoopResult r = hang(kind, load, kLoopSegments);
        const double exact = elastica_loop(kind, load).height;
        MESSAGE(to_string(kind) << " " << load << ": " << 100.0 * (r.height / kLength / exact - 1.0) << " %");
        CHECK(r.height / kLength == doctest::Approx(exact).epsilon(3e-3));  // demanded
      }
    }
  }
}

TEST_SUITE("analytic+slow") {
  TEST_CASE("the bending length of a heart comes back") {
    const HangingLoopResult r = hang(LoopKind::kHeart, 100.0, kLoopSegments);
    // 0.1 % of height is 0.2 % of the bending length of a heart under this load.
    CHECK(r.bending_length == doctest::Approx(kLength / std::cbrt(100.0)).epsilon(3e-3));
  }
}

TEST_SUITE("convergence+slow") {
  TEST_CASE("the height of a heart converges with order 2") {
    std::vector<double> errors;
    for (int segments : {40, 80})
      errors.push_back(std::abs(hang(LoopKind::kHeart, 100.0, segments).height / kLength -
                                elastica_loop(LoopKind::kHeart, 100.0).height));
    CHECK(std::log2(errors[0] / errors[1]) > 1.8);  // order 2; measured 2.0, and 1.3 from 20 to 40
  }
}

TEST_SUITE("property+slow") {
  TEST_CASE("friction holds a heart up") {
    HangingLoopOptions options;
    options.segments = 40;
    const FabricLaws laws = make_fabric_laws(load_fabric("wool-tropical"));
    const HangingLoopResult with = run_hanging_loop(laws, options);
    options.elastic = true;
    const HangingLoopResult without = run_hanging_loop(laws, options);
    CHECK(with.height < without.height);
    CHECK(without.bending_length > 0.0);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("loops that cannot be made are refused") {
    const FabricLaws laws = linear_fabric(10.0);
    HangingLoopOptions options;
    options.length = 0.0;
    CHECK_THROWS_AS(run_hanging_loop(laws, options), Error);
    options.length = 0.2;
    options.segments = 8;
    CHECK_THROWS_AS(run_hanging_loop(laws, options), Error);
    options.segments = 80;
    options.direction = Direction::kBias;
    CHECK_THROWS_AS(run_hanging_loop(laws, options), Error);
  }
}
