// Interpolates a piece of cloth.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/smooth_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fuai/core/assertion.h"

namespace fuai {
namespace {

/// Layers of slots around the lattice that continue it: a cubic reaches two beyond a cell.
constexpr int kMargin = 3;

/// Of the four slots around a point, t of the way from the second to the third.
std::array<double, 4> cubic_weights(double t) noexcept {
  const double t2 = t * t, t3 = t2 * t;
  return {-0.5 * t3 + t2 - 0.5 * t, 1.5 * t3 - 2.5 * t2 + 1.0, -1.5 * t3 + 2.0 * t2 + 0.5 * t,
          0.5 * (t3 - t2)};
}

}  // namespace

SmoothSurface::SmoothSurface(const ClothModel& model, std::span<const Vec3> positions)
    : columns_(model.columns + 2 * kMargin),
      rows_(model.rows + 2 * kMargin),
      spacing_(model.spacing),
      origin_(model.origin) {
  FUAI_ASSERT(positions.size() == model.live.size());
  const auto count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  positions_.assign(count, Vec3::Zero());
  known_.assign(count, 0);
  for (int row = 0; row < model.rows; ++row) {
    for (int column = 0; column < model.columns; ++column) {
      const auto slot = static_cast<std::size_t>(model.slot(column, row));
      if (model.live[slot] == 0) continue;
      positions_[index(column, row)] = positions[slot];
      known_[index(column, row)] = 1;
    }
  }
  while (continue_straight()) {
  }
}

Vec3 SmoothSurface::at(const Vec2& material) const noexcept {
  const Vec2 place = (material - origin_) / spacing_;
  const int column = std::clamp(static_cast<int>(std::floor(place.x())), -1, columns_ - 2 * kMargin - 1);
  const int row = std::clamp(static_cast<int>(std::floor(place.y())), -1, rows_ - 2 * kMargin - 1);
  const std::array<double, 4> wx = cubic_weights(place.x() - column), wy = cubic_weights(place.y() - row);
  Vec3 sum = Vec3::Zero();
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      sum += wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)] *
             positions_[index(column - 1 + i, row - 1 + j)];
    }
  }
  return sum;
}

std::size_t SmoothSurface::index(int column, int row) const noexcept {
  return static_cast<std::size_t>(row + kMargin) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column + kMargin);
}

/// One more layer: the mean of the straight continuations of every yarn that leads there.
bool SmoothSurface::continue_straight() {
  std::vector<std::size_t> found;
  std::vector<Vec3> values;
  const std::ptrdiff_t step[4] = {1, -1, columns_, -columns_};
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const auto here = static_cast<std::ptrdiff_t>(row) * columns_ + column;
      if (known_[static_cast<std::size_t>(here)] != 0) continue;
      const bool fits[4] = {column + 2 < columns_, column >= 2, row + 2 < rows_, row >= 2};
      Vec3 sum = Vec3::Zero();
      int count = 0;
      for (int d = 0; d < 4; ++d) {
        if (!fits[d]) continue;
        const auto near = static_cast<std::size_t>(here + step[d]),
                   far = static_cast<std::size_t>(here + 2 * step[d]);
        if (known_[near] == 0 || known_[far] == 0) continue;
        sum += 2.0 * positions_[near] - positions_[far];
        ++count;
      }
      if (count == 0) continue;
      found.push_back(static_cast<std::size_t>(here));
      values.push_back(sum / count);
    }
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    positions_[found[i]] = values[i];
    known_[found[i]] = 1;
  }
  return !found.empty();
}

}  // namespace fuai
