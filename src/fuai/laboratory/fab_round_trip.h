// A fabric in the virtual Fabric Analyzer: buckling to B and 2HB by the inverse fit, stretch to LT, WT, RT
// and EMT of the last cycle, each beside the fabric's own.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/virtual-kes.md, "The Fabric Analyzer's tests".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fuai/core/progress.h"
#include "fuai/fabric/buckling_fit.h"
#include "fuai/fabric/fabric.h"
#include "fuai/laboratory/fab_tests.h"
#include "fuai/laboratory/kes_round_trip.h"
#include "fuai/picture/plot.h"

namespace fuai {

/// Buckling, there and back.
struct FabBucklingTrip {
  FabRecord record;  ///< D1 and U1 of the engine
  BucklingFit fit;   ///< by the code that reads measured strips
  /// The same tests by the one-dimensional strip of fabric/buckling.h, which the fit is made of [N].
  std::vector<double> distance, engine, strip;  ///< D1, then U1
  double rms = 0.0;                             ///< of their difference, over the largest force [-]
  std::vector<KesValue> simulated, stated;      ///< B and 2HB
};

/// @param direction warp or weft. @throws Error as run_fab_buckling() and fit_buckling(). Thread class:
/// set-up.
FabBucklingTrip run_fab_buckling_trip(const Fabric& fabric, Direction direction,
                                      const Progress& progress = {});

/// Stretch, there and back: through the cycles of the fabric's own measured curve where it has one.
struct FabStretchTrip {
  MeasuredCurve curve;                ///< of the engine, all cycles
  std::optional<MeasuredCurve> loop;  ///< the measured one
  double rms = 0.0;  ///< of all measured samples from the engine's branches, over the largest force [-]
  std::vector<KesValue> simulated, stated;  ///< of the last cycle
};

/// Thread class: set-up. Errors as run_fab_stretch().
FabStretchTrip run_fab_stretch_trip(const Fabric& fabric, Direction direction);

/// Force over distance, engine over strip. Thread class: set-up.
Plot fab_buckling_plot(const std::string& title, const FabBucklingTrip& trip);
/// The engine's cycles over the measured samples. Thread class: set-up.
Plot fab_stretch_plot(const std::string& title, const FabStretchTrip& trip);

}  // namespace fuai
