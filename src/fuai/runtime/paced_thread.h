// A thread that does a tick as often as real time asks, slower where the machine cannot follow.
// SPDX-License-Identifier: Apache-2.0
//
//   tick due               tick(), due += period / speed, sleep until then, never longer than kLongestSleep
//
//   nothing to do          (tick() said so) ask again soon
//
//   later than kMostDebt   the debt is forgotten, and what runs in it has become slower; nothing freezes and
//                          nothing races to catch up
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>

namespace fuai {

/// When to do the next tick; time is an argument. Thread class: real-time.
class Pace {
 public:
  static constexpr double kMostDebt_us = 50e3;     ///< three pictures of a screen
  static constexpr double kLongestSleep_us = 2e3;  ///< how late a command may be seen
  static constexpr double kLeastSpeed = 0.1, kMostSpeed = 2.0;

  /// @param period_s of simulated time that a tick covers [s], > 0  @param now_us time on any clock [us]
  Pace(double period_s, double now_us) noexcept;

  bool due(double now_us) const noexcept { return now_us >= due_us_; }
  /// When to look again [us].
  double wake_us(double now_us) const noexcept;
  /// After a tick, or a vain attempt. @param did whether there was a tick  @param speed simulated over real
  /// time, clamped to its range
  void done(double now_us, bool did, double speed) noexcept;

  std::int64_t ticks() const noexcept { return ticks_; }
  /// Simulated over real time in the last second, in steps of a quarter [-].
  double real_time_factor() const noexcept { return factor_; }

 private:
  struct Mark {
    double at_us = 0.0;
    std::int64_t ticks = 0;
  };
  double period_us_;
  double due_us_;
  std::int64_t ticks_ = 0;
  std::array<Mark, 4> marks_;  // the last quarters of a second, in a ring
  std::size_t oldest_ = 0;
  double factor_ = 0.0;
};

/// The thread. It runs from construction to destruction, which waits for the tick that is being done.
class PacedThread {
 public:
  /// @param tick does a tick and says so, or false when there is nothing to do; called by the thread; it must
  /// not throw  @param period_s of simulated time that a tick covers [s], > 0
  /// @throws Error (kUsage) for another period. Thread class: set-up.
  PacedThread(std::function<bool()> tick, double period_s);
  ~PacedThread();
  PacedThread(const PacedThread&) = delete;
  PacedThread& operator=(const PacedThread&) = delete;

  /// Simulated over real time asked for, clamped to Pace::kLeastSpeed and kMostSpeed. Thread class: any.
  void set_speed(double speed) noexcept;
  double speed() const noexcept { return speed_.load(std::memory_order_relaxed); }
  std::int64_t ticks() const noexcept {
    return ticks_.load(std::memory_order_relaxed);
  }  ///< Thread class: any.
  /// Since construction [s]. Thread class: any.
  double wall_seconds() const noexcept;
  /// As Pace::real_time_factor(). Thread class: any.
  double real_time_factor() const noexcept { return factor_.load(std::memory_order_relaxed); }

  /// A clock that never goes back [us]. Thread class: any.
  static double now_us() noexcept;

 private:
  void run(const std::stop_token& stop, double period_s);

  std::function<bool()> tick_;
  double began_us_;
  std::atomic<double> speed_{1.0}, factor_{0.0};
  std::atomic<std::int64_t> ticks_{0};
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace fuai
