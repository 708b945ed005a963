// The spring between two neighbouring particles: energy and gradient.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", Eq. (1).
#pragma once

#include "fuai/core/types.h"

namespace fuai {

/// Value and gradient at the first end; the gradient at the second end is the opposite.
struct StretchValue {
  double energy = 0.0;                 ///< [unit of the stiffness times m2]
  Vec3 gradient_first = Vec3::Zero();  ///< d energy / d first end
};

/// Energy of one spring, E = stiffness / 2 (|p - q| - rest_length)^2. The paper's Eq. (1) is stiffness = 2: a
/// bare square, whose weight in a step is gamma1; with k = 2 gamma1 / gamma2 it is the energy of a spring k.
/// @param p,q the two ends [m]; at p = q the gradient is zero
/// @param rest_length L [m]
/// @param stiffness k [N/m]
/// @return energy [J] and gradient [N]. Thread class: real-time.
/// @source Wada et al., Eq. (1)
inline StretchValue evaluate_stretch(const Vec3& p, const Vec3& q, double rest_length,
                                     double stiffness) noexcept {
  const Vec3 d = p - q;
  const double length = d.norm();
  const double extension = length - rest_length;
  StretchValue value;
  value.energy = 0.5 * stiffness * extension * extension;
  if (length > 0.0) value.gradient_first = stiffness * extension / length * d;
  return value;
}

}  // namespace fuai
