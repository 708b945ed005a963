// Counts allocations of the current thread, to prove that real-time code makes none.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace fuai_test {

/// Allocations (operator new and malloc through it) made by this thread so far.
std::size_t allocation_count() noexcept;

/// Allocations since construction.
class AllocationGuard {
 public:
  AllocationGuard() : start_(allocation_count()) {}
  std::size_t count() const { return allocation_count() - start_; }

 private:
  std::size_t start_;
};

}  // namespace fuai_test
