// The cantilever test as the standards do it: the strip is pushed over the edge until its tip meets a
// slanting line.
// SPDX-License-Identifier: Apache-2.0
// Source: ASTM D1388 option A and ISO 9073-7: a line at 41.5 degrees below level (43 degrees is found as
// well); bending length = half the overhang, flexural rigidity = weight times its cube.
//
//   41.5 degrees is where half the overhang is the bending length of the exact elastica, to 0.02 %; at 43
//   degrees it is 2 % too long, so the exact evaluation (elastica.h) stands beside it.
#pragma once

#include "fuai/core/progress.h"
#include "fuai/experiments/cantilever.h"
#include "fuai/units/constants.h"

namespace fuai {

/// The line of ASTM D1388 and ISO 9073-7 below level [rad], and the other one in use.
inline constexpr double kFlexometerAngle = 41.5 * unit::kDegree, kOtherFlexometerAngle = 43.0 * unit::kDegree;

/// What the test shows.
struct OverhangResult {
  double overhang = 0.0;        ///< free length whose chord lies at the angle [m]
  double half_overhang = 0.0;   ///< the standards' bending length [m]
  double rigidity = 0.0;        ///< weight per area times its cube [N m]
  int runs = 0;                 ///< strips that were hung
  CantileverResult cantilever;  ///< at that overhang
};

/// Finds the overhang. Each length is a strip of its own that hangs along a ramp of its weight; the real
/// strip is pushed out instead, which friction may remember.
/// @param options as for run_cantilever(); its length is not used, its spacing must be 0
/// @param chord_angle below level [rad], in (0, 80 degrees]
/// @throws Error (kUsage) for another angle or a spacing, (kCheckFailed) when no length of 1 mm to 2 m hangs
/// so. Thread class: set-up.
OverhangResult find_overhang(const FabricLaws& laws, const CantileverOptions& options, double chord_angle,
                             const Progress& progress = {});

}  // namespace fuai
