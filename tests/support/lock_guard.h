// Counts locks that the current thread takes, to prove that real-time code takes none.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace fuai_test {

/// Mutexes and read-write locks that this thread took or tried to take so far; who waits for a condition
/// takes its mutex first. Stays 0 under the thread sanitizer, which needs these functions for itself.
std::size_t lock_count() noexcept;

/// Whether they are counted.
bool counts_locks() noexcept;

/// Locks since construction.
class LockGuard {
 public:
  LockGuard() : start_(lock_count()) {}
  std::size_t count() const { return lock_count() - start_; }

 private:
  std::size_t start_;
};

}  // namespace fuai_test
