// One progress of tasks that run side by side.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "fuai/core/progress.h"

namespace fuai {

/// The mean of what the tasks report, passed on one call at a time. Must outlive what of() returns.
class SharedProgress {
 public:
  /// @param out may be empty  @param count of tasks. Thread class: set-up.
  SharedProgress(const Progress& out, std::size_t count) : out_(out), fractions_(count, 0.0) {}

  /// The progress of one task, to be called on any thread; empty when `out` is. Thread class: set-up.
  /// @param name shown instead of what the task says
  Progress of(std::size_t task, const std::string& name);

 private:
  const Progress& out_;
  std::vector<double> fractions_;
  std::mutex mutex_;
};

}  // namespace fuai
