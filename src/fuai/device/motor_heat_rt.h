// How warm a device's motors are, and what force they may still give.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Thermal budget".
#pragma once

#include <algorithm>
#include <cmath>

namespace fuai {

/// Mean square of the force, forgotten with a time constant: heat goes with the square of the current.
///
///   h' = (F^2 - h) / tau;  most force: the peak up to h = 0.8 Fc^2, from there straight down to Fc at Fc^2
///
/// So h never exceeds Fc^2: at the limit no more than Fc is let through.
class MotorHeat {
 public:
  /// @param peak [N] @param continuous [N], > 0 @param time_constant [s], > 0. Thread class: any.
  MotorHeat(double peak, double continuous, double time_constant) noexcept
      : peak_(peak), continuous_(std::min(continuous, peak)), time_constant_(time_constant) {}

  /// @return the largest force that is allowed now [N]. Thread class: real-time.
  double most_force() const noexcept {
    const double share = std::clamp((1.0 - used()) / (1.0 - kBegin), 0.0, 1.0);
    return continuous_ + (peak_ - continuous_) * share;
  }
  /// @param force that was given [N] @param dt for so long [s]. Thread class: real-time.
  void advance(double force, double dt) noexcept {
    heat_ += (1.0 - std::exp(-dt / time_constant_)) * (force * force - heat_);
  }
  /// Share of the budget that is used, 0 to 1. Thread class: real-time.
  double used() const noexcept { return heat_ / (continuous_ * continuous_); }

 private:
  /// Share of the budget from which on the peak goes down: a fifth, so that the hand feels no edge.
  static constexpr double kBegin = 0.8;
  double peak_, continuous_, time_constant_;
  double heat_ = 0.0;  // [N2]
};

}  // namespace fuai
