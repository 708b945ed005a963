// A smooth random field over the flat cloth, the same for every lattice.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/drape.md, "Seeds".
#pragma once

#include <array>
#include <cstdint>

#include "fuai/core/types.h"

namespace fuai {

/// Waves in all directions, of random length and phase, scaled so that the largest value over a square is 1.
class SmoothNoise {
 public:
  /// @param seed same seed, same field  @param shortest,longest wavelengths [m]
  /// @param half side of the square about (0, 0) over which the largest value is 1 [m]. Thread class: set-up.
  SmoothNoise(std::uint64_t seed, double shortest, double longest, double half);

  /// [-1, 1] within the square. @param point material coordinates [m]. Thread class: any.
  double at(const Vec2& point) const noexcept;

 private:
  double sum(const Vec2& point) const noexcept;

  static constexpr std::size_t kWaves = 24;
  struct Wave {
    Vec2 number = Vec2::Zero();  // [rad/m]
    double phase = 0.0;
  };
  std::array<Wave, kWaves> waves_{};
  double scale_ = 1.0;
};

}  // namespace fuai
