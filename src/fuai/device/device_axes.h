// Axes of devices that have y up, as OpenGL does, turned into ours.
// SPDX-License-Identifier: Apache-2.0
//
//   theirs:  x right, y up, z towards the user      ours:  x right, y away from the user, z up
#pragma once

#include "fuai/core/types.h"

namespace fuai {

/// Thread class: real-time.
inline Vec3 from_y_up(const Vec3& theirs) noexcept { return {theirs.x(), -theirs.z(), theirs.y()}; }
/// Thread class: real-time.
inline Vec3 to_y_up(const Vec3& ours) noexcept { return {ours.x(), ours.z(), -ours.y()}; }
/// A R A^T for a turn R in their axes, A as from_y_up(). Thread class: real-time.
inline Mat3 turn_from_y_up(const Mat3& theirs) noexcept {
  Mat3 columns;  // A R
  for (int j = 0; j < 3; ++j) columns.col(j) = from_y_up(theirs.col(j));
  Mat3 ours;
  ours.col(0) = columns.col(0);
  ours.col(1) = -columns.col(2);
  ours.col(2) = columns.col(1);
  return ours;
}

}  // namespace fuai
