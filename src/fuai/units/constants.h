// Exact factors between the units of textile laboratories and SI. The only place where such a factor stands.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "fuai/core/constants.h"

namespace fuai::unit {

inline constexpr double kGramForce = 1e-3 * kStandardGravity;  ///< [N], exact
inline constexpr double kCentinewton = 1e-2;                   ///< [N]
inline constexpr double kCentimetre = 1e-2;                    ///< [m]
inline constexpr double kMillimetre = 1e-3;                    ///< [m]
inline constexpr double kMicrometre = 1e-6;                    ///< [m]
inline constexpr double kDegree = std::numbers::pi / 180.0;    ///< [rad]
inline constexpr double kPercent = 1e-2;

// KES composites, each derived from the units above.
inline constexpr double kPerCentimetre = 1.0 / kCentimetre;      ///< curvature 1/cm -> 1/m
inline constexpr double kGfPerCm = kGramForce / kCentimetre;     ///< force per width -> N/m
inline constexpr double kGfCm2PerCm = kGramForce * kCentimetre;  ///< bending rigidity -> N m
inline constexpr double kGfCmPerCm = kGramForce;                 ///< moment per width -> N
inline constexpr double kGfPerCmDeg = kGfPerCm / kDegree;        ///< shear rigidity -> N/(m rad)
inline constexpr double kGfCmPerCm2 = kGramForce / kCentimetre;  ///< work per area -> J/m2
inline constexpr double kGfPerCm2 = kGramForce / (kCentimetre * kCentimetre);  ///< pressure -> Pa
inline constexpr double kMgPerCm2 = 1e-2;                                      ///< areal mass -> kg/m2
inline constexpr double kGPerM2 = 1e-3;                                        ///< areal mass -> kg/m2

}  // namespace fuai::unit
