// KES parameters of curves whose parameters are known in closed form.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fuai/fabric/kes_parameters.h"
#include "fuai/units/constants.h"

using namespace fuai;

namespace {

constexpr double kB = 3e-6, kHB = 2e-4;  // [N m], [N]

/// One branch of stress = slope x +- half width, with n steps. The lines are offset, so the sides differ.
CurveBranch line(Branch kind, double from, double to, double slope, double shift, int n = 50) {
  CurveBranch branch{kind, {}};
  for (int i = 0; i <= n; ++i) {
    const double x = from + (to - from) * i / n;
    branch.samples.push_back({x, slope * x + shift});
  }
  return branch;
}

/// Rising branches carry +HB, falling ones -HB; the back is twice as stiff with three times the friction.
CurveBranch bend(Branch kind, double from, double to) {
  CurveBranch branch = line(kind, from, to, kB, 0.0);
  const double friction = to > from ? kHB : -kHB;
  for (CurveSample& s : branch.samples) {
    s.stress += (s.strain < 0.0 ? kB * s.strain : 0.0) + (s.strain < 0.0 ? 3.0 : 1.0) * friction;
  }
  return branch;
}

/// Tension F = a (exp(x eps / eps_m) - 1) up to F_m and back along the same with another exponent.
MeasuredCurve exponential_loop(double peak, double strain, double x_load, double x_unload, int n) {
  MeasuredCurve curve{Test::kTensile, Direction::kWarp, {{Branch::kLoad, {}}, {Branch::kUnload, {}}}, ""};
  const auto stress = [&](double e, double x) { return peak * std::expm1(x * e / strain) / std::expm1(x); };
  for (int i = 0; i <= n; ++i) {
    const double up = strain * i / n, down = strain * (n - i) / n;
    curve.branches[0].samples.push_back({up, stress(up, x_load)});
    curve.branches[1].samples.push_back({down, stress(down, x_unload)});
  }
  return curve;
}

double linearity(double x) { return 2.0 * (1.0 / x - 1.0 / std::expm1(x)); }

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("bending: slope and width of two parallel lines, each face and their mean") {
    MeasuredCurve curve{Test::kBending, Direction::kWarp, {}, ""};
    curve.branches = {bend(Branch::kLoad, 0.0, 250.0), bend(Branch::kUnload, 250.0, -250.0),
                      bend(Branch::kLoad, -250.0, 0.0)};
    const BendingParameters p = compute_bending_parameters(curve);
    CHECK(p.missing.empty());
    CHECK(p.B.face == doctest::Approx(kB).epsilon(1e-12));
    CHECK(p.B.back == doctest::Approx(2.0 * kB).epsilon(1e-12));
    CHECK(p.B.mean() == doctest::Approx(1.5 * kB).epsilon(1e-12));
    CHECK(p.hysteresis_2HB.face == doctest::Approx(2.0 * kHB).epsilon(1e-12));
    CHECK(p.hysteresis_2HB.back == doctest::Approx(6.0 * kHB).epsilon(1e-12));
    CHECK(p.hysteresis_2HB.mean() == doctest::Approx(4.0 * kHB).epsilon(1e-12));
  }

  TEST_CASE("bending: the reading curvature is a parameter") {
    // A loop that opens with curvature: width 2 HB (1 + K / 100).
    MeasuredCurve curve{Test::kBending, Direction::kWarp, {}, ""};
    curve.branches = {line(Branch::kLoad, 0.0, 250.0, kB + kHB / 100.0, kHB),
                      line(Branch::kUnload, 250.0, 0.0, kB - kHB / 100.0, -kHB)};
    KesReading half;
    half.bending_width_curvature = 50.0;
    CHECK(compute_bending_parameters(curve).hysteresis_2HB.face == doctest::Approx(4.0 * kHB).epsilon(1e-12));
    CHECK(compute_bending_parameters(curve, half).hysteresis_2HB.face ==
          doctest::Approx(3.0 * kHB).epsilon(1e-12));
  }

  TEST_CASE("shear: slope over 0.5 to 2.5 degrees, widths at 0.5 and 5 degrees, both sides") {
    const double G = 20.0, HG = 0.6, d = unit::kDegree;
    const double widening = 0.1;  // [N/m per degree] of the half width
    MeasuredCurve curve{Test::kShear, Direction::kWarp, {}, ""};
    const auto branch = [&](Branch kind, double from, double to) {
      CurveBranch b = line(kind, from * d, to * d, G, 0.0, 160);
      for (CurveSample& s : b.samples) {
        s.stress += (to > from ? 1.0 : -1.0) * (HG + widening * std::abs(s.strain) / d);
      }
      return b;
    };
    curve.branches = {branch(Branch::kLoad, 0, 8), branch(Branch::kUnload, 8, -8),
                      branch(Branch::kLoad, -8, 0)};
    const ShearParameters p = compute_shear_parameters(curve);
    CHECK(p.missing.empty());
    CHECK(p.G.face == doctest::Approx(G + widening / d).epsilon(1e-12));
    CHECK(p.G.back == doctest::Approx(G + widening / d).epsilon(1e-12));
    CHECK(p.hysteresis_2HG.mean() == doctest::Approx(2.0 * (HG + 0.5 * widening)).epsilon(1e-12));
    CHECK(p.hysteresis_2HG5.mean() == doctest::Approx(2.0 * (HG + 5.0 * widening)).epsilon(1e-12));
  }

  TEST_CASE("tensile: linearity and resilience of an exponential loop") {
    const double peak = 490.33, strain = 0.05, x = 2.672, y = 4.0;
    const TensileParameters p = compute_tensile_parameters(exponential_loop(peak, strain, x, y, 2000));
    CHECK(p.peak_load == doctest::Approx(peak).epsilon(1e-12));
    CHECK(p.EMT == doctest::Approx(strain).epsilon(1e-12));
    // Trapezoid: relative error x^2 / (12 n^2) is below 4e-7.
    CHECK(p.LT == doctest::Approx(linearity(x)).epsilon(1e-6));
    CHECK(p.WT == doctest::Approx(0.5 * linearity(x) * peak * strain).epsilon(1e-6));
    CHECK(p.RT == doctest::Approx(linearity(y) / linearity(x)).epsilon(1e-6));
    CHECK(p.LT == doctest::Approx(0.6).epsilon(1e-4));  // the table of LT against x, four digits
  }

  TEST_CASE("tensile: recovery stops at zero force, loading starts at zero strain") {
    // Straight up from a slack start below zero, straight down to zero force at 1 % residual strain.
    MeasuredCurve curve{Test::kTensile, Direction::kWarp, {}, ""};
    curve.branches = {{Branch::kLoad, {{-0.01, 0.0}, {0.0, 0.0}, {0.04, 100.0}}},
                      {Branch::kUnload, {{0.04, 100.0}, {0.02, 100.0 / 3.0}, {0.0, -100.0 / 3.0}}}};
    const TensileParameters p = compute_tensile_parameters(curve);
    CHECK(p.WT == doctest::Approx(2.0).epsilon(1e-12));
    CHECK(p.LT == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(p.RT == doctest::Approx(1.5 / 2.0).epsilon(1e-12));
  }

  TEST_CASE("compression: the same works, and the thickness at the peak") {
    MeasuredCurve curve = exponential_loop(4903.0, 2e-4, 3.594, 5.0, 2000);
    curve.test = Test::kCompression;
    const CompressionParameters p = compute_compression_parameters(curve, 5e-4);
    CHECK(p.LC == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(p.RC == doctest::Approx(linearity(5.0) / linearity(3.594)).epsilon(1e-5));
    CHECK(p.T0 == 5e-4);
    CHECK(p.Tm == doctest::Approx(3e-4).epsilon(1e-12));
    CHECK(p.peak_pressure == doctest::Approx(4903.0));
    const CompressionParameters unknown =
        compute_compression_parameters(curve, std::numeric_limits<double>::quiet_NaN());
    CHECK(std::isnan(unknown.Tm));
    CHECK(unknown.missing.size() == 1);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("the first loading drops out as soon as a later loop exists; a cycle can be asked for") {
    MeasuredCurve curve{Test::kBending, Direction::kWarp, {}, ""};
    curve.branches = {line(Branch::kLoad, 0.0, 250.0, 5.0 * kB, 0.0), bend(Branch::kUnload, 250.0, -250.0),
                      bend(Branch::kLoad, -250.0, 250.0), bend(Branch::kUnload, 250.0, 0.0)};
    CHECK(compute_bending_parameters(curve).B.face == doctest::Approx(kB).epsilon(1e-12));
    KesReading first;
    first.cycle = 0;
    CHECK(compute_bending_parameters(curve, first).B.face == doctest::Approx(5.0 * kB).epsilon(1e-12));
    first.cycle = 7;
    CHECK(std::isnan(compute_bending_parameters(curve, first).B.face));
  }

  TEST_CASE("a loop that starts at its far end, and labels that say the opposite, read the same") {
    MeasuredCurve curve{Test::kBending, Direction::kWarp, {}, ""};
    curve.branches = {bend(Branch::kLoad, 250.0, -250.0), bend(Branch::kUnload, -250.0, 250.0)};
    const BendingParameters p = compute_bending_parameters(curve);
    CHECK(p.missing.empty());
    CHECK(p.B.face == doctest::Approx(kB).epsilon(1e-12));
    CHECK(p.B.back == doctest::Approx(2.0 * kB).epsilon(1e-12));
    CHECK(p.hysteresis_2HB.mean() == doctest::Approx(4.0 * kHB).epsilon(1e-12));
  }

  TEST_CASE("one face only: the mean is that face and a sentence says so") {
    MeasuredCurve curve{Test::kBending, Direction::kWarp, {}, ""};
    curve.branches = {bend(Branch::kLoad, 0.0, 250.0), bend(Branch::kUnload, 250.0, 0.0)};
    const BendingParameters p = compute_bending_parameters(curve);
    CHECK(p.B.mean() == doctest::Approx(kB).epsilon(1e-12));
    CHECK(std::isnan(p.B.back));
    REQUIRE(p.missing.size() == 1);
    CHECK(p.missing[0].find("back") == 0);
  }

  TEST_CASE("a curve that stops short names what is missing") {
    MeasuredCurve curve{Test::kBending, Direction::kWarp, {}, ""};
    curve.branches = {bend(Branch::kLoad, 0.0, 120.0), bend(Branch::kUnload, 120.0, 0.0)};
    const BendingParameters p = compute_bending_parameters(curve);
    CHECK(std::isnan(p.B.face));
    CHECK(p.hysteresis_2HB.face == doctest::Approx(2.0 * kHB).epsilon(1e-12));
    CHECK(std::any_of(p.missing.begin(), p.missing.end(), [](const std::string& m) {
      return m.find("face: B needs") == 0 && m.find("1.5 1/cm") != std::string::npos;
    }));
    const MeasuredCurve empty{Test::kTensile, Direction::kWarp, {}, ""};
    CHECK(compute_tensile_parameters(empty).missing.size() == 1);
    CHECK(std::isnan(compute_shear_parameters(empty).G.mean()));
  }
}
