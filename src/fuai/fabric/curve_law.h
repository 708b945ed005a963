// The law of one measured curve: which branches are used, how the free play radii are chosen, how well it
// repeats.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/fabric/measured_curve.h"
#include "fuai/fabric/play_law.h"

namespace fuai {

/// Nodes on which a measured loop is taken: 0.02 1/cm over the KES bending range. And those of a virgin
/// loading with its recovery.
inline constexpr std::size_t kLoopNodes = 251, kVirginNodes = 201;

/// A law and what was found while making it.
struct CurveLaw {
  PlayLaw law;
  double rms_residual = 0.0;    ///< rms distance of the replayed law from every sample, over the peak stress
  double largest_radius = 0.0;  ///< largest play radius chosen [unit of strain]
  std::vector<std::string> notes;  ///< corrections and choices, plain sentences
};

/// Makes the law of a bending, shear or tensile curve. A two-sided curve is taken as a steady loop, its play
/// radii make the friction smoothest; a one-sided curve as virgin loading and recovery, its radii are those
/// with which the law repeats all nested cycles best (grid over the largest radius, 2 % to 100 % of the
/// range).
/// @param jamming_curvature for bending: 1 / thickness [1/m]
/// @throws Error (kBadInput) when the curve cannot be used; the message names curve and cure. Thread class:
/// set-up.
CurveLaw make_curve_law(const MeasuredCurve& curve, double jamming_curvature);

}  // namespace fuai
