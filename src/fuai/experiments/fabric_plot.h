// Plots of a fabric: measured points and the loops of its laws, in KES units.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/fabric/fabric.h"
#include "fuai/fabric/laws.h"
#include "fuai/picture/plot.h"

namespace fuai {

/// Moment against curvature: the steady loops of warp and weft over the KES range, measured points where
/// there are any. Thread class: set-up.
Plot bending_plot(const Fabric& fabric, const FabricLaws& laws);

/// Shear force against angle; a steady loop over the measured range or the KES range of 8 degrees, measured
/// points.
Plot shear_plot(const Fabric& fabric, const FabricLaws& laws);

/// Tension against strain in one direction: the law driven through the measured cycles, or one cycle to EMT.
Plot tensile_plot(const Fabric& fabric, const FabricLaws& laws, Direction direction);

/// All four panels: bending, shear, tension of warp and of weft.
PlotGrid fabric_plot(const Fabric& fabric, const FabricLaws& laws);

/// Measured points and a prediction at the same strains as lines; axes by the test. Thread class: set-up.
Plot curve_and_prediction_plot(const MeasuredCurve& measured, const MeasuredCurve& predicted);

/// An empty plot with the axes of a test, in KES units. Thread class: set-up.
Plot test_plot(Test test);

/// A curve in the units of those axes; lines are interrupted between branches. Thread class: set-up.
/// @param colour series_colour() number; -1: the colour of the curve's direction
Series curve_series(const MeasuredCurve& curve, const std::string& label, SeriesStyle style, int colour = -1);

/// A law's steady loop between -range and range, `count` samples a branch; strain and stress in SI.
struct SteadyLoop {
  std::vector<double> strain, stress;  ///< rising branch, then falling branch
};
SteadyLoop steady_loop(const PlayLaw& law, double range, int count = 201);

}  // namespace fuai
