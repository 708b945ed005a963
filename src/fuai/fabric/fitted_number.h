// How many digits of a fitted number are kept.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace fuai {

/// A fitted number in its unit to four significant digits: a hundredth of its standard error, and the same
/// whatever the last bits of the fit were. @param unit SI value of the unit. Thread class: any.
inline double to_four_digits(double value, double unit) noexcept {
  if (value == 0.0) return 0.0;
  const double in_unit = value / unit;
  const double scale = std::pow(10.0, 3.0 - std::floor(std::log10(std::abs(in_unit))));
  return std::round(in_unit * scale) / scale * unit;
}

}  // namespace fuai
