// Cleans measured branches.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/branch_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Branches may cross by this fraction of the peak stress (rms over the nodes) before the curve is refused:
/// the noise of the FAB force cell on a soft fabric is about 3 %.
constexpr double kCrossingTolerance = 0.05;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Range strain_range(std::span<const CurveSample> samples) {
  Range range;
  for (const CurveSample& s : samples) {
    range.low = std::min(range.low, s.strain);
    range.high = std::max(range.high, s.strain);
  }
  return range;
}

Range strain_range(const MeasuredCurve& curve) {
  Range range;
  for (const CurveBranch& branch : curve.branches) {
    const Range own = strain_range(branch.samples);
    range.low = std::min(range.low, own.low);
    range.high = std::max(range.high, own.high);
  }
  return range;
}

double peak_stress(const MeasuredCurve& curve) {
  double peak = 0.0;
  for (const CurveBranch& branch : curve.branches) {
    for (const CurveSample& s : branch.samples) peak = std::max(peak, std::abs(s.stress));
  }
  return peak;
}

/// Mean of the branches of one sense at every node; a branch that begins near zero strain as the first of the
/// curve is virgin and counts only where no other reaches.
std::vector<double> mean_branch(const MeasuredCurve& curve, bool rising, const Range& range,
                                std::size_t count, std::vector<std::string>& notes) {
  const double step = (range.high - range.low) / static_cast<double>(count - 1);
  std::vector<double> sum(count, 0.0), weight(count, 0.0);
  bool virgin_used = false;
  const auto add = [&](const CurveBranch& branch, bool only_gaps) {
    const Range own = strain_range(branch.samples);
    const std::vector<double> nodes = resample_monotone(branch.samples, range.low, range.high, count);
    for (std::size_t i = 0; i < count; ++i) {
      const double x = range.low + step * static_cast<double>(i);
      if (x < own.low - 0.5 * step || x > own.high + 0.5 * step || (only_gaps && weight[i] > 0.0)) continue;
      sum[i] += nodes[i];
      weight[i] += 1.0;
      virgin_used = virgin_used || only_gaps;
    }
  };
  const auto is_virgin = [&](std::size_t b) {
    return b == 0 &&
           std::abs(curve.branches[b].samples.front().strain) < 0.25 * std::max(range.high, -range.low);
  };
  for (std::size_t b = 0; b < curve.branches.size(); ++b) {
    if (rises(curve.branches[b]) == rising && !is_virgin(b)) add(curve.branches[b], false);
  }
  if (!curve.branches.empty() && is_virgin(0) && rises(curve.branches[0]) == rising)
    add(curve.branches[0], true);
  if (virgin_used) notes.emplace_back("part of the rising branch was measured only from the virgin state");
  std::vector<double> known_x, known;
  for (std::size_t i = 0; i < count; ++i) {
    if (weight[i] > 0.0) {
      known_x.push_back(range.low + step * static_cast<double>(i));
      known.push_back(sum[i] / weight[i]);
    }
  }
  if (known.size() < count / 2) {
    throw Error(ErrorKind::kBadInput,
                std::string("the ") + (rising ? "rising" : "falling") + " branch of the " +
                    to_string(curve.test) + " curve covers less than half of the loop",
                {curve.source, 0, 0, ""}, "give a whole cycle from turning point to turning point");
  }
  std::vector<CurveSample> joined(known.size());
  for (std::size_t i = 0; i < known.size(); ++i) joined[i] = {known_x[i], known[i]};
  return resample_monotone(std::move(joined), range.low, range.high, count);
}

/// Sets crossed nodes to their mean; refuses when they cross by more than noise.
void uncross(std::vector<double>& upper, std::vector<double>& lower, double peak, const MeasuredCurve& curve,
             std::vector<std::string>& notes) {
  double square = 0.0;
  std::size_t crossed = 0;
  for (std::size_t i = 0; i < upper.size(); ++i) {
    const double gap = upper[i] - lower[i];
    if (gap >= 0.0) continue;
    square += gap * gap;
    crossed += gap < -1e-12 * peak ? 1 : 0;
    upper[i] = lower[i] = 0.5 * (upper[i] + lower[i]);
  }
  const double rms = std::sqrt(square / static_cast<double>(upper.size()));
  if (rms > kCrossingTolerance * peak) {
    throw Error(ErrorKind::kBadInput,
                std::string("the branches of the ") + to_string(curve.test) + " curve (" +
                    to_string(curve.direction) + ") cross: recovery lies above loading",
                {curve.source, 0, 0, ""}, "check that the load and unload branches are not exchanged");
  }
  if (crossed > 0) {
    notes.emplace_back("branches crossed within noise at " + std::to_string(crossed) + " of " +
                       std::to_string(upper.size()) + " nodes; friction is zero there");
  }
}

}  // namespace

std::vector<double> isotonic(std::span<const double> values) {
  struct Block {
    double sum;
    std::size_t count;
    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Block> blocks;
  for (double v : values) {
    blocks.push_back({v, 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
      blocks[blocks.size() - 2].sum += blocks.back().sum;
      blocks[blocks.size() - 2].count += blocks.back().count;
      blocks.pop_back();
    }
  }
  std::vector<double> result;
  result.reserve(values.size());
  for (const Block& block : blocks) result.insert(result.end(), block.count, block.mean());
  return result;
}

std::vector<double> resample_monotone(std::vector<CurveSample> samples, double low, double high,
                                      std::size_t count) {
  if (samples.size() < 2) throw Error(ErrorKind::kBadInput, "a branch needs at least two samples");
  std::ranges::stable_sort(samples, {}, &CurveSample::strain);
  std::vector<double> x, y;
  for (const CurveSample& s : samples) {
    x.push_back(s.strain);
    y.push_back(s.stress);
  }
  y = isotonic(y);
  std::vector<double> nodes(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = low + (high - low) * static_cast<double>(i) / static_cast<double>(count - 1);
    const auto right = std::ranges::lower_bound(x, at);
    if (right == x.begin()) {
      nodes[i] = y.front();
    } else if (right == x.end()) {
      nodes[i] = y.back();
    } else {
      const auto k = static_cast<std::size_t>(right - x.begin());
      const double t = (at - x[k - 1]) / (x[k] - x[k - 1]);
      nodes[i] = y[k - 1] + t * (y[k] - y[k - 1]);
    }
  }
  return nodes;
}

bool is_two_sided(const MeasuredCurve& curve) {
  const Range range = strain_range(curve);
  return std::min(range.high, -range.low) > 0.25 * std::max(range.high, -range.low);
}

LoopNodes loop_nodes(const MeasuredCurve& curve, std::size_t count, std::vector<std::string>& notes) {
  Range range = strain_range(curve);
  LoopNodes nodes{range.low, range.high, {}, {}};
  nodes.up = mean_branch(curve, true, range, count, notes);
  nodes.down = mean_branch(curve, false, range, count, notes);
  const double peak = peak_stress(curve);
  // Tips: the branches must meet where the instrument turns. Half of each gap goes to each branch, fading
  // linearly.
  const double gap_low = nodes.up.front() - nodes.down.front(),
               gap_high = nodes.up.back() - nodes.down.back();
  if (std::max(std::abs(gap_low), std::abs(gap_high)) > 0.01 * peak) {
    notes.emplace_back("the tips of the loop did not meet (drift); the gaps of " +
                       std::to_string(std::lround(100.0 * std::abs(gap_low) / peak)) + " and " +
                       std::to_string(std::lround(100.0 * std::abs(gap_high) / peak)) +
                       " % of the peak were spread over the branches");
  }
  // Each branch keeps its own beginning; the drift is taken out towards its end.
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count - 1);
    const double drift = (1.0 - t) * gap_low + t * gap_high;
    nodes.up[i] -= t * drift;
    nodes.down[i] += (1.0 - t) * drift;
  }
  nodes.up = isotonic(nodes.up);
  nodes.down = isotonic(nodes.down);
  uncross(nodes.up, nodes.down, peak, curve, notes);
  return nodes;
}

VirginNodes virgin_nodes(const MeasuredCurve& curve, std::size_t count, std::vector<std::string>& notes) {
  std::vector<CurveSample> virgin, recovery;
  double reached = 0.0;
  for (const CurveBranch& branch : curve.branches) {
    if (rises(branch)) {
      const double before = reached;
      for (const CurveSample& s : branch.samples) {
        if (s.strain >= before) virgin.push_back(s);
        reached = std::max(reached, s.strain);
      }
    } else if (strain_range(branch.samples).high > 0.9 * reached) {
      recovery = branch.samples;
    }
  }
  if (virgin.size() < 2 || recovery.size() < 2 || !(reached > 0.0)) {
    throw Error(ErrorKind::kBadInput,
                std::string("the ") + to_string(curve.test) + " curve (" + to_string(curve.direction) +
                    ") has no loading or no recovery branch",
                {curve.source, 0, 0, ""}, "give the loading and the unloading of at least one cycle");
  }
  virgin.push_back({0.0, 0.0});
  // The clamps may still move a little while the load already falls: the loop ends at the largest strain of
  // both.
  reached = std::max(reached, strain_range(recovery).high);
  VirginNodes nodes{reached, resample_monotone(std::move(virgin), 0.0, reached, count),
                    resample_monotone(std::move(recovery), 0.0, reached, count)};
  const double peak = peak_stress(curve);
  // The recovery begins where the loading ended; a drop between the two samples falls into the last cell.
  const double drop = nodes.load.back() - nodes.recovery.back();
  if (std::abs(drop) > 0.05 * peak) {
    notes.emplace_back("the recovery begins " + std::to_string(std::lround(100.0 * drop / peak)) +
                       " % of the peak below the end of the loading; the drop is put into the last node");
  }
  nodes.recovery.back() = nodes.load.back();
  for (std::size_t i = 0; i < count; ++i) {
    nodes.load[i] = std::max(nodes.load[i], 0.0);
    if (curve.test == Test::kTensile)
      nodes.recovery[i] = std::max(nodes.recovery[i], 0.0);  // a strip cannot push
  }
  nodes.load.front() = 0.0;
  if (curve.test == Test::kTensile) nodes.recovery.front() = 0.0;
  nodes.load = isotonic(nodes.load);
  nodes.recovery = isotonic(nodes.recovery);
  uncross(nodes.load, nodes.recovery, peak, curve, notes);
  return nodes;
}

}  // namespace fuai
