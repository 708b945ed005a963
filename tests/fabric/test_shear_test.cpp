// The share of the tension in a shear test, and laws without it.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/shear_test.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/fabric/kes_parameters.h"
#include "fuai/fabric/laws.h"
#include "fuai/fabric/scalar_laws.h"

using namespace fuai;

namespace {

constexpr double kG = unit::kGfPerCmDeg, kF = unit::kGfPerCm, kDeg = unit::kDegree;

/// What the instrument records of a law: 0, 8, -8, 0 degrees in steps of a twentieth.
MeasuredCurve recorded(const PlayLaw& law, const ShearTest& test) {
  MeasuredCurve curve;
  curve.test = Test::kShear;
  PlayState state;
  int at = 0;
  for (int turn : {160, 0, -160, 0}) {
    CurveBranch branch{turn == 0 ? Branch::kUnload : Branch::kLoad, {}};
    for (int sense = turn > at ? 1 : -1;; at += sense) {
      const double angle = 0.05 * kDeg * at;
      branch.samples.push_back({angle, shear_force(test, law.advance(angle, state).stress, angle)});
      if (at == turn) break;
    }
    curve.branches.push_back(std::move(branch));
  }
  return curve;
}

Fabric fabric_with_G(double G_gf_per_cm_deg) {
  Fabric fabric;
  fabric.name = "Cloth";
  fabric.areal_mass.value = 0.15;
  fabric.bending[0].B.value = 1e-5;
  fabric.bending[0].hysteresis_2HB.value = 3e-4;
  fabric.shear.G.value = G_gf_per_cm_deg * kG;
  return fabric;
}

/// Slope of the elastic curve at zero [gf/(cm deg)].
double slope_of(const FabricLaws& laws) { return laws.shear.elastic().evaluate(0.0).slope / kG; }

bool notes_have(const FabricLaws& laws, const std::string& words) {
  for (const LawReport& report : laws.reports) {
    for (const std::string& sentence : report.assumptions) {
      if (sentence.find(words) != std::string::npos) return true;
    }
  }
  return false;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("10 gf/cm add 0.1745 gf/(cm deg) to G") {
    const ShearTest test{kKesShearTension, 1.0};
    const double angle = 1e-4;
    // tan(phi) = phi (1 + phi^2 / 3): 3e-9 at this angle.
    CHECK(shear_force(test, 0.0, angle) / angle / kG == doctest::Approx(10.0 * kDeg).epsilon(1e-8));
    CHECK(10.0 * kDeg == doctest::Approx(0.17453).epsilon(1e-4));
  }

  TEST_CASE("force and stress are each other's inverse, and the same without tension") {
    for (double stretch : {1.0, 1.05}) {
      for (double angle : {-0.14, 0.0, 0.07}) {
        const ShearTest test{kKesShearTension, stretch};
        CHECK(shear_stress(test, shear_force(test, 3.0, angle), angle) ==
              doctest::Approx(3.0).epsilon(1e-14));
        CHECK(shear_force({0.0, stretch}, 3.0, angle) == 3.0);
        CHECK(shear_stress({0.0, stretch}, 3.0, angle) == 3.0);
      }
    }
  }

  TEST_CASE("G, 2HG and 2HG5 come back through the tension, whatever they are") {
    const struct {
      double G, near, far;
    } cases[] = {{0.8, 1.2, 2.5}, {0.2, 0.05, 2.0}, {0.6, 0.6, 0.2}, {7.0, 15.0, 6.0}, {2.0, 4.0, 20.0}};
    for (const auto& c : cases) {
      for (const ShearTest& test : {ShearTest{}, ShearTest{kKesShearTension, 1.004}}) {
        CAPTURE(c.G);
        CAPTURE(test.tension);
        const PlayLaw law = make_shear_law(c.G * kG, c.near * kF, c.far * kF, test);
        const ShearParameters p = compute_shear_parameters(recorded(law, test));
        // 0.1 %: the corners of the tables at 0.5 and 2.5 degrees are rounded by the cubic over one node.
        CHECK(p.G.mean() / kG == doctest::Approx(c.G).epsilon(1.5e-3));
        CHECK(p.hysteresis_2HG.mean() / kF == doctest::Approx(c.near).epsilon(1e-9));
        CHECK(p.hysteresis_2HG5.mean() / kF == doctest::Approx(c.far).epsilon(1e-9));
      }
    }
  }

  TEST_CASE("the stretch under a load is where the first loading carries it") {
    const PlayLaw law = make_tensile_law(0.6, 0.7, 0.06, 500 * kF);
    const double stretch = stretch_under(law, 10 * kF);
    CHECK(law.evaluate(stretch - 1.0, {}).stress == doctest::Approx(10 * kF).epsilon(1e-9));
    CHECK(stretch_under(law, 0.0) == 1.0);
  }
}

TEST_SUITE("property") {
  TEST_CASE("where friction grows faster than G the recovery still falls with the angle") {
    const ShearTest test{kKesShearTension, 1.0};
    const PlayLaw law = make_shear_law(0.2 * kG, 0.05 * kF, 2.0 * kF, test);
    const MeasuredCurve curve = recorded(law, test);
    const std::vector<CurveSample>& back = curve.branches[1].samples;
    for (std::size_t i = 1; i < back.size(); ++i) CHECK(back[i].stress <= back[i - 1].stress);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("laws are made without the share of the tension, unless there was none") {
    const FabricLaws kes = make_fabric_laws(fabric_with_G(0.8));
    // 0.3 %: the yarns, assumed, stretch by that under 10 gf/cm.
    CHECK(slope_of(kes) == doctest::Approx(0.8 - 10.0 * kDeg).epsilon(4e-3));
    CHECK(kes.shear_test.tension == kKesShearTension);
    CHECK(notes_have(kes, "10 gf/cm of KES-FB1"));
    Fabric bias = fabric_with_G(0.8);
    bias.shear.tension.value = 0.0;
    CHECK(slope_of(make_fabric_laws(bias)) == doctest::Approx(0.8).epsilon(1e-9));
    bias.shear.tension.value = 20.0 * kF;
    CHECK(slope_of(make_fabric_laws(bias)) == doctest::Approx(0.8 - 20.0 * kDeg).epsilon(6e-3));
  }

  TEST_CASE("a curve that is marked as bias holds stresses, any other forces") {
    Fabric fabric = fabric_with_G(0.8);
    const PlayLaw law = make_shear_law(0.8 * kG, 1.2 * kF, 1.2 * kF);
    fabric.shear.curve = KnownCurve{recorded(law, {}), {}};
    fabric.shear.curve->curve.direction = Direction::kBias;
    const double x = 6.0 * kDeg;
    PlayState turned;
    const FabricLaws stress = make_fabric_laws(fabric);
    CHECK(stress.shear_test.tension == 0.0);
    fabric.shear.curve->curve.direction = Direction::kWarp;
    const FabricLaws force = make_fabric_laws(fabric);
    CHECK(force.shear_test.tension == kKesShearTension);
    const double with = stress.shear.evaluate(x, turned).stress,
                 without = force.shear.evaluate(x, turned).stress;
    CHECK(without == doctest::Approx(shear_stress(force.shear_test, with, x)).epsilon(1e-3));
  }

  TEST_CASE("a G below the share of the tension was measured without it") {
    const FabricLaws laws = make_fabric_laws(fabric_with_G(0.15));
    CHECK(slope_of(laws) == doctest::Approx(0.15).epsilon(1e-9));
    CHECK(notes_have(laws, "taken as measured without tension"));
    Fabric stated = fabric_with_G(0.15);
    stated.shear.tension.value = kKesShearTension;
    CHECK_THROWS_AS(make_fabric_laws(stated), Error);
  }
}
