// The buckled strip against the elastica, the catenary, energy balance and a halved mesh.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/fabric/buckling.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/units/constants.h"

using namespace fuai;

namespace {

/// Moment B K plus friction of bound HB.
PlayLaw bending_law(double B, double HB) { return make_bending_law(B, 2.0 * HB, kNoJamming); }

/// Arithmetic-geometric mean: complete elliptic integrals K(k) and E(k). @source Abramowitz & Stegun 17.6
std::array<double, 2> complete_elliptic(double k) {
  double a = 1.0, b = std::sqrt(1.0 - k * k), c = k, sum = 0.5 * c * c, power = 0.5;
  for (int i = 0; i < 40 && std::abs(c) > 1e-17; ++i) {
    const double next = 0.5 * (a + b);
    c = 0.5 * (a - b);
    b = std::sqrt(a * b);
    a = next;
    power *= 2.0;
    sum += power * c * c;
  }
  const double K = std::numbers::pi / (2.0 * a);
  return {K, K * (1.0 - sum)};
}

/// A clamped-clamped elastica is four clamped-free columns of a quarter length end to end (its inflections at
/// L/4 and 3L/4 carry no moment). With steepest angle alpha and k = sin(alpha/2):
///   P L^2 / B = 16 K^2,  d / L = 2 E / K - 1,  middle height / L = k / K.
struct Elastica {
  double force, distance, height;
};
Elastica clamped_elastica(double alpha) {
  const double k = std::sin(0.5 * alpha);
  const auto [K, E] = complete_elliptic(k);
  return {16.0 * K * K, 2.0 * E / K - 1.0, k / K};
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("the quarter-column closed form repeats the tabulated clamped-free column") {
    // End angle 60 degrees: P/Pcr 1.151720, x/L .741020, y/L .593208 (six digits, RK4 shooting).
    const Elastica e = clamped_elastica(60.0 * unit::kDegree);
    const double pi = std::numbers::pi;
    CHECK(e.force / (4.0 * pi * pi) == doctest::Approx(1.151720).epsilon(1e-6));
    CHECK(e.distance == doctest::Approx(0.741020).epsilon(1e-6));
    CHECK(2.0 * e.height == doctest::Approx(0.593208).epsilon(2e-6));
  }

  TEST_CASE("a weightless elastic strip is the clamped elastica, from shallow to nearly closed") {
    const double B = 3e-6, L = 0.02;
    const PlayLaw law = bending_law(B, 0.0);
    std::vector<double> distances;
    std::vector<Elastica> exact;
    for (double alpha : {20.0, 40.0, 60.0, 80.0, 100.0}) {
      exact.push_back(clamped_elastica(alpha * unit::kDegree));
      distances.push_back(exact.back().distance * L);
    }
    const BucklingPath path = simulate_buckling({L, 0.0, false, 40, 0.02}, law, distances);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      // Discretisation, order 2: measured 5e-4 at worst with 40 half segments.
      CHECK(path.force[i] == doctest::Approx(-exact[i].force * B / (L * L)).epsilon(1e-3));
      CHECK(path.deflection[i] == doctest::Approx(exact[i].height * L).epsilon(1e-3));
    }
    CHECK(path.worst_residual < 1e-8);
  }

  TEST_CASE("a heavy limp strip is a catenary") {
    // Span .8: sag .265438, H/(wL) .338202. B/(w L^3) = 1e-6: boundary layers of (B/H)^(1/2) = 0.17 % L.
    const double w = 0.1 * kStandardGravity, L = 0.1;
    const BucklingPath path = simulate_buckling(
        {L, 0.1, false, 400, 0.02}, bending_law(1e-6 * w * L * L * L, 0.0), std::vector<double>{0.8 * L});
    CHECK(path.force[0] == doctest::Approx(0.338202 * w * L).epsilon(1e-2));
    CHECK(path.deflection[0] == doctest::Approx(0.265438 * L).epsilon(5e-3));
  }
}

TEST_SUITE("convergence") {
  TEST_CASE("the force of the elastica converges with order 2") {
    const double B = 3e-6, L = 0.02;
    const Elastica exact = clamped_elastica(60.0 * unit::kDegree);
    const std::vector<double> distances{exact.distance * L};
    std::vector<double> errors;
    for (int n : {10, 20, 40, 80}) {
      const BucklingPath path = simulate_buckling({L, 0.0, false, n, 0.02}, bending_law(B, 0.0), distances);
      errors.push_back(std::abs(path.force[0] / (-exact.force * B / (L * L)) - 1.0));
      MESSAGE("half segments ", n, ": relative force error ", errors.back());
    }
    for (std::size_t i = 1; i < errors.size(); ++i) {
      const double order = std::log2(errors[i - 1] / errors[i]);
      CHECK(order > 1.9);
      CHECK(order < 2.1);
    }
  }
}

TEST_SUITE("crosscheck") {
  TEST_CASE("the force is the slope of the energy: an elastic strip gives its work back") {
    // Down and up again with weight: without friction the force depends on the distance alone.
    std::vector<double> distances;
    for (int i = 0; i <= 20; ++i) distances.push_back(0.02 * (0.95 - 0.02 * i));
    for (int i = 19; i >= 0; --i) distances.push_back(0.02 * (0.95 - 0.02 * i));
    for (bool upwards : {false, true}) {
      const BucklingPath path =
          simulate_buckling({0.02, 0.1, upwards, 20, 0.02}, bending_law(3e-6, 0.0), distances);
      for (std::size_t i = 0; i < 20; ++i) {
        CHECK(path.force[i] == doctest::Approx(path.force[40 - i]).epsilon(1e-7));
      }
    }
  }

  TEST_CASE("weight pulls the clamps together downwards and pushes them apart upwards") {
    // Small weight: dH = -+ w (dA/dd) with A the area under the strip; checked by difference of both senses.
    const double B = 3e-6, L = 0.02, d = 0.8 * L;
    const std::vector<double> distances{d};
    const double none = simulate_buckling({L, 0.0, false, 40, 0.02}, bending_law(B, 0.0), distances).force[0];
    const double down =
        simulate_buckling({L, 0.05, false, 40, 0.02}, bending_law(B, 0.0), distances).force[0];
    const double up = simulate_buckling({L, 0.05, true, 40, 0.02}, bending_law(B, 0.0), distances).force[0];
    CHECK(down > none);
    CHECK(up < none);
    // Second order in the small weight: the two differences agree to (weight / bending) = 5 %.
    CHECK(down - none == doctest::Approx(none - up).epsilon(0.05));
  }
}

TEST_SUITE("property") {
  TEST_CASE("friction makes a loop that loses energy, and the path does not depend on its steps") {
    const double L = 0.02;
    std::vector<double> distances;
    for (int cycle = 1; cycle <= 3; ++cycle) {
      for (int i = 0; i <= 4 * cycle; ++i) distances.push_back(L * (0.93 - 0.03 * i));
      for (int i = 4 * cycle - 1; i >= 0; --i) distances.push_back(L * (0.93 - 0.03 * i));
    }
    const PlayLaw law = bending_law(3e-6, 2e-4);
    const BucklingPath path = simulate_buckling({L, 0.1, true, 20, 0.02}, law, distances);
    double work = 0.0;  // done on the strip: tension times distance
    for (std::size_t i = 1; i < distances.size(); ++i) {
      work += 0.5 * (path.force[i] + path.force[i - 1]) * (distances[i] - distances[i - 1]);
    }
    CHECK(work > 0.0);
    const BucklingPath fine = simulate_buckling({L, 0.1, true, 20, 0.002}, law, distances);
    const double peak = std::abs(path.force[distances.size() / 2]);
    double worst = 0.0;
    for (std::size_t i = 0; i < distances.size(); ++i) {
      worst = std::max(worst, std::abs(fine.force[i] - path.force[i]));
    }
    MESSAGE("largest change of force with ten times as many steps, fraction: ", worst / peak);
    CHECK(worst < 1e-2 * peak);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("strips and distances that make no sense are refused") {
    const PlayLaw law = bending_law(3e-6, 0.0);
    CHECK_THROWS_AS(simulate_buckling({0.02, 0.0}, law, std::vector<double>{0.02}), Error);
    CHECK_THROWS_AS(simulate_buckling({0.02, 0.0}, law, std::vector<double>{-0.01}), Error);
    CHECK_THROWS_AS(simulate_buckling({0.0, 0.0}, law, std::vector<double>{0.01}), Error);
    CHECK(simulate_buckling({0.02, 0.0}, law, std::vector<double>{}).force.empty());
  }
}
