// The two yarn directions of a model, so that code for weft and warp is written once.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fuai/cloth/cloth_model.h"

namespace fuai {

/// The arrays of a model along one yarn direction.
struct YarnArrays {
  int axis;                          ///< 0: weft, along x; 1: warp, along y
  int stride;                        ///< from a slot to the next on its yarn
  int across;                        ///< from a slot to the same on the next yarn
  std::vector<double>& edge_area;    ///< [m2] (slots)
  std::vector<double>& bend_area;    ///< [m2] (slots)
  std::vector<double>& bend_length;  ///< [m] (slots)
};

/// Thread class: any.
inline YarnArrays weft_arrays(ClothModel& m) noexcept {
  return {0, 1, m.columns, m.weft_edge_area, m.weft_bend_area, m.weft_bend_length};
}
inline YarnArrays warp_arrays(ClothModel& m) noexcept {
  return {1, m.columns, 1, m.warp_edge_area, m.warp_bend_area, m.warp_bend_length};
}

}  // namespace fuai
