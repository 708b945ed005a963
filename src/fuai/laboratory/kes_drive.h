// Moves an instrument along its path and records the curve.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fuai/core/progress.h"
#include "fuai/fabric/measured_curve.h"

namespace fuai {

/// A partial reversal on the way to the first stop: out to one strain, back to another.
struct KesReversal {
  double out = 0.0, back = 0.0;  ///< [unit of strain]
};

/// Goes straight to a strain, commits, and reads. @return false when the cloth did not come to rest; it is
/// then where it was.
using KesMove = std::function<bool(double strain, CurveSample& sample)>;

/// Strains at which the motion turns: the reversals, then the stops.
std::vector<double> turning_points(std::span<const KesReversal> reversals, std::span<const double> stops);

/// Records branches.
class KesRecorder {
 public:
  /// @param start where the motion begins
  explicit KesRecorder(const CurveSample& start) : at_(start) {}

  /// A new branch, from the last sample on. @param kind Branch::kLoad away from zero, Branch::kUnload towards
  /// it
  void begin(Branch kind) { branches_.push_back({kind, {at_}}); }
  void add(const CurveSample& sample) {
    branches_.back().samples.push_back(sample);
    at_ = sample;
  }
  const CurveSample& last() const noexcept { return at_; }
  /// The whole recording of a test.
  MeasuredCurve take(Test test, Direction direction) { return {test, direction, std::move(branches_), {}}; }

 private:
  CurveSample at_;
  std::vector<CurveBranch> branches_;
};

/// Drives from the recorder's last strain from turning point to turning point in equal steps, a new branch
/// at each and at zero. A move that fails is done in halves, down to 1/64 of it.
/// @param step longest [unit of strain]
/// @throws Error (kCheckFailed) when the cloth does not come to rest. Thread class: set-up.
void drive(std::span<const double> turns, double step, const KesMove& move, KesRecorder& recorder,
           const Progress& progress = {});

/// One move, in halves where it fails; only the end is recorded.
void move_in_parts(double from, double to, const KesMove& move, CurveSample& sample, int halvings = 6);

}  // namespace fuai
