// Fixed-size mathematics used everywhere.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace fuai {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// The yarn directions of a fabric. Bias is 45 degrees between warp and weft.
enum class Direction { kWarp = 0, kWeft = 1, kBias = 2 };
inline constexpr int kDirectionCount = 3;

/// "warp", "weft", "bias".
constexpr const char* to_string(Direction direction) {
  constexpr const char* kNames[] = {"warp", "weft", "bias"};
  return kNames[static_cast<int>(direction)];
}

/// How the yarns of a fabric lie over each other.
enum class WeaveStructure { kPlain = 0, kTwill = 1, kSatin = 2, kKnit = 3 };
inline constexpr int kWeaveStructureCount = 4;

/// "plain", "twill", "satin", "knit".
constexpr const char* to_string(WeaveStructure structure) {
  constexpr const char* kNames[] = {"plain", "twill", "satin", "knit"};
  return kNames[static_cast<int>(structure)];
}

}  // namespace fuai
