// What a process asks the system for to be in time: a place before all others, and memory that stays.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace fuai {

/// Puts the calling thread before all ordinary ones (SCHED_FIFO). @param priority 1 to 99
/// @return empty, or in one line why not and what to do. Thread class: set-up.
std::string claim_priority(int priority);

/// Keeps all memory of the process from being swapped out, as long as it lives.
class LockedMemory {
 public:
  /// Thread class: set-up.
  LockedMemory();
  ~LockedMemory();
  LockedMemory(const LockedMemory&) = delete;
  LockedMemory& operator=(const LockedMemory&) = delete;
  /// Empty, or in one line why not and what to do.
  const std::string& why_not() const noexcept { return why_not_; }

 private:
  std::string why_not_;
};

}  // namespace fuai
