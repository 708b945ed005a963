// SIGINT and SIGTERM as a flag: a session that is asked to stop ends by itself, with no force on the hand.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>

#include <atomic>

namespace fuai {

/// Takes both signals while it lives; one at a time in a process. The same signal
/// a second time ends the process as ever.
class InterruptFlag {
 public:
  InterruptFlag();  ///< Thread class: set-up.
  ~InterruptFlag();
  InterruptFlag(const InterruptFlag&) = delete;
  InterruptFlag& operator=(const InterruptFlag&) = delete;
  /// Set by the first signal. Thread class: real-time.
  const std::atomic<bool>& flag() const noexcept;

 private:
  struct sigaction before_interrupt_ {};
  struct sigaction before_terminate_ {};
};

}  // namespace fuai
