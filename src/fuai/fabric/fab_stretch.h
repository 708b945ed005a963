// The stretch tests of the Fabric Analyzer as tensile curves.
// SPDX-License-Identifier: Apache-2.0
//
// Zero rule. Strain is (d - L) / L with L the file's free length `length`: in the long test the force leaves
// the slack reading there (woven: within 0.2 % of strain; a knit takes up gradually, about 1 %).
// take_up_strain says where the first loading really carries 0.5 gf/cm: it is the uncertainty of the zero.
// Force zero is the mean of the first loading branch while the clamps are closer than 0.995 L. Samples below
// zero strain are cut, with one interpolated sample at zero; all nested cycles are kept. A later cycle starts
// slack, at zero force, until the strip's lasting elongation is taken up.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fuai/fabric/fab_record.h"
#include "fuai/fabric/measured_curve.h"

namespace fuai {

/// One stretch test read as a curve.
struct FabStretch {
  MeasuredCurve curve;          ///< force per width [N/m] against strain [-]
  double force_zero = 0.0;      ///< reading of the slack strip, taken off [N]
  double force_noise = 0.0;     ///< standard deviation of it per width [N/m]
  double take_up_strain = 0.0;  ///< where the first loading carries 0.5 gf/cm [-]
  double peak_load = 0.0;       ///< largest force per width [N/m]
  double peak_strain = 0.0;     ///< strain there [-]
};

/// Long (S2) and short (S1) test of one direction compared at one load. If slip and compliance of the clamps
/// added the same length to both, the short strip would show the larger strain.
struct FabClampCheck {
  double load = 0.0;             ///< force per width at which both are read: 80 % of the lower peak [N/m]
  double strain_long = 0.0;      ///< [-]
  double strain_short = 0.0;     ///< [-]
  double clamp_length = 0.0;     ///< apparent extra length of both clamps together [m]
  double strain_in_cloth = 0.0;  ///< strain_long without it [-]
};

/// Reads one stretch test.
/// @param record the file @param direction strip @param test kS2 (use this) or kS1 (cross-check only)
/// @return the curve with test = kTensile, also for the bias strip
/// @throws Error (kBadInput) when the test is missing or has no loading branch. Thread class: set-up.
FabStretch make_fab_stretch(const FabRecord& record, Direction direction, FabTest test = FabTest::kS2);

/// Compares S2 with S1 on the last loading branches. @throws Error (kBadInput) as above.
FabClampCheck check_fab_clamps(const FabRecord& record, Direction direction);

}  // namespace fuai
