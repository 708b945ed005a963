// The heavy elastica of a measured law: how a virgin strip hangs from a level clamp when its moment follows
// the first loading, friction included.
// SPDX-License-Identifier: Apache-2.0
// Source: elastica.h with M(K) of the play law instead of B K.
//
//   s from the free end, theta below level:  M' = w s cos(theta),  theta' = -K(M),  M(0) = 0,  theta(L) = 0
//
// Right as long as no curvature falls while the weight comes on; crosschecked against run_cantilever().
#pragma once

#include "fuai/fabric/play_law.h"

namespace fuai {

/// The shape of the strip.
struct VirginStrip {
  double chord_angle = 0.0;  ///< of the line from clamp to tip, below level [rad]
  double tip_angle = 0.0;    ///< below level [rad]
  double reach = 0.0;        ///< level distance of the tip from the clamp [m]
  double droop = 0.0;        ///< fall of the tip [m]
};

/// @param law of bending, virgin  @param weight per area, areal mass times gravity [N/m2]
/// @param length [m]  @throws Error (kUsage) unless both are positive. Thread class: set-up.
VirginStrip hang_virgin_strip(const PlayLaw& law, double weight, double length);

}  // namespace fuai
