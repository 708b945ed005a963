// Bicubic interpolation of a piece onto another lattice.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Layers of slots around the lattice that continue it: a cubic reaches two beyond a cell.
constexpr int kMargin = 3;

/// Positions on the coarse lattice and beyond it.
class Extended {
 public:
  Extended(const ClothModel& model, const ClothState& state)
      : columns_(model.columns + 2 * kMargin), rows_(model.rows + 2 * kMargin) {
    const auto count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    positions_.assign(count, Vec3::Zero());
    known_.assign(count, 0);
    for (int row = 0; row < model.rows; ++row) {
      for (int column = 0; column < model.columns; ++column) {
        const auto slot = static_cast<std::size_t>(model.slot(column, row));
        if (model.live[slot] == 0) continue;
        positions_[index(column, row)] = state.positions[slot];
        known_[index(column, row)] = 1;
      }
    }
    while (continue_straight()) {
    }
  }

  /// Bicubic (Catmull-Rom) value at lattice coordinates.
  Vec3 at(double x, double y) const {
    const int column = std::clamp(static_cast<int>(std::floor(x)), -1, columns_ - 2 * kMargin - 1);
    const int row = std::clamp(static_cast<int>(std::floor(y)), -1, rows_ - 2 * kMargin - 1);
    const std::array<double, 4> wx = weights(x - column), wy = weights(y - row);
    Vec3 sum = Vec3::Zero();
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        sum += wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)] *
               positions_[index(column - 1 + i, row - 1 + j)];
      }
    }
    return sum;
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row + kMargin) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column + kMargin);
  }
  static std::array<double, 4> weights(double t) {
    const double t2 = t * t, t3 = t2 * t;
    return {-0.5 * t3 + t2 - 0.5 * t, 1.5 * t3 - 2.5 * t2 + 1.0, -1.5 * t3 + 2.0 * t2 + 0.5 * t,
            0.5 * (t3 - t2)};
  }
  /// One more layer: the mean of the straight continuations of every yarn that leads there.
  bool continue_straight() {
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

  int columns_, rows_;
  std::vector<Vec3> positions_;
  std::vector<std::uint8_t> known_;
};

}  // namespace

ClothState refine_state(const ClothModel& coarse, const ClothState& state, const ClothModel& fine) {
  if (state.positions.size() != static_cast<std::size_t>(coarse.slot_count()))
    throw Error(ErrorKind::kUsage, "the state does not belong to the coarse model");
  const Extended shape(coarse, state);
  ClothState result = make_cloth_state(fine);
  for (int row = 0; row < fine.rows; ++row) {
    for (int column = 0; column < fine.columns; ++column) {
      const auto slot = static_cast<std::size_t>(fine.slot(column, row));
      if (fine.live[slot] == 0) continue;
      const Vec2 place = (fine.material(column, row) - coarse.origin) / coarse.spacing;
      result.positions[slot] = shape.at(place.x(), place.y());
      const int near_column = std::clamp(static_cast<int>(std::lround(place.x())), 0, coarse.columns - 1);
      const int near_row = std::clamp(static_cast<int>(std::lround(place.y())), 0, coarse.rows - 1);
      const auto near = static_cast<std::size_t>(coarse.slot(near_column, near_row));
      result.weft_bending[slot] = state.weft_bending[near];
      result.warp_bending[slot] = state.warp_bending[near];
      result.shear[slot] = state.shear[near];
      result.weft_tension[slot] = state.weft_tension[near];
      result.warp_tension[slot] = state.warp_tension[near];
    }
  }
  result.time = state.time;
  return result;
}

}  // namespace fuai
