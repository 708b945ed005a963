// The clock of drivers, which tests replace: when to try again, how long a link has been silent.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace fuai {

/// Seconds since some fixed moment, never going back. Thread class: real-time.
using DeviceClock = double (*)() noexcept;

/// The machine's. Thread class: real-time.
inline double steady_seconds() noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Says when it is time to try again.
class RetryTimer {
 public:
  /// Nothing before `pause` [s] has passed. Thread class: real-time.
  void wait(double now, double pause) noexcept { next_ = now + pause; }
  /// Thread class: real-time.
  bool due(double now) const noexcept { return now >= next_; }

 private:
  double next_ = 0.0;
};

}  // namespace fuai
