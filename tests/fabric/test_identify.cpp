// Laws identified from loops and from scalars give both back.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/fabric/branch_nodes.h"
#include "fuai/fabric/curve_law.h"
#include "fuai/fabric/identify.h"
#include "fuai/fabric/laws.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/units/constants.h"

using namespace fuai;

namespace {

/// An asymmetric loop, wider at the face than at the back, tips closed: a plausible KES bending shape in
/// 1/cm, gf cm/cm.
LoopNodes synthetic_loop(std::size_t count) {
  LoopNodes nodes{-2.5, 2.5, {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const double x = -2.5 + 5.0 * static_cast<double>(i) / static_cast<double>(count - 1);
    const double middle = 0.1 * x + 0.004 * x * x * x + 0.006 * x * x;
    const double width =
        (0.03 + 0.004 * x + 0.004 * x * x) * std::tanh((2.5 - x) / 0.35) * std::tanh((2.5 + x) / 0.35);
    nodes.up.push_back(middle + width);
    nodes.down.push_back(middle - width);
  }
  return nodes;
}

/// Drives a law once round and returns its stresses at the nodes.
LoopNodes drive(const PlayLaw& law, const LoopNodes& like) {
  LoopNodes result{like.low, like.high, {}, {}};
  const std::size_t n = like.up.size();
  const auto at = [&](std::size_t i) {
    return like.low + (like.high - like.low) * static_cast<double>(i) / static_cast<double>(n - 1);
  };
  PlayState state;
  for (int turn = 0; turn < 2; ++turn) {  // the second turn is the steady one
    result.up.clear();
    for (std::size_t i = 0; i < n; ++i) result.up.push_back(law.advance(at(i), state).stress);
    result.down.assign(n, 0.0);
    for (std::size_t i = n; i-- > 0;) result.down[i] = law.advance(at(i), state).stress;
  }
  return result;
}

double worst(const std::vector<double>& a, const std::vector<double>& b) {
  double w = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) w = std::max(w, std::abs(a[i] - b[i]));
  return w;
}

/// Slope of the steady loading branch by least squares and loop width, read as KES does.
struct ReadOff {
  double slope, width_near, width_far;
};
ReadOff read_off(const PlayLaw& law, double range, double from, double to, double near, double far) {
  PlayState state;
  for (double x : {range, -range}) law.commit(x, state);
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const int n = 101;
  for (int i = 0; i < n; ++i) {
    const double x = from + (to - from) * i / (n - 1);
    PlayState branch = state;
    const double y = law.advance(x, branch).stress;
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  PlayState back = state;
  law.commit(range, back);
  const auto width = [&](double x) { return law.evaluate(x, state).stress - law.evaluate(x, back).stress; };
  return {(n * sxy - sx * sy) / (n * sxx - sx * sx), width(near), width(far)};
}

}  // namespace

TEST_SUITE("property") {
  TEST_CASE("both branches of a loop come back exactly at the nodes, whatever the elements are") {
    const LoopNodes loop = synthetic_loop(251);
    for (double radius : {0.2, 0.8, 2.5}) {
      const PlayLaw law = identify_loop(loop, scaled_elements(radius), bending_outside(2.5, 40.0));
      const LoopNodes again = drive(law, loop);
      CHECK(worst(again.up, loop.up) < 1e-12);
      CHECK(worst(again.down, loop.down) < 1e-12);
    }
    const PlayLaw smooth = identify_loop(loop, smoothest_elements(loop), bending_outside(2.5, 40.0));
    CHECK(worst(drive(smooth, loop).up, loop.up) < 1e-12);
  }

  TEST_CASE("the smoothest elements find the rounding of a loop that a play law made") {
    const PlayLaw truth = make_play_law(make_curve_table(-2.5, 2.5, std::vector<double>{-0.25, 0.0, 0.25}),
                                        make_curve_table(-2.5, 2.5, std::vector<double>{0.03, 0.03, 0.03}),
                                        scaled_elements(0.6));
    const LoopNodes loop = drive(truth, synthetic_loop(251));
    CHECK(smoothest_elements(loop).back().radius == doctest::Approx(0.6).epsilon(0.1));  // grid steps of 10 %
  }

  TEST_CASE("virgin loading and recovery come back exactly at the nodes") {
    VirginNodes nodes{0.05, {}, {}};
    for (int i = 0; i <= 200; ++i) {
      const double z = i / 200.0;
      nodes.load.push_back(500.0 * std::pow(z, 1.8));
      nodes.recovery.push_back(500.0 * std::pow(z, 3.4));
    }
    for (bool mirrored : {false, true}) {
      const PlayLaw law = identify_virgin(nodes, scaled_elements(0.02), mirrored, tensile_outside(1e4, 2e4));
      PlayState state;
      double error = 0.0;
      for (std::size_t i = 0; i <= 200; ++i) {
        error = std::max(
            error, std::abs(law.advance(0.05 * static_cast<double>(i) / 200, state).stress - nodes.load[i]));
      }
      for (std::size_t i = 201; i-- > 0;) {
        error = std::max(error, std::abs(law.advance(0.05 * static_cast<double>(i) / 200, state).stress -
                                         nodes.recovery[i]));
      }
      CHECK(error < 500.0 * 1e-12);
      if (mirrored) CHECK(law.evaluate(-0.03, {}).stress == doctest::Approx(-law.evaluate(0.03, {}).stress));
    }
  }

  TEST_CASE("noise, drift and crossing: cleaned loops are monotone, closed and uncrossed") {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 0.004);
    const LoopNodes clean = synthetic_loop(251);
    MeasuredCurve curve;
    for (int cycle = 0; cycle < 3; ++cycle) {
      CurveBranch up{Branch::kLoad, {}}, down{Branch::kUnload, {}};
      for (std::size_t i = 0; i < 251; ++i) {
        const double x = -2.5 + 0.02 * static_cast<double>(i);
        up.samples.push_back({x, clean.up[i] + noise(random)});
        down.samples.push_back({-x, clean.down[250 - i] + noise(random) + 0.01});
      }
      curve.branches.push_back(up);
      curve.branches.push_back(down);
    }
    std::vector<std::string> notes;
    const LoopNodes nodes = loop_nodes(curve, 251, notes);
    CHECK(std::ranges::is_sorted(nodes.up));
    CHECK(std::ranges::is_sorted(nodes.down));
    CHECK(nodes.up.front() == doctest::Approx(nodes.down.front()));
    CHECK(nodes.up.back() == doctest::Approx(nodes.down.back()));
    for (std::size_t i = 0; i < 251; ++i) CHECK(nodes.up[i] >= nodes.down[i]);
    CHECK(!notes.empty());
    CHECK(make_curve_law(curve, 40.0).rms_residual < 0.03);  // noise 0.004 + drift 0.01 of a peak of 0.35
  }

  TEST_CASE("exchanged branches are refused with a cure") {
    MeasuredCurve curve;
    const LoopNodes loop = synthetic_loop(51);
    curve.branches.resize(2);
    for (std::size_t i = 0; i < 51; ++i) {
      const double x = -2.5 + 0.1 * static_cast<double>(i);
      curve.branches[0].samples.push_back({x, loop.down[i]});
      curve.branches[1].samples.push_back({-x, loop.up[50 - i]});
    }
    try {
      make_curve_law(curve, 40.0);
      FAIL("accepted");
    } catch (const Error& e) {
      CHECK(std::string(e.what()).find("exchanged") != std::string::npos);
    }
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("B and 2HB come back from the law of the scalars") {
    const double B = 0.1 * unit::kGfCm2PerCm, HB2 = 0.06 * unit::kGfCmPerCm, cm = unit::kPerCentimetre;
    const ReadOff r =
        read_off(make_bending_law(B, HB2, 1.0 / 3e-4), 2.5 * cm, 0.5 * cm, 1.5 * cm, 1.0 * cm, 1.0 * cm);
    CHECK(r.slope == doctest::Approx(B).epsilon(1e-12));
    CHECK(r.width_near == doctest::Approx(HB2).epsilon(1e-12));
  }

  TEST_CASE("G, 2HG and 2HG5 come back from the law of the scalars") {
    const double G = 0.8 * unit::kGfPerCmDeg, near = 1.2 * unit::kGfPerCm, far = 2.5 * unit::kGfPerCm,
                 deg = unit::kDegree;
    const ReadOff r =
        read_off(make_shear_law(G, near, far), 8 * deg, 0.5 * deg, 2.5 * deg, 0.5 * deg, 5 * deg);
    // The corner of the friction table at 0.5 degrees is rounded by the monotone cubic over one node (0.05
    // degrees).
    CHECK(r.slope == doctest::Approx(G).epsilon(1e-3));
    CHECK(r.width_near == doctest::Approx(near).epsilon(1e-9));
    CHECK(r.width_far == doctest::Approx(far).epsilon(1e-9));
  }

  TEST_CASE("LT, WT, RT and EMT come back from the law of the scalars") {
    for (double LT : {0.5, 0.62, 0.8, 1.0, 1.1}) {
      const double RT = 0.68, EMT = 0.052, Fm = 500 * unit::kGfPerCm;
      const PlayLaw law = make_tensile_law(LT, RT, EMT, Fm);
      PlayState state;
      double load = 0, back = 0, last = 0;
      const int n = 20000;
      for (int i = 1; i <= n; ++i) {
        const double f = law.advance(EMT * i / n, state).stress;
        load += 0.5 * (f + last) * EMT / n;
        last = f;
      }
      CHECK(last == doctest::Approx(Fm).epsilon(1e-12));
      for (int i = n - 1; i >= 0; --i) {
        const double f = law.advance(EMT * i / n, state).stress;
        back += 0.5 * (f + last) * EMT / n;
        last = f;
      }
      CAPTURE(LT);
      CHECK(load / (0.5 * Fm * EMT) == doctest::Approx(LT).epsilon(1e-3));  // cubic between 201 nodes
      CHECK(back / load == doctest::Approx(RT).epsilon(2e-3));
    }
  }

  TEST_CASE("exponential rates of the reference") {
    CHECK(exponential_rate(0.5) == doctest::Approx(3.594).epsilon(1e-3));
    CHECK(exponential_rate(0.8) == doctest::Approx(1.230).epsilon(1e-3));
    CHECK(exponential_rate(0.95) == doctest::Approx(0.3005).epsilon(1e-3));
    CHECK(exponential_rate(1.1) == doctest::Approx(-0.604).epsilon(1e-3));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("isotonic regression") {
    CHECK(isotonic(std::vector<double>{1, 3, 2, 2, 5}) ==
          std::vector<double>{1, 7.0 / 3, 7.0 / 3, 7.0 / 3, 5});
    CHECK(isotonic(std::vector<double>{3, 2, 1}) == std::vector<double>{2, 2, 2});
  }

  TEST_CASE("impossible scalars are refused") {
    CHECK_THROWS_AS(make_bending_law(-1, 0, 1e3), Error);
    CHECK_THROWS_AS(make_bending_law(1e-5, -1, 1e3), Error);
    CHECK_THROWS_AS(make_shear_law(0, 0, 0), Error);
    CHECK_THROWS_AS(make_shear_law(1, 0, 10), Error);
    CHECK_THROWS_AS(make_tensile_law(2.0, 0.5, 0.05, 490), Error);
    CHECK_THROWS_AS(make_tensile_law(0.7, 1.5, 0.05, 490), Error);
    CHECK_THROWS_AS(make_tensile_law(0.7, 0.5, 0.0, 490), Error);
  }

  TEST_CASE("a fabric with next to nothing gets laws, and every assumption is reported") {
    Fabric fabric;
    fabric.name = "minimal";
    fabric.composition = "100 % cotton";
    fabric.areal_mass.value = 0.12;
    CHECK_THROWS_AS(make_fabric_laws(fabric), Error);  // no bending at all
    fabric.bending[0].B.value = 0.06 * unit::kGfCm2PerCm;
    const FabricLaws laws = make_fabric_laws(fabric);
    CHECK(laws.thickness == doctest::Approx(0.12 / 430.0));
    CHECK(laws.bending[1].friction().evaluate(0.0).value == doctest::Approx(0.5 * 0.06 * unit::kGfCmPerCm));
    // Equal warp and weft: B45 = (2 B + 4 * 0.25 B) / 4.
    CHECK(laws.bending[2].elastic().evaluate(10.0).slope == doctest::Approx(0.75 * 0.06 * unit::kGfCm2PerCm));
    REQUIRE(laws.reports.size() == 7);
    for (const LawReport& report : laws.reports) {
      CAPTURE(report.law);
      CHECK(!report.assumptions.empty());
    }
  }
}
