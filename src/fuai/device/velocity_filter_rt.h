// Velocity from positions that come in steps of an encoder.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Velocity".
#pragma once

#include <cmath>
#include <numbers>

#include "fuai/core/types.h"

namespace fuai {

/// Difference quotient behind a low-pass of first order: v += (1 - exp(-2 pi fc dt)) ((x - x') / dt - v).
class VelocityFilter {
 public:
  /// @param cutoff fc [Hz]; 100 Hz keeps a step of 55 um at 1 kHz below 26 mm/s and lags by 1.6 ms
  explicit VelocityFilter(double cutoff = 100.0) noexcept : cutoff_(cutoff) {}

  /// The next position is the first: velocity zero. Thread class: real-time.
  void restart() noexcept { started_ = false; }
  /// @param position [m] @param dt since the last one [s]; without time the velocity stays.
  /// Thread class: real-time.
  const Vec3& update(const Vec3& position, double dt) noexcept {
    if (!started_)
      velocity_ = Vec3::Zero();
    else if (dt > 0.0) {
      const double gain = 1.0 - std::exp(-2.0 * std::numbers::pi * cutoff_ * dt);
      velocity_ += gain * ((position - position_) / dt - velocity_);
    }
    if (!started_ || dt > 0.0) position_ = position;
    started_ = true;
    return velocity_;
  }
  const Vec3& velocity() const noexcept { return velocity_; }  ///< [m/s]. Thread class: real-time.

 private:
  double cutoff_;
  bool started_ = false;
  Vec3 position_ = Vec3::Zero(), velocity_ = Vec3::Zero();
};

}  // namespace fuai
