// Signals as a flag: a session that is asked to stop ends by itself, with no force on the hand.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <csignal>

namespace fuai {

/// A signal that comes so soon after the first is the same wish [s]: Ctrl-C may arrive twice, and a session
/// needs a moment to take its force off the hand.
inline constexpr double kInterruptGrace = 0.5;

/// Takes SIGINT, SIGTERM and SIGHUP while it lives, SIGHUP only where nohup does not hold it off; one at a
/// time in a process. A signal later than kInterruptGrace after the first ends the process as ever.
class InterruptFlag {
 public:
  InterruptFlag();  ///< Thread class: set-up.
  ~InterruptFlag();
  InterruptFlag(const InterruptFlag&) = delete;
  InterruptFlag& operator=(const InterruptFlag&) = delete;
  /// Set by the first signal. Thread class: real-time.
  const std::atomic<bool>& flag() const noexcept;

 private:
  std::array<struct sigaction, 3> before_{};
};

}  // namespace fuai
