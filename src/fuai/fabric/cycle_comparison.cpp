// Drives the law and adds up the differences.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/cycle_comparison.h"

#include <algorithm>
#include <cmath>

namespace fuai {

namespace {

/// Trapezoidal integral of stress over strain along consecutive branches, closed from the last to the first.
double loop_area(const std::vector<CurveBranch>& branches, std::size_t first, std::size_t end) {
  double area = 0.0;
  const CurveSample start = branches[first].samples.front();
  CurveSample last = start;
  const auto add = [&](const CurveSample& next) {
    area += 0.5 * (last.stress + next.stress) * (next.strain - last.strain);
    last = next;
  };
  for (std::size_t k = first; k < end; ++k) {
    for (const CurveSample& s : branches[k].samples) add(s);
  }
  add(start);
  return area;
}

CycleMisfit compare_one(const MeasuredCurve& measured, const MeasuredCurve& predicted, std::size_t first,
                        std::size_t end) {
  CycleMisfit misfit;
  double squares = 0.0, worst = 0.0, count = 0.0;
  for (std::size_t k = first; k < end; ++k) {
    for (std::size_t i = 0; i < measured.branches[k].samples.size(); ++i) {
      const CurveSample& s = measured.branches[k].samples[i];
      const double difference = predicted.branches[k].samples[i].stress - s.stress;
      squares += difference * difference;
      worst = std::max(worst, std::abs(difference));
      count += 1.0;
      misfit.peak_strain = std::max(misfit.peak_strain, std::abs(s.strain));
      misfit.peak_stress = std::max(misfit.peak_stress, std::abs(s.stress));
    }
  }
  if (misfit.peak_stress > 0.0) {
    misfit.rms_fraction = std::sqrt(squares / count) / misfit.peak_stress;
    misfit.max_fraction = worst / misfit.peak_stress;
  }
  misfit.measured_loop_area = loop_area(measured.branches, first, end);
  misfit.predicted_loop_area = loop_area(predicted.branches, first, end);
  return misfit;
}

}  // namespace

CycleComparison compare_cycles(const PlayLaw& law, const MeasuredCurve& curve) {
  MeasuredCurve measured = curve;
  std::erase_if(measured.branches, [](const CurveBranch& b) { return b.samples.empty(); });
  CycleComparison result;
  result.predicted = measured;
  PlayState state;
  for (CurveBranch& branch : result.predicted.branches) {
    for (CurveSample& s : branch.samples) s.stress = law.advance(s.strain, state).stress;
  }
  const std::size_t n = measured.branches.size();
  for (std::size_t first = 0; first < n;) {
    std::size_t end = first + 1;
    while (end < n && measured.branches[end].kind != Branch::kLoad) ++end;
    result.cycles.push_back(compare_one(measured, result.predicted, first, end));
    result.cycles.back().cycle = static_cast<int>(result.cycles.size()) - 1;
    first = end;
  }
  return result;
}

double rms_over_peak(const MeasuredCurve& curve, const MeasuredCurve& reference) noexcept {
  double square = 0.0, count = 0.0, peak = 0.0;
  for (std::size_t k = 0; k < reference.branches.size(); ++k) {
    for (std::size_t i = 0; i < reference.branches[k].samples.size(); ++i) {
      const double expected = reference.branches[k].samples[i].stress;
      square += std::pow(curve.branches[k].samples[i].stress - expected, 2);
      peak = std::max(peak, std::abs(expected));
      count += 1.0;
    }
  }
  return peak > 0.0 ? std::sqrt(square / count) / peak : 0.0;
}

}  // namespace fuai
