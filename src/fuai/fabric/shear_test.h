// The shear test under tension: what the constant tension of KES-FB1 adds to the measured force.
// SPDX-License-Identifier: Apache-2.0
// Source: Kawabata 1980, KES-FB1 (the test); docs/theory/virtual-kes.md, "The share of the tension".
//
//   A specimen between two clamps, yarns of length lambda L across at the angle phi, held apart by the
//   tension W0 per width and shifted by the force F per width:
//     potential per width   L (W_t(lambda) + W_s(phi)) - W0 lambda L cos(phi) - F lambda L sin(phi)
//     d/dphi = 0            F = tau / (lambda cos(phi)) + W0 tan(phi),    tau = W_s'(phi)
//   so the slope at zero is G / lambda + W0: 10 gf/cm make 0.1745 gf/(cm deg), a fifth of a suiting's G.
#pragma once

#include <cmath>
#include <span>

#include "fuai/fabric/fabric.h"
#include "fuai/fabric/play_law.h"
#include "fuai/units/constants.h"

namespace fuai {

/// The constant tension of KES-FB1 [N/m].
inline constexpr double kKesShearTension = 10.0 * unit::kGfPerCm;

/// How a shear force was measured.
struct ShearTest {
  double tension = 0.0;  ///< W0 [N/m]; 0: what is called force is the shear stress tau itself, work tau dphi
                         ///< per area
  double stretch = 1.0;  ///< lambda, of the yarns under the tension [-]
};

/// tau / (lambda cos(phi)) + W0 tan(phi). @param stress tau [N/m] @param angle phi [rad] @return force per
/// width [N/m]. Thread class: any.
inline double shear_force(const ShearTest& test, double stress, double angle) noexcept {
  if (test.tension == 0.0) return stress;
  return stress / (test.stretch * std::cos(angle)) + test.tension * std::tan(angle);
}

/// The inverse: (F - W0 tan(phi)) lambda cos(phi) [N/m]. Thread class: any.
inline double shear_stress(const ShearTest& test, double force, double angle) noexcept {
  if (test.tension == 0.0) return force;
  return (force - test.tension * std::tan(angle)) * test.stretch * std::cos(angle);
}

/// A curve of forces as stresses, and back. Thread class: set-up.
MeasuredCurve to_shear_stress(MeasuredCurve forces, const ShearTest& test);
MeasuredCurve to_shear_force(MeasuredCurve stresses, const ShearTest& test);

/// Stretch of virgin yarns under a load per width [-]. @param load [N/m], >= 0. Thread class: any.
double stretch_under(const PlayLaw& tensile, double load) noexcept;

/// How the shear numbers of a fabric were measured: the tension that the file states; else none for a curve
/// that is marked as bias (a stretched bias strip gives the stress) and that of KES-FB1 otherwise. A file
/// keeps one set of numbers for both yarn directions, so 1 / lambda is the mean of both.
/// @param tensile laws of warp and weft. Thread class: any.
ShearTest shear_test_of(const Fabric& fabric, std::span<const PlayLaw> tensile) noexcept;

}  // namespace fuai
