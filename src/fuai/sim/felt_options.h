// How to step a cloth whose force somebody feels.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/solver/implicit.h"

namespace fuai {

/// Steps of a felt cloth, and of what it is compared with, are implicit Euler's: with less damping a light
/// sheet that snaps through under the hand goes another way for every rounding (graded-1 and the faille,
/// bent: 4 and 8 % from the converged solve in place of 0.9 % at worst; the other bundled fabrics come out
/// the same).
inline constexpr double kFeltImplicitness = 1.0;

/// Each step to 0.2 % of its force, in up to eight linearisations. Tuned on the bundled fabrics bent by a
/// hand that moves in encoder steps (test_cloth_force): the solver's own two linearisations miss up to 2.5 %
/// of the force there, and more iterations in each help less. Thread class: any.
ImplicitOptions make_felt_options(const ImplicitOptions& scene) noexcept;

}  // namespace fuai
