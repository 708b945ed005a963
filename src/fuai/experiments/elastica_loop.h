// The heavy elastica in a loop: the exact shape of a strip whose ends are brought together in a clamp and
// that hangs from it.
// SPDX-License-Identifier: Apache-2.0
// Source: F. T. Peirce, J. Text. Inst. 21 (1930) T377 (the loop tests); R. H. Plaut, Text. Res. J. 85 (2015)
// 452 (that his formulas hold for small weight only).
//
//   From the lowest point upward, s in parts of the length L, theta the angle of the tangent above level:
//   theta'' = h sin(theta) - lambda s cos(theta),   theta(0) = 0,   x(1/2) = 0,   theta(1/2) =
//       90 deg   pear: the legs leave the clamp downward
//      180 deg   ring: they leave it level
//      270 deg   heart: they leave it upward and fall over
//   Two numbers are searched for: the curvature at the lowest point and the level force h.
#pragma once

namespace fuai {

/// How the ends leave the clamp.
enum class LoopKind { kPear, kRing, kHeart };

constexpr const char* to_string(LoopKind kind) {
  constexpr const char* kNames[] = {"pear", "ring", "heart"};
  return kNames[static_cast<int>(kind)];
}

/// Largest load that is looked at.
inline constexpr double kMostLoopLoad = 1000.0;

/// The shape; lengths in parts of the strip's length.
struct ElasticaLoop {
  double height = 0.0;            ///< from the lowest point up to the clamp [-]
  double bottom_curvature = 0.0;  ///< K L at the lowest point [-]
  double clamp_curvature = 0.0;   ///< K L at the clamp, positive like that at the bottom [-]
  double level_force = 0.0;       ///< h = H L^2 / B of one leg [-]
};

/// The shape under a load, to about eight digits.
/// @param load lambda = w L^3 / B [-], w the weight per area and B the rigidity per width
/// @throws Error (kUsage) unless 0 <= load <= kMostLoopLoad. Thread class: set-up.
ElasticaLoop elastica_loop(LoopKind kind, double load);

/// The load of a loop of this height: the exact evaluation of a loop test.
/// @param height in parts of the strip's length @return lambda [-]; the bending length is L / lambda^(1/3)
/// @throws Error (kUsage) for a height that no load up to kMostLoopLoad gives. Thread class: set-up.
double elastica_loop_load(LoopKind kind, double height);

}  // namespace fuai
