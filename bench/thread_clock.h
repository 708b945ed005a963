// Time of this thread on its core, and the spread of repeated measurements.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "fuai/runtime/thread_clock.h"

namespace fuai_bench {

using fuai::thread_seconds;

/// Median and the two deciles of repeated measurements.
struct Spread {
  double p10 = 0.0, median = 0.0, p90 = 0.0;
};

/// @param samples any order; empty gives zeros. Thread class: set-up.
inline Spread spread(std::vector<double> samples) {
  if (samples.empty()) return {};
  std::sort(samples.begin(), samples.end());
  const auto at = [&](double share) {
    return samples[static_cast<std::size_t>(share * static_cast<double>(samples.size() - 1) + 0.5)];
  };
  return {at(0.1), at(0.5), at(0.9)};
}

}  // namespace fuai_bench
