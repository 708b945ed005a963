// The rules that fill gaps of a bending measurement: friction by the fibre, the bias from warp and weft.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/assumptions.md.
#pragma once

#include "fuai/fabric/fabric.h"

namespace fuai {

/// The rule for a missing 2HB.
struct HysteresisRule {
  double per_bending = 0.0;        ///< 2HB / B [1/m]
  const char* sentence = nullptr;  ///< that reports it
};

/// Looks for names of fibres in the composition. Thread class: any.
HysteresisRule hysteresis_rule(const Fabric& fabric);

/// Rigidity, or friction, at 45 degrees to the yarns: (warp + weft + 4 share sqrt(warp weft)) / 4, with no
/// coupling B12. @param twist_share Bt over sqrt(B warp B weft). Thread class: any.
double bias_of(double warp, double weft, double twist_share) noexcept;

}  // namespace fuai
