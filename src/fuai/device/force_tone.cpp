// Makes the samples.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/force_tone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fuai {

double tone_of(double share) noexcept { return kLowestTone * std::pow(kHighestTone / kLowestTone, share); }

void ForceTone::fill(std::span<std::int16_t> samples, double share) noexcept {
  constexpr double kFull = std::numeric_limits<std::int16_t>::max();
  constexpr double kSilent = 0.5 / (kLoudestTone * kFull);  // less rounds to nothing
  const double wanted = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
  const double follow = 1.0 - std::exp(-1.0 / (kToneFollows * kToneRate));
  for (std::int16_t& sample : samples) {
    share_ += follow * (wanted - share_);
    if (wanted == 0.0 && share_ < kSilent) share_ = 0.0;
    phase_ += tone_of(share_) / kToneRate;
    phase_ -= std::floor(phase_);
    const double wave = std::sin(2.0 * std::numbers::pi * phase_);
    sample = static_cast<std::int16_t>(std::lround(kLoudestTone * kFull * share_ * wave));
  }
}

}  // namespace fuai
