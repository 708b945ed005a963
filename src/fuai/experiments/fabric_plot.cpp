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

Series measured_series(const MeasuredCurve& curve, AxisUnits units, const std::string& label, int colour) {
  Series series;
  series.label = label;
  series.colour = colour;
  series.style = SeriesStyle::kPoints;
  series.line_width = 1.0;
  for (const CurveBranch& branch : curve.branches) {
    for (const CurveSample& s : branch.samples) {
      series.x.push_back(s.strain / units.strain);
      series.y.push_back(s.stress / units.stress);
    }
  }
  return series;
}

Series loop_series(const PlayLaw& law, double range, AxisUnits units, const std::string& label, int colour) {
  const SteadyLoop loop = steady_loop(law, range);
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

/// A curve as a line, branch by branch.
Series branch_series(const MeasuredCurve& curve, AxisUnits units, const std::string& label, int colour) {
  Series series;
  series.label = label;
  series.colour = colour;
  for (const CurveBranch& branch : curve.branches) {
    for (const CurveSample& s : branch.samples) {
      series.x.push_back(s.strain / units.strain);
      series.y.push_back(s.stress / units.stress);
    }
    series.x.push_back(kGap);
    series.y.push_back(kGap);
  }
  return series;
}

/// The law driven through the strains of a measurement.
Series replay_series(const PlayLaw& law, const MeasuredCurve& curve, AxisUnits units,
                     const std::string& label, int colour) {
  return branch_series(compare_cycles(law, curve).predicted, units, label, colour);
}

/// "law from scalars B and 2HB", "assumed law".
std::string law_label(const FabricLaws& laws, const std::string& law) {
  for (const LawReport& report : laws.reports) {
    if (report.law == law) return report.origin == "assumed" ? "assumed law" : "law from " + report.origin;
  }
  return {};
}

}  // namespace

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

Plot bending_plot(const Fabric& fabric, const FabricLaws& laws) {
  Plot plot;
  plot.title = "Bending";
  plot.x_label = "curvature [1/cm]";
  plot.y_label = "moment [gf·cm/cm]";
  for (Direction direction : {Direction::kWarp, Direction::kWeft}) {
    const auto i = static_cast<std::size_t>(direction);
    const int colour = series_index(direction);
    const std::string name = to_string(direction);
    if (fabric.bending[i].curve) {
      plot.series.push_back(
          measured_series(fabric.bending[i].curve->curve, kBendingUnits, name + ", measured", colour));
    }
    plot.series.push_back(loop_series(laws.bending[i], kKesBendingRange, kBendingUnits,
                                      name + ", " + law_label(laws, "bending." + name), colour));
  }
  return plot;
}

Plot shear_plot(const Fabric& fabric, const FabricLaws& laws) {
  Plot plot;
  plot.title = "Shear";
  plot.x_label = "shear angle [deg]";
  plot.y_label = "shear force [gf/cm]";
  if (fabric.shear.curve) {
    plot.series.push_back(measured_series(fabric.shear.curve->curve, kShearUnits, "measured", 6));
    plot.series.push_back(
        replay_series(laws.shear, fabric.shear.curve->curve, kShearUnits, "law, same path", 2));
  } else {
    plot.series.push_back(
        loop_series(laws.shear, kes_shear_range(), kShearUnits, law_label(laws, "shear"), 2));
  }
  return plot;
}

Plot tensile_plot(const Fabric& fabric, const FabricLaws& laws, Direction direction) {
  const auto i = static_cast<std::size_t>(direction);
  const std::string name = to_string(direction);
  const int colour = series_index(direction);
  Plot plot;
  plot.title = "Tension, " + name;
  plot.x_label = "strain [%]";
  plot.y_label = "force [gf/cm]";
  if (fabric.tensile[i].curve) {
    const MeasuredCurve& curve = fabric.tensile[i].curve->curve;
    plot.series.push_back(measured_series(curve, kTensileUnits, "measured", 6));
    plot.series.push_back(replay_series(laws.tensile[i], curve, kTensileUnits, "law, same path", colour));
    return plot;
  }
  // One cycle to the end of the table.
  const double end = laws.tensile[i].elastic().high();
  MeasuredCurve cycle;
  cycle.branches.resize(2);
  constexpr int kCount = 101;
  for (int k = 0; k < kCount; ++k) {
    const double x = end * k / (kCount - 1);
    cycle.branches[0].samples.push_back({x, 0.0});
    cycle.branches[1].samples.push_back({end - x, 0.0});
  }
  plot.series.push_back(
      replay_series(laws.tensile[i], cycle, kTensileUnits, law_label(laws, "tensile." + name), colour));
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
