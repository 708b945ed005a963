// The tests of the Fabric Analyzer on the engine: a strip that buckles between clamps that come nearer, and a
// strip that is stretched in growing cycles. What they record is what the machine records, in its own form.
// SPDX-License-Identifier: Apache-2.0
// Source: "Raw Measurement Data from FAB", version 1.2, Browzwear 2020; docs/theory/virtual-kes.md.
//
//   test   strip          path
//   D1 U1  5 cm x 2 cm    flat, then 0.93, 0.835, 0.93, 0.715, 0.93, 0.595, 0.93 of the free length
//   D2     5 cm x 8 cm    the same; the strip hangs
//   S2     5 cm x 8 cm    to 25, 50, 75, 100 gf/cm, and to no load after each
#pragma once

#include "fuai/core/progress.h"
#include "fuai/fabric/buckling_fit.h"
#include "fuai/fabric/fab_record.h"
#include "fuai/fabric/laws.h"
#include "fuai/laboratory/kes_instruments.h"

namespace fuai {

/// Which buckling test.
struct FabBucklingOptions {
  Direction direction = Direction::kWarp;  ///< yarns along the strip: warp or weft
  FabTest test = FabTest::kD1;             ///< kD1 (down), kU1 (up) or kD2
  int segments = 40;        ///< spacings along the strip; the error of the force falls with the square
  double clamp_tilt = 0.0;  ///< of both clamps, positive upwards [rad]
};

/// Clamp distance and force of the whole strip [m, N], tension positive; no noise, offset or drift. The strip
/// is as even across as it is long, so a narrow piece of it is simulated; its yarns are as stiff in
/// compression as in tension, as what softens them elsewhere, buckling, is here what is tested.
/// @throws Error (kUsage) for the bias direction or another test, (kCheckFailed) when the strip does not come
/// to rest. Thread class: set-up.
FabStripTest run_fab_buckling(const FabricLaws& laws, const FabBucklingOptions& options,
                              const Progress& progress = {});

/// A record with D1 and U1 of one direction, ready for fit_buckling(). Thread class: set-up.
FabRecord record_fab_buckling(const FabricLaws& laws, Direction direction, const Progress& progress = {});

/// The tensile curve of a stretch test, all cycles.
/// @param turns strains at which the cycles turn back; none: at 25, 50, 75 and 100 gf/cm. Errors as
/// run_kes_tensile(). Thread class: set-up.
MeasuredCurve run_fab_stretch(const FabricLaws& laws, Direction direction,
                              std::span<const double> turns = {});

}  // namespace fuai
