// Collects the progress of tasks.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/shared_progress.h"

#include <numeric>
#include <string_view>

namespace fuai {

Progress SharedProgress::of(std::size_t task, const std::string& name) {
  if (!out_) return {};
  return [this, task, name](std::string_view, double fraction) {
    const std::scoped_lock lock(mutex_);
    fractions_[task] = fraction;
    out_(name,
         std::accumulate(fractions_.begin(), fractions_.end(), 0.0) / static_cast<double>(fractions_.size()));
  };
}

}  // namespace fuai
