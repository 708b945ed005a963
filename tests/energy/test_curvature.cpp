// Eq. (2): what is printed, what is meant, and what the circle says.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "fuai/energy/bend.h"
#include "fuai/energy/curvature.h"
#include "support/linear_laws.h"

using namespace fuai;

namespace {

constexpr double kQuarter = std::numbers::pi / 4.0;

struct Jump {
  double value, slope;
};

/// Value and slope just below pi/4 minus just above, l = 1.
Jump jump_at_switch(CurvatureForm form) {
  const double above = std::nextafter(kQuarter, 4.0);
  const CurvatureOfAngle low = curvature_of_angle(kQuarter, 1.0, form),
                         high = curvature_of_angle(above, 1.0, form);
  return {low.curvature - high.curvature, low.slope - high.slope};
}

/// Three points on a circle of this radius, turning by `turn` at the middle one, in the x-z plane.
TripleCurvature on_circle(double radius, double turn, double* leg) {
  const auto at = [&](double angle) {
    return Vec3(radius * std::sin(angle), 0.0, radius * (1.0 - std::cos(angle)));
  };
  *leg = 2.0 * radius * std::sin(0.5 * turn);
  return evaluate_curvature(at(-turn), at(0.0), at(turn), *leg, Vec3::UnitZ(), CurvatureForm::kC1);
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("the C1 form has no jump at pi/4; the printed form jumps by -0.0821 and +0.870") {
    const Jump good = jump_at_switch(CurvatureForm::kC1), printed = jump_at_switch(CurvatureForm::kPrinted);
    CHECK(std::abs(good.value) < 1e-12);  // rounding of numbers near 1
    CHECK(std::abs(good.slope) < 1e-12);
    // The reference gives three digits.
    CHECK(printed.value == doctest::Approx(-0.0821).epsilon(1e-3));
    CHECK(printed.slope == doctest::Approx(0.870).epsilon(1e-3));
    CHECK(curvature_of_angle(kQuarter, 1.0, CurvatureForm::kC1).curvature ==
          doctest::Approx(1.847759).epsilon(1e-6));
    CHECK(curvature_of_angle(kQuarter, 1.0, CurvatureForm::kC1).slope ==
          doctest::Approx(-0.382683).epsilon(1e-6));
  }

  TEST_CASE("toward a closed fold the C1 form rises without bound and the printed one falls") {
    double last = 0.0;
    for (double theta = std::numbers::pi; theta > 2.0 * kSmallestAngle; theta *= 0.97) {
      const double K = curvature_of_angle(theta, 1.0, CurvatureForm::kC1).curvature;
      CHECK(K > last);
      last = K;
    }
    CHECK(last > 80.0);  // (pi/4)^2 beta / 2e-3 = 118
    CHECK(curvature_of_angle(2.0 * kSmallestAngle, 1.0, CurvatureForm::kPrinted).curvature < -100.0);
  }

  TEST_CASE("the printed cosine of the whole angle bends flat cloth by -2/l and misses alpha") {
    CHECK(curvature_literal_cosine(std::numbers::pi, 0.5) == doctest::Approx(-4.0));
    CHECK(curvature_of_angle(std::numbers::pi, 0.5, CurvatureForm::kC1).curvature < 1e-15);
    CHECK(curvature_literal_cosine(kQuarter, 1.0) == doctest::Approx(std::numbers::sqrt2));
  }

  TEST_CASE("on a circle the curvature is 1/R; with the chord of the ends it is about half of it") {
    double least = 1.0, most = 0.0;
    for (double turn = 0.02; turn < 1.0; turn += 0.02) {
      double leg = 0.0;
      const TripleCurvature c = on_circle(0.013, turn, &leg);
      // A few ulp of |a + b|, whose rounding weighs 1 / turn.
      CHECK(std::abs(c.curvature * 0.013 - 1.0) < 1e-14 / turn);
      const double chord = 2.0 * 0.013 * std::sin(turn);
      const double with_chord =
          curvature_of_angle(std::numbers::pi - turn, chord, CurvatureForm::kC1).curvature * 0.013;
      least = std::min(least, with_chord);
      most = std::max(most, with_chord);
    }
    CHECK(least == doctest::Approx(0.50).epsilon(0.01));
    CHECK(most == doctest::Approx(0.57).epsilon(0.01));
  }

  TEST_CASE("the sign follows the normal") {
    const Vec3 p(-1, 0, 0.1), m(0, 0, 0), r(1, 0, 0.1);
    for (double side : {1.0, -1.0}) {
      const TripleCurvature c =
          evaluate_curvature(p, m, r, 1.0, side * 7.0 * Vec3::UnitZ(), CurvatureForm::kC1);
      CHECK(c.curvature * side > 0.19);
      CHECK(c.gradient_p.z() * side > 0.9);
    }
    // Flat: the gradient is the normal over l |PM|, on both ends.
    const TripleCurvature flat =
        evaluate_curvature(Vec3(-1, 0, 0), m, Vec3(1, 0, 0), 1.0, 3.0 * Vec3::UnitZ(), CurvatureForm::kC1);
    CHECK(flat.curvature == 0.0);
    CHECK((flat.gradient_p - Vec3::UnitZ()).norm() < 1e-15);
    CHECK((flat.gradient_r - Vec3::UnitZ()).norm() < 1e-15);
  }

  TEST_CASE(
      "the printed branch starts at +HB, pushes nothing at negative curvature, and halves the friction") {
    const PlayLaw law = fuai_test::linear_bending_law(0.1, 0.03);
    const auto branch = [&](double K_per_cm) {
      const double K = K_per_cm * unit::kPerCentimetre;
      return ascending_branch(K, law.elastic().evaluate(K), law.friction().evaluate(K));
    };
    const auto gf = [](double newton) { return newton / unit::kGfCmPerCm; };
    // All exact but for rounding: straight tables.
    CHECK(gf(branch(0.0).value) == doctest::Approx(0.03).epsilon(1e-12));
    CHECK(branch(-1e-9).value == 0.0);
    CHECK(branch(-0.29).value == 0.0);
    CHECK(gf(branch(-1.0).value) == doctest::Approx(-0.07).epsilon(1e-12));
    CHECK(gf(branch(0.5).value) == doctest::Approx(0.08).epsilon(1e-12));
    const BendValue printed = bend_as_printed(0.5 * unit::kPerCentimetre, branch(0.5));
    CHECK(gf(printed.moment) == doctest::Approx(0.065).epsilon(1e-12));  // B K + HB / 2
    CHECK(printed.energy / unit::kGfPerCm == doctest::Approx(0.02).epsilon(1e-12));
    const BendValue true_law = bend_with_memory(law, 0.5 * unit::kPerCentimetre, PlayState{});
    CHECK(gf(true_law.moment) == doctest::Approx(0.08).epsilon(1e-12));  // all plays have slipped
  }
}
