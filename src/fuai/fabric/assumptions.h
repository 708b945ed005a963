// What is assumed where nothing was measured: every rule and its number, in one place.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/assumptions.md.
#pragma once

#include "fuai/units/constants.h"

namespace fuai::assumed {

/// Thickness = areal mass over this bulk density [kg/m3]; the two KES fabrics bundled with both numbers give
/// 400 and 461.
inline constexpr double kBulkDensity = 430.0;
/// 2HB = this times B [1/m]: wool and filament yarns, cotton and linen, and fibres that are not stated.
inline constexpr double kHysteresisPerBendingSmooth = 0.45 * unit::kPerCentimetre;
inline constexpr double kHysteresisPerBendingCotton = 1.0 * unit::kPerCentimetre;
inline constexpr double kHysteresisPerBendingUnknown = 0.7 * unit::kPerCentimetre;
/// How far the true 2HB / B may lie from that, as a factor either way: the two bundled KES fabrics have 0.37
/// and 0.49 /cm, published orders of magnitude 0.4 to 1.3.
inline constexpr double kHysteresisSpread = 1.5;
/// Shear rigidity 0.8 gf/(cm deg) [N/(m rad)].
inline constexpr double kShearG = 0.8 * unit::kGfPerCmDeg;
/// 2HG = this many degrees times G [rad]; 2HG5 = 2HG.
inline constexpr double kShearHysteresisAngle = 1.5 * unit::kDegree;
/// Tension of a woven fabric without a measurement.
inline constexpr double kLT = 0.7, kRT = 0.6, kEMT = 0.05;
inline constexpr double kPeakLoad = 500.0 * unit::kGfPerCm;  ///< standard KES setting [N/m]
/// Twist stiffness without a bias test: Bt = this times sqrt(B warp * B weft), B12 = 0.
inline constexpr double kTwistShare = 0.25;
/// What no KES test shows and every moving cloth needs: the time constant of viscosity in tension [s], drag
/// proportional to mass [1/s], and the drag of air: coefficient across [-] and along [-] the cloth, density
/// [kg/m3].
inline constexpr double kTensileViscosityTime = 5e-5;
/// Cloth under compression buckles with waves of this length [m]: it carries B (2 pi / length)^2 until then.
inline constexpr double kCompressionWavelength = 0.03;
inline constexpr double kMassDrag = 1.5;
inline constexpr double kAirNormalDrag = 1.2;
inline constexpr double kAirTangentialDrag = 0.02;
inline constexpr double kAirDensity = 1.2;
/// Yarns per length of a woven fabric, loops per length of a knit [1/m]; they are looked at only. Shirtings
/// and light worsteds have about 20 to 40 yarns a centimetre, single jerseys about 10 to 18 wales.
inline constexpr double kWovenThreads = 24.0 * unit::kPerCentimetre;
inline constexpr double kKnitLoops = 14.0 * unit::kPerCentimetre;

}  // namespace fuai::assumed
