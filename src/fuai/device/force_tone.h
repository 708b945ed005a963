// The samples of a tone that follows a force: its pitch and its loudness rise with it.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "A device".
#pragma once

#include <cstdint>
#include <span>

namespace fuai {

inline constexpr unsigned kToneRate = 48000;                        ///< [samples/s]
inline constexpr double kLowestTone = 110.0, kHighestTone = 880.0;  ///< at no force and at full force [Hz]
inline constexpr double kLoudestTone = 0.2;                         ///< of what a sample can hold
inline constexpr double kToneFollows = 0.02;  ///< time constant with which it follows, without a click [s]

/// A sine whose phase never jumps. One thread calls all of it.
class ForceTone {
 public:
  /// The next samples, one channel. @param share of the full force, 0 to 1, on the logarithmic scale of the
  /// arrows; beyond it is cut, no number is none. Thread class: real-time.
  void fill(std::span<std::int16_t> samples, double share) noexcept;

 private:
  double share_ = 0.0;  // that it has come to
  double phase_ = 0.0;  // [turns]
};

/// Pitch of a share, as many octaves up as it is of three [Hz]. Thread class: real-time.
double tone_of(double share) noexcept;

}  // namespace fuai
