// The smooth surface through the slots of a piece: bicubic, continued straight beyond the outermost slots.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/equilibrium.md, "From coarse to fine".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fuai/cloth/cloth_model.h"

namespace fuai {

/// A Catmull-Rom surface: it goes through the slots, its error falls with the cube of the spacing.
class SmoothSurface {
 public:
  /// @param positions [m] (slots), as many as the model has slots. Thread class: set-up.
  SmoothSurface(const ClothModel& model, std::span<const Vec3> positions);

  /// Where a point of the piece is [m]. @param material weft and warp coordinate [m]. Thread class: any.
  Vec3 at(const Vec2& material) const noexcept;

 private:
  std::size_t index(int column, int row) const noexcept;
  bool continue_straight();

  int columns_, rows_;  // with the margin
  double spacing_;
  Vec2 origin_;
  std::vector<Vec3> positions_;
  std::vector<std::uint8_t> known_;
};

}  // namespace fuai
