// A play law as one table of straight pieces: the form that vector kernels read.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/implicit-step.md, "Laws as tables".
//
//   u(x)  = clamp((x - low) / s, 0, N) + max(x - high, 0) / s_high - max(low - x, 0) / s_low
//   index = floor(u) in [-(M + 1), N + M];  inside a piece the value and the friction strength are linear
//
// N pieces cover the measured range with the nodes of the law's own curve tables among them, M more on either
// side follow its jamming, and the two outermost go on for ever.
#pragma once

#include <vector>

#include "fuai/fabric/play_law.h"

namespace fuai {

/// Where a kernel finds the table; plain data, T is float or double.
template <class T>
struct LawTableView {
  const T* pieces = nullptr;  ///< of index 0; 4 numbers a piece: F at its start, dF/dx, Y at its start, dY/dx
  T low = 0, high = 0;        ///< measured range
  T step = 1, step_low = 1, step_high = 1;  ///< length of a piece: inside, below, above
  T inverse_step = 1, inverse_step_low = 1, inverse_step_high = 1;  ///< their reciprocals
  T count = 0;                                                      ///< N
  T first_index = 0, last_index = 0;                                ///< -(M + 1), N + M
  bool straight =
      false;  ///< inside the measured range F = offset + slope x and Y = strength: no look-up needed
  T offset = 0, slope = 0, strength = 0;
  int plays = 0;  ///< play elements
  T radius[kMaxPlays] = {};
  T inverse_radius[kMaxPlays] = {};
  T weight[kMaxPlays] = {};
};

/// Owns the numbers of a LawTableView.
template <class T>
class LawTable {
 public:
  LawTable() = default;
  /// Samples a law. Thread class: set-up.
  explicit LawTable(const PlayLaw& law);

  /// Valid as long as this object is neither moved nor destroyed.
  LawTableView<T> view() const noexcept;

 private:
  std::vector<T> pieces_{};
  LawTableView<T> layout_{};
  int below_ = 0;  // pieces in front of index 0
};

extern template class LawTable<float>;
extern template class LawTable<double>;

}  // namespace fuai
