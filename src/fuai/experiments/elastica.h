// The heavy elastica: the exact shape of a strip that is clamped level at one end and hangs under its own
// weight.
// SPDX-License-Identifier: Apache-2.0
// Source: F. T. Peirce, "The handle of cloth as a measurable quantity", J. Text. Inst. 21 (1930) T377 (the
// test and his closed formula); Bickley, Phil. Mag. 17 (1934) 603 (the exact curve).
//
//   B theta'' = -w (L - s) cos(theta),  theta(0) = 0,  theta'(L) = 0;  theta the angle below level
//
// From the free end, in units of the bending length c = (B/w)^(1/3) and with phi = 90 deg - theta:
//   phi'' = tau sin(phi),  phi(0) = phi0,  phi'(0) = 0,  until phi = 90 deg, where tau = L/c
// phi only grows on the way, so one number, ln(phi0), is all that is searched for, and no load is too large
// for double numbers: the tip angle of a long limp strip is 90 deg less something like 1e-50.
#pragma once

namespace fuai {

/// Largest load that is looked at: a strip of a hundred bending lengths.
inline constexpr double kMostElasticaLoad = 1e6;

/// The shape; lengths in parts of the strip's length.
struct HeavyElastica {
  double tip_angle = 0.0;       ///< below level [rad]
  double reach = 0.0;           ///< level distance of the tip from the clamp, x/L [-]
  double droop = 0.0;           ///< fall of the tip, z/L [-]
  double chord_angle = 0.0;     ///< of the line from clamp to tip, below level [rad]
  double root_curvature = 0.0;  ///< K L at the clamp [-]
};

/// The shape under a load, to about ten digits.
/// @param load lambda = w L^3 / B = (L/c)^3 [-], w the weight per area and B the rigidity per width
/// @throws Error (kUsage) unless 0 < load <= kMostElasticaLoad. Thread class: set-up.
HeavyElastica heavy_elastica(double load);

/// The load that gives a chord angle: the exact evaluation of the cantilever test.
/// @param chord_angle [rad]
/// @return lambda [-]; the bending length is L / lambda^(1/3)
/// @throws Error (kUsage) for an angle that no load up to kMostElasticaLoad gives. Thread class: set-up.
double heavy_elastica_load(double chord_angle);

/// The same by Peirce's closed formula, lambda = 8 tan(q) / cos(q/2): 0.2 % high at 7 degrees, 5.7 % low (B
/// 5.8 % high) at 41.5. Thread class: any.
/// @param chord_angle q [rad], 0 < q < 90 deg  @return lambda [-]
/// @source Peirce 1930
double peirce_load(double chord_angle) noexcept;

}  // namespace fuai
