// Ranges, ticks and numbers of a plot's axis.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace fuai {

struct Tick {
  double value = 0.0;
  std::string label;  ///< empty: a minor tick
};

/// One axis: what it spans and where its ticks stand. Thread class: any.
struct Axis {
  double low = 0.0;
  double high = 1.0;
  bool logarithmic = false;
  std::vector<Tick> ticks;
  std::string factor;  ///< power of ten by which the labels are to be multiplied, e.g. "×10⁻³"; mostly empty

  /// Place on the axis: 0 at low, 1 at high.
  double place(double value) const;
};

/// An axis with ticks at 1, 2 or 5 times a power of ten.
/// @param low, high finite, low < high; both > 0 when logarithmic
/// @param most_ticks upper limit of the number of labelled ticks, at least 2; on a linear axis up to 5 are
/// made where fewer would leave a single one
Axis make_axis(double low, double high, bool logarithmic, int most_ticks);

/// A number with a real minus sign. @param decimals digits behind the point
std::string format_number(double value, int decimals);

/// The number with as many digits (six at most) as it needs.
std::string format_number(double value);

}  // namespace fuai
