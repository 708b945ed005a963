// The smoothest way from 0 to 1 in a given time: how hands and pins set off and arrive.
// SPDX-License-Identifier: Apache-2.0
// Source: Flash and Hogan 1985, "The coordination of arm movements": the path of least mean square jerk.
#pragma once

#include <algorithm>

namespace fuai {

/// 0 before `begin`, 1 from `end` on, in between 10 s^3 - 15 s^4 + 6 s^5: speed and acceleration begin and
/// end at zero. Thread class: real-time.
inline double smooth_rise(double time, double begin, double end) noexcept {
  const double s = std::clamp((time - begin) / (end - begin), 0.0, 1.0);
  return s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

/// Its derivative by time [1/s]: 30 s^2 (1 - s)^2 / (end - begin). Thread class: real-time.
inline double smooth_rise_rate(double time, double begin, double end) noexcept {
  const double s = std::clamp((time - begin) / (end - begin), 0.0, 1.0);
  return 30.0 * s * s * (1.0 - s) * (1.0 - s) / (end - begin);
}

}  // namespace fuai
