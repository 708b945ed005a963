// The inverse fit on strips it was not told the answer of, and on the two measured fabrics.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/fabric/buckling.h"
#include "fuai/fabric/fab_fabric.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/io/u3m.h"
#include "fuai/units/constants.h"

using namespace fuai;

namespace {

/// Simulated D1, U1, D2 of a strip with known bending, an offset and a drift in each test, and noise.
FabRecord made_record(double B, double HB, double tilt, double noise) {
  FabRecord record;
  record.areal_mass = 0.1;
  record.source = "made.json";
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (FabTest test : {FabTest::kD1, FabTest::kU1, FabTest::kD2}) {
    const double L = test == FabTest::kD2 ? 0.081 : 0.021;
    FabStripTest strip{0.05, L, 10.0, {}};
    std::vector<double> distances;
    for (double deepest : {0.8, 0.7, 0.58}) {
      std::vector<FabSample> out, back;
      for (int i = 0; i <= 12; ++i) out.push_back({L * (0.93 + (deepest - 0.93) * i / 12), 0.0});
      for (int i = 12; i >= 0; --i) back.push_back({L * (0.93 + (deepest - 0.93) * i / 12), 0.0});
      strip.branches.push_back(out);
      strip.branches.push_back(back);
    }
    for (const auto& branch : strip.branches) {
      for (const FabSample& s : branch) distances.push_back(s.clamp_distance);
    }
    BucklingStrip bent{L, record.areal_mass, test == FabTest::kU1};
    bent.half_segments = test == FabTest::kD2 ? 40 : 20;
    bent.clamp_angle = test == FabTest::kU1 ? tilt : -tilt;
    const BucklingPath path = simulate_buckling(bent, make_bending_law(B, 2.0 * HB, kNoJamming), distances);
    std::size_t i = 0;
    const double offset = 0.01 * (1.0 + static_cast<double>(test)),
                 last = static_cast<double>(distances.size() - 1);
    for (auto& branch : strip.branches) {
      for (FabSample& s : branch) {
        s.force = strip.width * path.force[i] + offset + 0.005 * static_cast<double>(i) / last +
                  noise * normal(random);
        ++i;
      }
    }
    record.strips[0][static_cast<std::size_t>(test)] = strip;
  }
  return record;
}

FabRecord measured_record(const char* name) {
  return read_u3m_physics(std::string(FUAI_SOURCE_DIR "/data/u3m/") + name + ".physics.json");
}

}  // namespace

TEST_SUITE("crosscheck") {
  TEST_CASE("the inverse fit returns the bending, friction, tilt, offset and drift of simulated strips") {
    const double B = 0.05 * unit::kGfCm2PerCm, HB = 0.01 * unit::kGfCmPerCm, tilt = 0.08;
    const BucklingFit fit = fit_buckling(made_record(B, HB, tilt, 0.0), Direction::kWarp);
    // The path stops within 1e-4 of the moments at kinks; five times that.
    CHECK(fit.B == doctest::Approx(B).epsilon(5e-3));
    CHECK(fit.hysteresis_2HB == doctest::Approx(2.0 * HB).epsilon(5e-3));
    CHECK(fit.clamp_tilt == doctest::Approx(tilt).epsilon(5e-3));
    CHECK(fit.rms_fraction < 1e-3);
    CHECK(fit.quality.find("good") == 0);
    REQUIRE(fit.tests.size() == 3);
    for (const BucklingTestFit& test : fit.tests) {
      CHECK(test.offset == doctest::Approx(0.01 * (1.0 + static_cast<double>(test.test))).epsilon(1e-2));
      CHECK(test.drift == doctest::Approx(0.005).epsilon(2e-2));
    }
    CHECK_FALSE(fit.tests[2].fitted);
  }

  TEST_CASE("with noise the truth lies within four standard errors, which follow the noise") {
    const double B = 0.05 * unit::kGfCm2PerCm, HB = 0.01 * unit::kGfCmPerCm, noise = 0.02 * unit::kGramForce;
    const BucklingFit fit = fit_buckling(made_record(B, HB, 0.0, noise), Direction::kWarp);
    CHECK(std::abs(fit.B - B) < 4.0 * fit.B_error);
    CHECK(std::abs(fit.hysteresis_2HB - 2.0 * HB) < 4.0 * fit.hysteresis_2HB_error);
    CHECK(fit.B_error < 0.1 * B);
    CHECK(fit.rms == doctest::Approx(noise).epsilon(0.2));  // 130 samples: 1 / sqrt(2 n) = 6 %, three times
  }

  TEST_CASE("one wild sample hardly moves the fit") {
    const double B = 0.05 * unit::kGfCm2PerCm, HB = 0.01 * unit::kGfCmPerCm;
    FabRecord record = made_record(B, HB, 0.0, 0.01 * unit::kGramForce);
    const BucklingFit before = fit_buckling(record, Direction::kWarp);
    record.strips[0][static_cast<std::size_t>(FabTest::kU1)].branches[3][5].force += 1.0 * unit::kGramForce;
    const BucklingFit after = fit_buckling(record, Direction::kWarp);
    CHECK(std::abs(after.B / before.B - 1.0) < 0.03);
  }

  TEST_CASE("the measured cupro: plausible, both senses explained, the hanging strip predicted") {
    FabFitReport report;
    const Fabric fabric = make_fabric_from_fab(measured_record("cupro-woven-su1098"), &report);
    REQUIRE(report.bending.size() == 3);
    for (const BucklingFit& fit : report.bending) {
      CHECK(fit.rms_fraction < 0.05);
      // Cloth of 75 to 125 g/m2: 5 % to 95 % quantiles of the bending rigidity, with a bias below the warp.
      CHECK(fit.B > 0.009 * unit::kGfCm2PerCm);
      CHECK(fit.B < 0.26 * unit::kGfCm2PerCm);
      for (const BucklingTestFit& test : fit.tests) {
        if (!test.fitted) CHECK(test.rms < 0.25 * test.span);  // not fitted: weight and bending alone
      }
    }
    // Vendor's summary of the same file: 103.45 gf/cm and 78 % resilience before the turning sample.
    const double gf = unit::kGfPerCm;
    CHECK(fabric.tensile[0].peak_load.value == doctest::Approx(108.02 * gf).epsilon(1e-3));
    CHECK(fabric.tensile[0].RT.value == doctest::Approx(0.78).epsilon(0.03));
    CHECK(fabric.tensile[1].RT.value == doctest::Approx(0.776).epsilon(0.04));
    CHECK(fabric.tensile[0].EMT.value == doctest::Approx(0.0411).epsilon(0.01));
    REQUIRE(fabric.shear.curve.has_value());
    CHECK(fabric.shear.G.value > 0.0);
    CHECK(fabric.shear.tension.value == 0.0);  // a bias strip shows the stress itself
    CHECK(fabric.areal_mass.value == doctest::Approx(0.1056));
    CHECK(fabric.thickness.value == doctest::Approx(1.04642e-4));
    CHECK_FALSE(fabric.compression.LC.has_value());
    CHECK(fabric.bending[0].B.provenance.kind == ProvenanceKind::kFitted);
    CHECK(fabric.bending[0].B.provenance.source.find("cupro-woven-su1098.physics.json") != std::string::npos);
    CHECK(report.clamp_checks.size() == 2);
    CHECK(report.warnings == fabric.warnings);
  }

  TEST_CASE("the measured knit: friction rules its bending, its shear is refused as poor") {
    FabFitReport report;
    const Fabric fabric = make_fabric_from_fab(measured_record("cotton-knit-shirley"), &report);
    REQUIRE(report.bending.size() == 3);
    for (const BucklingFit& fit : report.bending) {
      CHECK(fit.rms_fraction < 0.07);
      // Residual curvature HB / B of more than 0.2 1/cm: a knit stays as it is laid.
      CHECK(0.5 * fit.hysteresis_2HB / fit.B > 0.2 * unit::kPerCentimetre);
    }
    CHECK(fabric.bending[0].B.provenance.quality.find("low-force") != std::string::npos);
    CHECK(fabric.bending[2].B.provenance.quality.find("low-force") == std::string::npos);
    REQUIRE(report.shear.has_value());
    CHECK(report.shear->quality.find("poor") == 0);
    CHECK_FALSE(fabric.shear.curve.has_value());
    CHECK(fabric.tensile[0].LT.value == doctest::Approx(0.739).epsilon(0.05));
    CHECK(fabric.tensile[1].RT.value == doctest::Approx(0.777).epsilon(0.02));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("a record without mass is refused, one without tests becomes a fabric of warnings") {
    FabRecord record;
    record.source = "empty.json";
    CHECK_THROWS_AS(make_fabric_from_fab(record), Error);
    record.areal_mass = 0.1;
    const Fabric fabric = make_fabric_from_fab(record);
    CHECK_FALSE(fabric.bending[0].B.has_value());
    CHECK_FALSE(fabric.shear.G.has_value());
    CHECK(fabric.warnings.size() == 5);  // three bendings, two tensile
  }
}
