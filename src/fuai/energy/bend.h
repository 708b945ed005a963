// The energy of bending per area and the moment it gives, as printed in the paper and as it should be.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", Eqs. (3) to (5).
#pragma once

#include <cmath>

#include "fuai/fabric/play_law.h"

namespace fuai {

/// Energy per area and its derivative by the curvature.
struct BendValue {
  double energy = 0.0;  ///< per area [J/m2]
  double moment = 0.0;  ///< d energy / d curvature: moment per width [N]
};

/// The paper's phi(K), Eq. (3): the ascending branch of the measured loop only, t = F_e(K) + Y(K), where
/// "no positive force is given to a negative curvature": t <= 0 for K < 0. So t(0) = +HB and t(0-) = 0.
/// @param elastic,friction F_e and Y at the curvature, with slopes @return t [N] and its slope.
/// Thread class: real-time.
inline CurveValue ascending_branch(double curvature, const CurveValue& elastic,
                                   const CurveValue& friction) noexcept {
  CurveValue t{elastic.value + friction.value, elastic.slope + friction.slope};
  if (curvature < 0.0 && t.value > 0.0) t = {0.0, 0.0};
  return t;
}

/// Eqs. (4) and (5) as printed: energy |t K / 2| a unit area. Its derivative is B K for a linear law, but
/// only B K + HB / 2 with friction. @param t value and slope of the branch at this curvature. Thread class:
/// real-time.
inline BendValue bend_as_printed(double curvature, const CurveValue& t) noexcept {
  const double product = t.value * curvature;
  const double moment = 0.5 * (t.slope * curvature + t.value);
  return {0.5 * std::abs(product), product < 0.0 ? -moment : moment};
}

/// The correction: W_n(K), the incremental potential of the law with memory, whose derivative is the measured
/// moment. For a law without friction W_n = integral of M dK. Thread class: real-time.
inline BendValue bend_with_memory(const PlayLaw& law, double curvature, const PlayState& state) noexcept {
  return {law.incremental_potential(curvature, state), law.evaluate(curvature, state).stress};
}

}  // namespace fuai
