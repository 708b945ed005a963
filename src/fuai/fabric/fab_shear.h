// Shear out of the stretched bias strip of the Fabric Analyzer.
// SPDX-License-Identifier: Apache-2.0
//
// Homogeneous model of a strip whose yarns lie at +-45 degrees: axial stretch l1, lateral stretch l2, free
// sides. Both yarns have the strain eps, the yarns' angle differs from a right angle by phi:
//   1 + eps = sqrt((l1^2 + l2^2) / 2)          sin phi = (l1^2 - l2^2) / (l1^2 + l2^2)
// Energy per reference area W = W_warp(eps) + W_weft(eps) + W_shear(phi), T = W_warp' + W_weft', tau =
// W_shear'.
//   d eps / d l_i = l_i / (2 (1 + eps))        d phi / d l1 = l2 / (1 + eps)^2,   d phi / d l2 = -l1 / (1 +
//   eps)^2
// The sides carry nothing, dW/dl2 = 0; the clamps carry P = dW/dl1 per reference width. Together
//   T(eps) = P l1 / (1 + eps)                  tau = P l2 / 2
// so eps follows from the measured P and l1 by one monotone equation, then l2, phi and tau. tau is the shear
// force per width of the KES test (work tau d phi per area).
// Assumed: a homogeneous strain (clamps hinder the ends, and the strip is only about 1.6 times as long as
// wide, so tau is too high); T from the last loading branches of warp and weft, on the way back from the last
// unloading branches scaled to the turning point; no coupling of warp and weft, which a knit has.
#pragma once

#include <array>
#include <string>

#include "fuai/fabric/fab_stretch.h"

namespace fuai {

/// What the bias strip says.
struct FabShear {
  MeasuredCurve curve;               ///< force per width [N/m] against shear angle [rad]; slack parts cut off
  double largest_yarn_strain = 0.0;  ///< [-]
  double largest_lateral_stretch = 1.0;  ///< l2; above 1 the model is wrong for this cloth
  double largest_angle = 0.0;            ///< [rad]
  double angle_uncertainty = 0.0;  ///< change of the largest angle when yarns are taken as unloading [rad]
  double noise = 0.0;              ///< standard deviation of the slack strip [N/m]
  std::string quality;             ///< "fair: ..." or "poor: ..."
};

/// Turns the bias strip into a shear curve.
/// @param bias, warp, weft S2 tests of one fabric, as make_fab_stretch() returns them
/// @throws Error (kBadInput) when the bias strip shears to nothing (no lateral stretch solves the balance).
/// Thread class: set-up.
FabShear make_fab_shear(const FabStretch& bias, const FabStretch& warp, const FabStretch& weft);

/// One sample of the bias strip, solved.
struct BiasPoint {
  double yarn_strain = 0.0;      ///< eps
  double lateral_stretch = 1.0;  ///< l2; NaN when the balance has no solution
  double angle = 0.0;            ///< phi [rad]
  double stress = 0.0;           ///< tau [N/m]
};

/// Solves one sample: yarn strain from T(eps) (1 + eps) = P l1, then l2, phi and tau.
/// @param axial_stretch l1 [-] @param axial_load P [N/m]; not positive means unstretched yarns
/// @param yarn_load samples (eps, T) rising in both, from (0, 0); continued with the mean slope of their
/// upper half. Thread class: any.
BiasPoint solve_bias_point(double axial_stretch, double axial_load,
                           const std::vector<CurveSample>& yarn_load);

}  // namespace fuai
