// Draws the waves.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/scenes/smooth_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace fuai {

SmoothNoise::SmoothNoise(std::uint64_t seed, double shortest, double longest, double half) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (Wave& wave : waves_) {
    const double length = shortest * std::pow(longest / shortest, share(random));
    const double direction = 2.0 * std::numbers::pi * share(random);
    wave.number = 2.0 * std::numbers::pi / length * Vec2(std::cos(direction), std::sin(direction));
    wave.phase = 2.0 * std::numbers::pi * share(random);
  }
  // The largest value, on a grid of a sixth of the shortest wave (it misses at most 14 % of one wave's
  // crest).
  const int count = std::max(1, static_cast<int>(std::ceil(6.0 * half / shortest)));
  double largest = 0.0;
  for (int j = -count; j <= count; ++j) {
    for (int i = -count; i <= count; ++i)
      largest = std::max(largest, std::abs(sum(half / count * Vec2(i, j))));
  }
  scale_ = 1.0 / largest;
}

double SmoothNoise::at(const Vec2& point) const noexcept {
  return std::clamp(scale_ * sum(point), -1.0, 1.0);
}

double SmoothNoise::sum(const Vec2& point) const noexcept {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += std::cos(wave.number.dot(point) + wave.phase);
  return sum;
}

}  // namespace fuai
