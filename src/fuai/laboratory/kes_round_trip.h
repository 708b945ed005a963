// A fabric in the virtual instrument, and what the instrument gave back: the loop and its KES parameters,
// beside the fabric's own.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/virtual-kes.md, "Round trip".
//
//   fabric -> laws -> engine -> instrument -> curve -> parameters, by the code that reads measured curves
//      \________ the fabric's loop ____________/            \__ the fabric's parameters
//
// The fabric's loop, on the path of the instrument: where the fabric has a measured curve, that curve as one
// cycle (the nodes its law was made of); where it has scalars or nothing, what its law says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fuai/core/progress.h"
#include "fuai/fabric/fabric.h"
#include "fuai/fabric/laws.h"
#include "fuai/laboratory/kes_instruments.h"
#include "fuai/picture/plot.h"
#include "fuai/units/kes.h"

namespace fuai {

/// What to test and how.
struct KesTest {
  Test test = Test::kBending;          ///< bending, shear or tensile
  std::optional<Direction> direction;  ///< warp or weft; nothing: the warp, but in shear the mean of both, as
                                       ///< a fabric keeps one set of shear numbers
  std::vector<KesReversal> reversals;  ///< see KesOptions
  double spacing = 0.0;                ///< the same [m]
};

/// One KES parameter.
struct KesValue {
  Kes quantity;
  double value;  ///< [SI]; NaN: the curve does not show it
};

/// The outcome.
struct KesRoundTrip {
  KesTest test;
  KesRecord record;                 ///< of the instrument, in the convention of the fabric's numbers
  MeasuredCurve loop;               ///< the fabric's, at the same strains
  bool loop_measured = false;       ///< it is a measured curve
  std::vector<KesValue> simulated;  ///< read off the record
  std::vector<KesValue> input;      ///< the fabric's: as stated, or read off its loop
  std::vector<KesValue> stated;     ///< the fabric's scalars as they stand in its file; NaN: not there
  double loop_rms = 0.0;            ///< root of the mean square of the difference, over the loop's peak [-]
  double high = 0.0, low = 0.0;     ///< stops, see KesOptions
  std::vector<std::string> notes;   ///< what was assumed, plain sentences
};

/// The KES parameters of a bending, shear or tensile curve, in the order of units/kes.h. Thread class:
/// set-up.
std::vector<KesValue> read_kes_parameters(const MeasuredCurve& curve);

/// Tests a fabric. The stops are those of its own measured curve, else of the instrument; a fabric whose law
/// was made from a steady loop goes through one cycle before the recorded one.
/// @throws Error as the instruments and make_fabric_laws(). Thread class: set-up.
KesRoundTrip run_kes_round_trip(const Fabric& fabric, const KesTest& test, const Progress& progress = {});

/// The simulated loop over the fabric's, and over the measured samples where there are any. Thread class:
/// set-up.
Plot kes_plot(const Fabric& fabric, const KesRoundTrip& trip);

}  // namespace fuai
