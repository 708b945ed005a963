// Cuts, zeroes and scales the raw branches.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/fab_stretch.h"

#include <algorithm>
#include <cmath>

#include "fuai/core/error.h"
#include "fuai/units/constants.h"

namespace fuai {

namespace {

constexpr double kSlackMargin = 0.995;                // of the free length: surely slack below
constexpr double kTakeUpLoad = 0.5 * unit::kGfPerCm;  // [N/m]
constexpr double kCheckedLoad = 0.8;                  // of the lower peak

/// Mean and standard deviation of the slack samples of the first branch [N].
std::array<double, 2> slack_reading(const FabStripTest& strip) {
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (const FabSample& s : strip.branches.front()) {
    if (s.clamp_distance >= kSlackMargin * strip.length) continue;
    n += 1.0, sum += s.force;
  }
  if (n == 0.0) return {strip.branches.front().front().force, 0.0};
  for (const FabSample& s : strip.branches.front()) {
    if (s.clamp_distance < kSlackMargin * strip.length) squares += (s.force - sum / n) * (s.force - sum / n);
  }
  return {sum / n, std::sqrt(squares / n)};
}

/// The part of a branch with strain >= 0, with a sample at zero where it crosses.
std::vector<CurveSample> taut_part(const std::vector<CurveSample>& all) {
  std::vector<CurveSample> kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && (all[i - 1].strain < 0.0) != (all[i].strain < 0.0)) {
      const CurveSample &a = all[i - 1], &b = all[i];
      kept.push_back({0.0, a.stress - a.strain * (b.stress - a.stress) / (b.strain - a.strain)});
    }
    if (all[i].strain >= 0.0) kept.push_back(all[i]);
  }
  return kept;
}

/// First strain at which three samples in a row carry the take-up load.
double take_up(const std::vector<CurveSample>& load) {
  int row = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    row = load[i].stress >= kTakeUpLoad ? row + 1 : 0;
    if (row == 3) return load[i - 2].strain;
  }
  return load.back().strain;
}

double strain_at_load(const std::vector<CurveSample>& load, double stress) {
  for (std::size_t i = 1; i < load.size(); ++i) {
    const CurveSample &a = load[i - 1], &b = load[i];
    if (a.stress < stress && b.stress >= stress) {
      return a.strain + (b.strain - a.strain) * (stress - a.stress) / (b.stress - a.stress);
    }
  }
  return load.back().strain;
}

const std::vector<CurveSample>& last_load(const MeasuredCurve& curve) {
  const auto it = std::find_if(curve.branches.rbegin(), curve.branches.rend(),
                               [](const CurveBranch& b) { return b.kind == Branch::kLoad; });
  return it->samples;
}

}  // namespace

FabStretch make_fab_stretch(const FabRecord& record, Direction direction, FabTest test) {
  const FabStripTest& strip = record.strip(direction, test);
  if (strip.branches.empty() || strip.branches.front().size() < 2 || !(strip.width > 0.0) ||
      !(strip.length > 0.0)) {
    throw Error(
        ErrorKind::kBadInput,
        std::string("the stretch test ") + to_string(test) + " in " + to_string(direction) + " is missing",
        {record.source, 0, 0, "raw_data"});
  }
  FabStretch result;
  const auto [zero, noise] = slack_reading(strip);
  result.force_zero = zero;
  result.force_noise = noise / strip.width;
  result.curve.test = Test::kTensile;
  result.curve.direction = direction;
  result.curve.source = record.source;
  for (std::size_t k = 0; k < strip.branches.size(); ++k) {
    const double sense = k % 2 == 0 ? 1.0 : -1.0;
    std::vector<FabSample> raw = strip.branches[k];
    // The machine's turning sample stands in the next branch: it ends this one.
    if (!raw.empty() && k + 1 < strip.branches.size() && !strip.branches[k + 1].empty()) {
      const FabSample& next = strip.branches[k + 1].front();
      if (sense * (next.clamp_distance - raw.back().clamp_distance) > 0.0) raw.push_back(next);
    }
    std::vector<CurveSample> samples;
    samples.reserve(raw.size());
    for (const FabSample& s : raw) {
      samples.push_back({s.clamp_distance / strip.length - 1.0, (s.force - zero) / strip.width});
    }
    samples = taut_part(samples);
    if (samples.size() < 2) continue;
    for (const CurveSample& s : samples) {
      if (s.stress > result.peak_load) result.peak_load = s.stress, result.peak_strain = s.strain;
    }
    result.curve.branches.push_back({k % 2 == 0 ? Branch::kLoad : Branch::kUnload, std::move(samples)});
  }
  if (result.curve.branches.empty() || result.curve.branches.front().kind != Branch::kLoad) {
    throw Error(ErrorKind::kBadInput,
                std::string("the stretch test ") + to_string(test) + " in " + to_string(direction) +
                    " never stretches the strip beyond its free length",
                {record.source, 0, 0, "raw_data"});
  }
  result.take_up_strain = take_up(result.curve.branches.front().samples);
  return result;
}

FabClampCheck check_fab_clamps(const FabRecord& record, Direction direction) {
  const FabStretch longer = make_fab_stretch(record, direction, FabTest::kS2);
  const FabStretch shorter = make_fab_stretch(record, direction, FabTest::kS1);
  const double L2 = record.strip(direction, FabTest::kS2).length;
  const double L1 = record.strip(direction, FabTest::kS1).length;
  FabClampCheck check;
  check.load = kCheckedLoad * std::min(longer.peak_load, shorter.peak_load);
  check.strain_long = strain_at_load(last_load(longer.curve), check.load);
  check.strain_short = strain_at_load(last_load(shorter.curve), check.load);
  // strain = cloth + clamp / L in both tests: two equations.
  check.clamp_length = (check.strain_short - check.strain_long) / (1.0 / L1 - 1.0 / L2);
  check.strain_in_cloth = check.strain_long - check.clamp_length / L2;
  return check;
}

}  // namespace fuai
