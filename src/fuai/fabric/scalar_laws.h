// Laws from KES scalars alone: the simplest play law that gives the scalars back when they are read off its
// loop.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/play-law.md, "From the scalars alone".
#pragma once

#include <array>
#include <limits>
#include <span>

#include "fuai/fabric/identify.h"
#include "fuai/fabric/play_law.h"
#include "fuai/fabric/shear_test.h"

namespace fuai {

/// Half range of the KES bending test, 2.5 1/cm [1/m].
inline constexpr double kKesBendingRange = 250.0;
/// Half range of the KES shear test, 8 degrees [rad].
double kes_shear_range();

/// Play radii of bending friction [1/m] and their weights where nothing shows them: 0.05, 0.15, 0.4 1/cm.
inline constexpr std::array<PlayElement, 3> kBendingPlays{{{5.0, 0.3}, {15.0, 0.4}, {40.0, 0.3}}};
/// The same in words, for reports.
inline constexpr const char* kBendingPlaysInWords = "play radii 0.05, 0.15 and 0.4 1/cm";
/// Jamming curvature of a strip that may be bent to any curvature [1/m].
inline constexpr double kNoJamming = std::numeric_limits<double>::infinity();

/// Moment = B K plus friction of half width 2HB / 2: B and 2HB come back exactly.
/// @param B bending rigidity [N m]  @param hysteresis_2HB full loop width [N]
/// @param jamming_curvature curvature that the thickness forbids, 1/T [1/m]; raised to 1.25 times the test
/// range; kNoJamming: linear for ever
/// @param plays assumed: only a loop's tips would show them
/// @throws Error (kBadInput) when B <= 0 or 2HB < 0. Thread class: set-up.
PlayLaw make_bending_law(double B, double hysteresis_2HB, double jamming_curvature,
                         std::span<const PlayElement> plays = kBendingPlays);

/// Shear stress = elastic line plus friction that grows linearly from 2HG / 2 (up to 0.5 degrees) to 2HG5 / 2
/// at 5 degrees and on to 8; constant beyond. The elastic slope is G less the growth of the friction, since G
/// is read on the loading branch: G, 2HG and 2HG5 come back exactly when the test is done with the law. Where
/// the recovery would fall while the angle grows, the friction grows after 2.5 degrees instead, and the
/// loading branch steepens there. Play radii 0.1, 0.25, 0.5 degrees are assumed. Beyond 8 degrees the slope
/// is kept; at 90 degrees warp and weft would coincide, so the stress goes to infinity there.
/// @param G [N/(m rad)]  @param hysteresis_2HG [N/m]  @param hysteresis_2HG5 [N/m], all as the test reads
/// them
/// @param test how they were measured; the default: of the stress itself
/// @throws Error (kBadInput) when G is not more than the tension's share, 2HG5 is out of all proportion to G,
/// or a value is negative. Thread class: set-up.
PlayLaw make_shear_law(double G, double hysteresis_2HG, double hysteresis_2HG5, const ShearTest& test = {});

/// Tension from LT, RT, EMT and the peak load: loading and recovery are exponentials through zero and the
/// peak with the linearities LT and RT LT, so that LT, WT = LT Fm EMT / 2 and RT come back. Virgin loading is
/// the measured branch. Play radii up to 0.4 EMT are assumed. In compression a thread buckles: 1 % of the
/// secant stiffness, no friction.
/// @param LT linearity in (0, 2)  @param RT resilience in (0, 1]  @param EMT strain at the peak  @param
/// peak_load [N/m]
/// @throws Error (kBadInput) for values outside. Thread class: set-up.
PlayLaw make_tensile_law(double LT, double RT, double EMT, double peak_load);

/// Exponential curve of linearity LT: F(z) = (e^{a z} - 1) / (e^a - 1), z in [0, 1]; this is a.
/// a solves LT = 2 (1/a - 1/(e^a - 1)). @param LT in (0, 2)
double exponential_rate(double LT);

/// How the elastic curve of tension goes on: end slope above, buckling slope below zero.
Extrapolation tensile_outside(double secant_stiffness, double end_slope);
/// How the elastic curve of bending goes on: end slope, then jamming at a curvature of one over the
/// thickness, if any.
Extrapolation bending_outside(double range, double jamming_curvature);
/// How the elastic curve of shear goes on: end slope, then jamming at 90 degrees.
Extrapolation shear_outside();

}  // namespace fuai
