// Draws measured points and laws.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/fabric_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fuai/fabric/cycle_comparison.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

/// SI values of one KES unit on the two axes.
struct AxisUnits {
  double strain, stress;
};

constexpr AxisUnits kBendingUnits{unit::kPerCentimetre, unit::kGfCmPerCm};
constexpr AxisUnits kShearUnits{unit::kDegree, unit::kGfPerCm};
constexpr AxisUnits kTensileUnits{unit::kPercent, unit::kGfPerCm};

AxisUnits units_of(Test test) {
  return test == Test::kBending ? kBendingUnits : (test == Test::kShear ? kShearUnits : kTensileUnits);
}

int colour_of(const MeasuredCurve& curve) {
  return curve.test == Test::kShear ? series_index(Direction::kBias) : series_index(curve.direction);
}

Series loop_series(const SteadyLoop& loop, AxisUnits units, const std::string& label, int colour) {
  Series series;
  series.label = label;
  series.colour = colour;
  series.arrows = true;
  for (std::size_t i = 0; i < loop.strain.size(); ++i) {
    series.x.push_back(loop.strain[i] / units.strain);
    series.y.push_back(loop.stress[i] / units.stress);
  }
  return series;
}

/// "law from scalars B and 2HB", "assumed law".
std::string law_label(const FabricLaws& laws, const std::string& law) {
  for (const LawReport& report : laws.reports) {
    if (report.law == law) return report.origin == "assumed" ? "assumed law" : "law from " + report.origin;
  }
  return {};
}

Series measured_series(const MeasuredCurve& curve, const std::string& label, int colour) {
  Series series = curve_series(curve, label, SeriesStyle::kPoints, colour);
  series.line_width = 1.0;
  return series;
}

}  // namespace

Plot test_plot(Test test) {
  Plot plot;
  plot.x_label = test == Test::kBending ? "curvature [1/cm]"
                                        : (test == Test::kShear ? "shear angle [deg]" : "strain [%]");
  plot.y_label = test == Test::kBending ? "moment [gf·cm/cm]"
                                        : (test == Test::kShear ? "shear force [gf/cm]" : "force [gf/cm]");
  return plot;
}

Series curve_series(const MeasuredCurve& curve, const std::string& label, SeriesStyle style, int colour) {
  const AxisUnits units = units_of(curve.test);
  Series series;
  series.label = label;
  series.colour = colour < 0 ? colour_of(curve) : colour;
  series.style = style;
  for (const CurveBranch& branch : curve.branches) {
    for (const CurveSample& s : branch.samples) {
      series.x.push_back(s.strain / units.strain);
      series.y.push_back(s.stress / units.stress);
    }
    if (style == SeriesStyle::kPoints) continue;
    series.x.push_back(kGap);
    series.y.push_back(kGap);
  }
  return series;
}

SteadyLoop steady_loop(const PlayLaw& law, double range, int count) {
  SteadyLoop loop;
  PlayState state;
  law.commit(range, state);
  law.commit(-range, state);
  for (int sense : {1, -1}) {
    for (int i = 0; i < count; ++i) {
      const double x = sense * range * (2.0 * i / (count - 1) - 1.0);
      loop.strain.push_back(x);
      loop.stress.push_back(law.advance(x, state).stress);
    }
  }
  return loop;
}

Plot curve_and_prediction_plot(const MeasuredCurve& measured, const MeasuredCurve& predicted) {
  Plot plot = test_plot(measured.test);
  plot.series = {measured_series(measured, "measured", 6),
                 curve_series(predicted, "law, same path", SeriesStyle::kLine, colour_of(measured))};
  return plot;
}

Plot bending_plot(const Fabric& fabric, const FabricLaws& laws) {
  Plot plot = test_plot(Test::kBending);
  plot.title = "Bending";
  for (Direction direction : {Direction::kWarp, Direction::kWeft}) {
    const auto i = static_cast<std::size_t>(direction);
    const int colour = series_index(direction);
    const std::string name = to_string(direction);
    if (fabric.bending[i].curve) {
      plot.series.push_back(measured_series(fabric.bending[i].curve->curve, name + ", measured", colour));
    }
    plot.series.push_back(loop_series(steady_loop(laws.bending[i], kKesBendingRange), kBendingUnits,
                                      name + ", " + law_label(laws, "bending." + name), colour));
  }
  return plot;
}

Plot shear_plot(const Fabric& fabric, const FabricLaws& laws) {
  Plot plot = test_plot(Test::kShear);
  if (fabric.shear.curve) {
    const MeasuredCurve& curve = fabric.shear.curve->curve;
    plot = curve_and_prediction_plot(
        curve, to_shear_force(compare_cycles(laws.shear, curve).predicted, laws.shear_test));
  } else {
    // As the test reads it: with the share of its tension.
    SteadyLoop loop = steady_loop(laws.shear, kes_shear_range());
    for (std::size_t i = 0; i < loop.strain.size(); ++i)
      loop.stress[i] = shear_force(laws.shear_test, loop.stress[i], loop.strain[i]);
    plot.series.push_back(
        loop_series(loop, kShearUnits, law_label(laws, "shear"), series_index(Direction::kBias)));
  }
  plot.title = "Shear";
  return plot;
}

/// Strains from zero to `end` and back.
static MeasuredCurve one_cycle(Direction direction, double end) {
  MeasuredCurve cycle;
  cycle.test = Test::kTensile;
  cycle.direction = direction;
  cycle.branches = {{Branch::kLoad, {}}, {Branch::kUnload, {}}};
  constexpr int kCount = 101;
  for (int k = 0; k < kCount; ++k) {
    const double x = end * k / (kCount - 1);
    cycle.branches[0].samples.push_back({x, 0.0});
    cycle.branches[1].samples.push_back({end - x, 0.0});
  }
  return cycle;
}

Plot tensile_plot(const Fabric& fabric, const FabricLaws& laws, Direction direction) {
  const auto i = static_cast<std::size_t>(direction);
  const std::string name = to_string(direction);
  const PlayLaw& law = laws.tensile[i];
  Plot plot = test_plot(Test::kTensile);
  if (fabric.tensile[i].curve) {
    const MeasuredCurve& curve = fabric.tensile[i].curve->curve;
    plot = curve_and_prediction_plot(curve, compare_cycles(law, curve).predicted);
  } else {
    const MeasuredCurve cycle = compare_cycles(law, one_cycle(direction, law.elastic().high())).predicted;
    plot.series.push_back(
        curve_series(cycle, law_label(laws, "tensile." + name), SeriesStyle::kLine, series_index(direction)));
  }
  plot.title = "Tension, " + name;
  return plot;
}

PlotGrid fabric_plot(const Fabric& fabric, const FabricLaws& laws) {
  PlotGrid grid;
  grid.title = fabric.name;
  grid.columns = 2;
  grid.plots = {bending_plot(fabric, laws), shear_plot(fabric, laws),
                tensile_plot(fabric, laws, Direction::kWarp), tensile_plot(fabric, laws, Direction::kWeft)};
  return grid;
}

}  // namespace fuai
