// The clock of a thread in real time: the one place where a session reads the time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fuai {

/// A clock that one thread uses.
class SessionClock {
 public:
  SessionClock() = default;
  SessionClock(const SessionClock&) = delete;
  SessionClock& operator=(const SessionClock&) = delete;
  virtual ~SessionClock() = default;
  /// Since some moment, the same for all clocks of a session [s]. Thread class: real-time.
  virtual double now() noexcept = 0;
  /// Returns at that time or later, at once when it has passed [s]. Thread class: real-time.
  virtual void sleep_until(double time) noexcept = 0;
};

/// CLOCK_MONOTONIC, sleeping to absolute times, so that no lateness adds up.
class MonotonicClock final : public SessionClock {
 public:
  double now() noexcept override;
  void sleep_until(double time) noexcept override;
};

}  // namespace fuai
