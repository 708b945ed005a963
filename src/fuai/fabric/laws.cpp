// Makes the laws of a fabric and reports every assumption.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/laws.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/fabric/assumptions.h"
#include "fuai/fabric/bending_rules.h"
#include "fuai/fabric/curve_law.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/fabric/shear_test.h"

namespace fuai {
namespace {

using Index = std::size_t;

/// Rigidity and hysteresis of one direction after the rules have filled the gaps.
struct BendingScalars {
  double B = 0.0, hysteresis = 0.0;
  bool known = false;
};

BendingScalars bending_scalars(const Fabric& fabric, Direction direction, LawReport& report) {
  const BendingMeasurement& measured = fabric.bending[static_cast<Index>(direction)];
  BendingScalars scalars;
  if (!measured.B.has_value()) return scalars;
  scalars.B = measured.B.value;
  scalars.known = true;
  if (measured.hysteresis_2HB.has_value()) {
    scalars.hysteresis = measured.hysteresis_2HB.value;
  } else {
    const HysteresisRule rule = hysteresis_rule(fabric);
    scalars.hysteresis = scalars.B * rule.per_bending;
    report.assumptions.emplace_back(rule.sentence);
  }
  return scalars;
}

LawReport& add_report(FabricLaws& laws, const std::string& name) {
  laws.reports.push_back({name, "", 0.0, {}});
  return laws.reports.back();
}

void take_curve(PlayLaw& law, LawReport& report, const KnownCurve& known, double jamming_curvature) {
  CurveLaw made = make_curve_law(known.curve, jamming_curvature);
  law = std::move(made.law);
  report.origin = "measured loop";
  report.rms_residual_fraction = made.rms_residual;
  report.assumptions = std::move(made.notes);
}

/// Warp and weft bending; the bias follows from both when it was not measured.
void make_bending_laws(const Fabric& fabric, FabricLaws& laws) {
  const double jamming = 1.0 / laws.thickness;
  BendingScalars known[2];
  for (Direction direction : {Direction::kWarp, Direction::kWeft}) {
    LawReport scratch;
    known[static_cast<Index>(direction)] = bending_scalars(fabric, direction, scratch);
  }
  const bool has_curve[2] = {fabric.bending[0].curve.has_value(), fabric.bending[1].curve.has_value()};
  if (!known[0].known && !known[1].known && !has_curve[0] && !has_curve[1]) {
    throw Error(ErrorKind::kBadInput, "'" + fabric.name + "' has no bending measurement", {},
                "give B_gf_cm2_per_cm under [bending.warp] or [bending.weft], or a measured curve");
  }
  for (Direction direction : {Direction::kWarp, Direction::kWeft}) {
    const auto i = static_cast<Index>(direction);
    LawReport& report = add_report(laws, std::string("bending.") + to_string(direction));
    if (has_curve[i]) {
      take_curve(laws.bending[i], report, *fabric.bending[i].curve, jamming);
    } else if (known[i].known) {
      report.origin = "scalars B and 2HB";
      const BendingScalars s = bending_scalars(fabric, direction, report);
      laws.bending[i] = make_bending_law(s.B, s.hysteresis, jamming);
      report.assumptions.emplace_back(kBendingPlaysInWords);
    } else if (has_curve[1 - i]) {
      take_curve(laws.bending[i], report, *fabric.bending[1 - i].curve, jamming);
      report.origin = "assumed";
      report.assumptions.insert(report.assumptions.begin(),
                                "not measured: taken from the other yarn direction");
    } else {
      report.origin = "assumed";
      laws.bending[i] = make_bending_law(known[1 - i].B, known[1 - i].hysteresis, jamming);
      report.assumptions.emplace_back("not measured: taken from the other yarn direction");
    }
  }
}

/// Where the bias rule reads a law [1/m].
constexpr double kReferenceCurvature = unit::kPerCentimetre;

/// Slope and full width of a law there.
BendingScalars read_off(const PlayLaw& law) {
  BendingScalars s;
  s.B = bending_rigidity(law);
  s.hysteresis = 2.0 * law.friction().evaluate(kReferenceCurvature).value;
  return s;
}

void make_bias_law(const Fabric& fabric, FabricLaws& laws) {
  const auto bias = static_cast<Index>(Direction::kBias);
  LawReport& report = add_report(laws, "bending.bias");
  const double jamming = 1.0 / laws.thickness;
  if (fabric.bending[bias].curve) {
    take_curve(laws.bending[bias], report, *fabric.bending[bias].curve, jamming);
    return;
  }
  BendingScalars s = bending_scalars(fabric, Direction::kBias, report);
  if (s.known) {
    report.origin = "scalars B and 2HB";
    report.assumptions.emplace_back(kBendingPlaysInWords);
  } else {
    // B45 = (B1 + B2 + 2 B12 + 4 Bt) / 4 with B12 = 0, Bt = 0.25 sqrt(B1 B2); the friction by the same rule.
    const BendingScalars warp = read_off(laws.bending[0]), weft = read_off(laws.bending[1]);
    s.B = bias_of(warp.B, weft.B, assumed::kTwistShare);
    s.hysteresis = bias_of(warp.hysteresis, weft.hysteresis, assumed::kTwistShare);
    report.origin = "assumed";
    report.assumptions.emplace_back(
        "no bias test: twist stiffness 0.25 sqrt(B warp B weft), no coupling B12");
  }
  laws.bending[bias] = make_bending_law(s.B, s.hysteresis, jamming);
}

/// How the test was done, in words; nothing where the file says it.
void report_tension(const Fabric& fabric, const ShearTest& test, LawReport& report) {
  if (test.tension == 0.0) return;
  report.assumptions.push_back((fabric.shear.tension.has_value()
                                    ? std::string("the share of the test's tension")
                                    : std::string("measured under the 10 gf/cm of KES-FB1, whose share")) +
                               " is taken off: see docs/theory/virtual-kes.md");
}

void make_shear_laws(const Fabric& fabric, FabricLaws& laws) {
  LawReport& report = add_report(laws, "shear");
  const ShearMeasurement& shear = fabric.shear;
  ShearTest test = shear_test_of(fabric, laws.tensile);
  laws.shear_test = test;
  if (shear.curve) {
    take_curve(laws.shear, report, {to_shear_stress(shear.curve->curve, test), shear.curve->provenance}, 0.0);
    report_tension(fabric, test, report);
    return;
  }
  report.origin = "scalars G, 2HG and 2HG5";
  double G = shear.G.value;
  if (!shear.G.has_value()) {
    G = assumed::kShearG;
    report.origin = "assumed";
    report.assumptions.emplace_back("G was not measured: taken as 0.8 gf/(cm deg)");
  }
  double near = shear.hysteresis_2HG.value, far = shear.hysteresis_2HG5.value;
  if (!shear.hysteresis_2HG.has_value()) {
    near = assumed::kShearHysteresisAngle * G;
    report.assumptions.emplace_back("2HG was not measured: taken as 1.5 deg times G");
  }
  if (!shear.hysteresis_2HG5.has_value()) {
    far = near;
    report.assumptions.emplace_back("2HG5 was not measured: taken equal to 2HG");
  }
  report.assumptions.emplace_back("play radii 0.1, 0.25 and 0.5 deg");
  if (!shear.tension.has_value() && !(G > test.tension)) {
    test = {};
    report.assumptions.emplace_back(
        "G is less than the 10 gf/cm of KES-FB1 alone would make it: taken as measured without tension");
  }
  report_tension(fabric, test, report);
  laws.shear = make_shear_law(G, near, far, test);
  laws.shear_test = test;
}

void make_tensile_laws(const Fabric& fabric, FabricLaws& laws) {
  for (Direction direction : {Direction::kWarp, Direction::kWeft}) {
    const auto i = static_cast<Index>(direction);
    const TensileMeasurement& t = fabric.tensile[i];
    LawReport& report = add_report(laws, std::string("tensile.") + to_string(direction));
    if (t.curve) {
      take_curve(laws.tensile[i], report, *t.curve, 0.0);
      continue;
    }
    const bool measured = t.LT.has_value() || t.RT.has_value() || t.EMT.has_value();
    report.origin = measured ? "scalars LT, RT and EMT" : "assumed";
    const auto value_or = [&](const Known& known, double rule, const char* sentence) {
      if (known.has_value()) return known.value;
      report.assumptions.emplace_back(sentence);
      return rule;
    };
    const double LT = value_or(t.LT, assumed::kLT, "LT was not measured: taken as 0.7");
    const double RT = value_or(t.RT, assumed::kRT, "RT was not measured: taken as 60 %");
    const double EMT = value_or(t.EMT, assumed::kEMT, "EMT was not measured: taken as 5 %");
    const double peak = value_or(t.peak_load, assumed::kPeakLoad, "peak load not stated: 500 gf/cm");
    laws.tensile[i] = make_tensile_law(LT, RT, EMT, peak);
    report.assumptions.emplace_back("play radii up to 0.4 EMT; loading and recovery are exponentials");
  }
}

}  // namespace

double bending_rigidity(const PlayLaw& law) noexcept {
  return law.elastic().evaluate(kReferenceCurvature).slope;
}

FabricLaws make_fabric_laws(const Fabric& fabric) {
  FabricLaws laws;
  if (!fabric.areal_mass.has_value() || !(fabric.areal_mass.value > 0.0)) {
    throw Error(ErrorKind::kBadInput, "'" + fabric.name + "' has no areal mass", {},
                "give W_mg_per_cm2 under [weight]");
  }
  laws.areal_mass = fabric.areal_mass.value;
  laws.thickness = fabric.thickness.value;
  LawReport& report = add_report(laws, "thickness");
  report.origin = "measured";
  if (!fabric.thickness.has_value()) {
    laws.thickness = laws.areal_mass / assumed::kBulkDensity;
    report.origin = "assumed";
    report.assumptions.push_back("thickness was not measured: areal mass over " +
                                 std::to_string(std::lround(assumed::kBulkDensity)) + " kg/m3");
  }
  make_bending_laws(fabric, laws);
  make_bias_law(fabric, laws);
  // Shear was measured under tension and needs the tensile laws; the reports keep their order.
  FabricLaws tensile;
  make_tensile_laws(fabric, tensile);
  laws.tensile = tensile.tensile;
  make_shear_laws(fabric, laws);
  std::ranges::move(tensile.reports, std::back_inserter(laws.reports));
  return laws;
}

std::vector<std::string> assumptions_of(const FabricLaws& laws) {
  std::vector<std::string> sentences;
  for (const LawReport& report : laws.reports) {
    for (const std::string& sentence : report.assumptions) sentences.push_back(report.law + ": " + sentence);
  }
  return sentences;
}

std::uint64_t laws_hash(const FabricLaws& laws) {
  StateHash hash;
  const auto add_table = [&](const CurveTable& table) {
    const Extrapolation& rule = table.extrapolation();
    hash.add(std::array{table.low(), table.high(), static_cast<double>(rule.kind), rule.limit, rule.slope_low,
                        rule.slope_high});
    hash.add(table.nodes());
  };
  const auto add_law = [&](const PlayLaw& law) {
    add_table(law.elastic());
    add_table(law.friction());
    for (const PlayElement& play : law.elements()) hash.add(std::array{play.radius, play.weight});
  };
  hash.add(std::array{laws.areal_mass, laws.thickness});
  for (const PlayLaw& law : laws.bending) add_law(law);
  add_law(laws.shear);
  for (const PlayLaw& law : laws.tensile) add_law(law);
  return hash.value();
}

}  // namespace fuai
