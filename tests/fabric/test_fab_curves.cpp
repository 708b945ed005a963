// Stretch and bias strips of the Fabric Analyzer: zero, cuts, the bias model, and the play law beside loops.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/fabric/cycle_comparison.h"
#include "fuai/fabric/fab_shear.h"
#include "fuai/fabric/fab_stretch.h"
#include "fuai/fabric/kes_parameters.h"
#include "fuai/units/constants.h"

using namespace fuai;

namespace {

constexpr double kYarn = 2000.0;  // T = kYarn eps, warp and weft together [N/m]
constexpr double kG = 30.0;       // tau = kG phi [N/m]

/// Strip of a linear cloth, 5 cm wide: force 0.01 N while slack, then stiffness [N/m per strain].
FabStripTest linear_strip(double length, double stiffness, double extra, const std::vector<double>& peaks) {
  FabStripTest strip{0.05, length, 55.0, {}};
  const auto sample = [&](double strain) {
    const double d = length * (1.0 + strain);
    return FabSample{d + (strain > 0.0 ? extra * strain / peaks.back() : 0.0),
                     0.01 + 0.05 * stiffness * std::max(strain, 0.0)};
  };
  for (double peak : peaks) {
    std::vector<FabSample> load, unload;
    for (int i = 0; i <= 60; ++i) load.push_back(sample(-0.02 + (peak + 0.02) * i / 61.0));
    for (int i = 0; i <= 60; ++i) unload.push_back(sample(peak - (peak + 0.02) * i / 60.0));
    strip.branches.push_back(load);
    strip.branches.push_back(unload);
  }
  return strip;
}

FabRecord linear_record() {
  FabRecord record;
  record.source = "made.json";
  auto& warp = record.strips[0];
  warp[static_cast<std::size_t>(FabTest::kS2)] = linear_strip(0.08, 1000.0, 0.0, {0.02, 0.05});
  return record;
}

/// Axial stretch and load of the bias strip at shear angle phi, from the balance of both derivatives of W.
struct BiasState {
  double l1, l2, load;
};
BiasState bias_state(double phi) {
  // T = 2 tau l1 / (l2 (1 + eps)) with l1 / l2 = sqrt((1 + sin) / (1 - sin)): a contraction in eps.
  const double s = std::sin(phi), ratio = std::sqrt((1.0 + s) / (1.0 - s));
  double eps = 0.0;
  for (int k = 0; k < 200; ++k) eps = 2.0 * kG * phi * ratio / (kYarn * (1.0 + eps));
  const double l1 = (1.0 + eps) * std::sqrt(1.0 + s), l2 = (1.0 + eps) * std::sqrt(1.0 - s);
  return {l1, l2, 2.0 * kG * phi / l2};
}

/// W(l1, l2) per reference area.
double bias_energy(double l1, double l2) {
  const double eps = std::sqrt(0.5 * (l1 * l1 + l2 * l2)) - 1.0;
  const double phi = std::asin((l1 * l1 - l2 * l2) / (l1 * l1 + l2 * l2));
  return 0.5 * kYarn * eps * eps + 0.5 * kG * phi * phi;
}

FabStretch stretch_of(const std::vector<CurveSample>& load) {
  FabStretch stretch;
  std::vector<CurveSample> back(load.rbegin(), load.rend());
  stretch.curve.test = Test::kTensile;
  stretch.curve.branches = {{Branch::kLoad, load}, {Branch::kUnload, back}};
  return stretch;
}

}  // namespace

TEST_SUITE("derivative") {
  TEST_CASE("the bias balance is the gradient of the strip's energy: dW/dl1 = P, dW/dl2 = 0") {
    for (double phi : {0.05, 0.2, 0.4, 0.6}) {
      const BiasState b = bias_state(phi);
      const double h = 1e-6;
      const double axial = (bias_energy(b.l1 + h, b.l2) - bias_energy(b.l1 - h, b.l2)) / (2.0 * h);
      const double lateral = (bias_energy(b.l1, b.l2 + h) - bias_energy(b.l1, b.l2 - h)) / (2.0 * h);
      // Central difference: rounding 1e-16 W / h and h^2 W''' / 6, both below 1e-8 of W'.
      CHECK(axial == doctest::Approx(b.load).epsilon(1e-6));
      CHECK(std::abs(lateral) < 1e-6 * b.load);
    }
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("a bias sample is solved for the angle and the stress it was made from") {
    const std::vector<CurveSample> yarn{{0.0, 0.0}, {0.5, 0.5 * kYarn}};
    for (double phi : {0.01, 0.05, 0.2, 0.4, 0.6}) {
      const BiasState b = bias_state(phi);
      const BiasPoint p = solve_bias_point(b.l1, b.load, yarn);
      CHECK(p.angle == doctest::Approx(phi).epsilon(1e-10));
      CHECK(p.stress == doctest::Approx(kG * phi).epsilon(1e-10));
      CHECK(p.lateral_stretch == doctest::Approx(b.l2).epsilon(1e-10));
    }
  }

  TEST_CASE("a bias strip of a linear cloth gives its shear rigidity back") {
    std::vector<CurveSample> bias;
    for (int i = 0; i <= 200; ++i) {
      const BiasState b = bias_state(0.3 * i / 200.0);
      bias.push_back({b.l1 - 1.0, b.load});
    }
    const FabStretch yarn = stretch_of({{0.0, 0.0}, {0.1, 0.05 * kYarn}});  // half of T each
    const FabShear shear = make_fab_shear(stretch_of(bias), yarn, yarn);
    CHECK(shear.largest_angle == doctest::Approx(0.3).epsilon(1e-9));
    CHECK(shear.largest_lateral_stretch <= 1.0);
    CHECK(shear.quality.find("fair") == 0);
    const ShearParameters p = compute_shear_parameters(shear.curve);
    CHECK(p.G.face == doctest::Approx(kG).epsilon(1e-9));
    CHECK(std::abs(p.hysteresis_2HG5.face) < 1e-9 * kG);
  }

  TEST_CASE("a strip that widens is called poor") {
    // Hardly any load on the yarns of a wide strip: l2 = sqrt(2 (1 + eps)^2 - l1^2) with eps from P alone.
    const FabStretch soft = stretch_of({{0.0, 0.0}, {1.0, 10.0}});
    const FabShear shear = make_fab_shear(stretch_of({{0.0, 0.0}, {0.1, 8.0}, {0.2, 16.0}}), soft, soft);
    CHECK(shear.largest_lateral_stretch > 1.02);
    CHECK(shear.quality.find("poor") == 0);
  }

  TEST_CASE("stretch: zeroes, scale, nested cycles, the turning sample") {
    const FabStretch s = make_fab_stretch(linear_record(), Direction::kWarp);
    CHECK(s.force_zero == doctest::Approx(0.01).epsilon(1e-12));
    CHECK(s.force_noise < 1e-12);
    CHECK(s.peak_strain == doctest::Approx(0.05).epsilon(1e-12));
    CHECK(s.peak_load == doctest::Approx(50.0).epsilon(1e-12));
    REQUIRE(s.curve.branches.size() == 4);
    for (const CurveBranch& branch : s.curve.branches) {
      for (const CurveSample& sample : branch.samples) {
        CHECK(sample.strain >= 0.0);
        // The cut at zero interpolates across the kink: at most one step of 1000 x 0.0012.
        CHECK(std::abs(sample.stress - 1000.0 * sample.strain) < 1.2);
      }
    }
    CHECK(s.curve.branches[2].samples.back().strain == doctest::Approx(0.05).epsilon(1e-12));
    // 0.5 gf/cm at 1000 N/m is 0.049 %; found on the next sample, steps of 0.066 %.
    CHECK(s.take_up_strain > 0.0);
    CHECK(s.take_up_strain < 0.0012);
  }

  TEST_CASE("clamps that lengthen both strips alike are found") {
    FabRecord record = linear_record();
    const double extra = 4e-4;  // at the peak, proportional to load
    record.strips[0][static_cast<std::size_t>(FabTest::kS2)] = linear_strip(0.08, 1000.0, extra, {0.05});
    record.strips[0][static_cast<std::size_t>(FabTest::kS1)] = linear_strip(0.02, 1000.0, extra, {0.05});
    const FabClampCheck check = check_fab_clamps(record, Direction::kWarp);
    CHECK(check.load == doctest::Approx(40.0).epsilon(1e-9));
    CHECK(check.clamp_length == doctest::Approx(0.8 * extra).epsilon(1e-6));
    CHECK(check.strain_in_cloth == doctest::Approx(0.04).epsilon(1e-6));
  }
}

TEST_SUITE("crosscheck") {
  TEST_CASE("a law beside its own nested loops misfits by nothing; beside stiffer ones by their difference") {
    const PlayElement plays[] = {{0.05, 0.5}, {0.2, 0.5}};
    const PlayLaw law =
        make_play_law(make_curve_table(-3, 3, std::vector<double>{-3, 0, 3}),
                      make_curve_table(-3, 3, std::vector<double>{0.2, 0.2, 0.2}, constant_outside()), plays);
    MeasuredCurve curve{Test::kBending, Direction::kWarp, {}, ""};
    PlayState state;
    for (double peak : {0.5, 1.0, 2.0}) {
      CurveBranch up{Branch::kLoad, {}}, down{Branch::kUnload, {}};
      for (int i = 0; i <= 400; ++i)
        up.samples.push_back({peak * i / 400, law.advance(peak * i / 400, state).stress});
      for (int i = 400; i >= 0; --i) {
        down.samples.push_back({peak * i / 400, law.advance(peak * i / 400, state).stress});
      }
      curve.branches.push_back(up);
      curve.branches.push_back(down);
    }
    const CycleComparison same = compare_cycles(law, curve);
    REQUIRE(same.cycles.size() == 3);
    for (const CycleMisfit& m : same.cycles) {
      CHECK(m.max_fraction < 1e-15);
      CHECK(m.measured_loop_area == doctest::Approx(m.predicted_loop_area));
      CHECK(m.measured_loop_area > 0.0);
    }
    // Closed loop of steady friction Y between 0 and x: 2 Y (x - 2 sum w r); trapezoid and table rounding.
    CHECK(same.cycles[2].measured_loop_area == doctest::Approx(2 * 0.2 * (2.0 - 0.25)).epsilon(2e-3));
    CHECK(same.cycles[2].peak_strain == 2.0);

    MeasuredCurve doubled = curve;
    for (CurveBranch& branch : doubled.branches) {
      for (CurveSample& s : branch.samples) s.stress *= 2.0;
    }
    const CycleComparison half = compare_cycles(law, doubled);
    CHECK(half.cycles[2].max_fraction == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(half.cycles[2].measured_loop_area ==
          doctest::Approx(2.0 * half.cycles[2].predicted_loop_area).epsilon(1e-12));
    CHECK(half.predicted.branches[0].samples[7].stress ==
          doctest::Approx(curve.branches[0].samples[7].stress));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("a missing stretch test is refused with its name") {
    CHECK_THROWS_AS(make_fab_stretch(linear_record(), Direction::kWeft), Error);
    CHECK_THROWS_AS(check_fab_clamps(linear_record(), Direction::kWarp), Error);
  }
}
