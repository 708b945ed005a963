// Keeps the pace.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/paced_thread.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "fuai/core/error.h"

namespace fuai {
namespace {

using Clock = std::chrono::steady_clock;
using Microseconds = std::chrono::duration<double, std::micro>;
constexpr double kSecond_us = 1e6;

}  // namespace

Pace::Pace(double period_s, double now_us) noexcept : period_us_(period_s * kSecond_us), due_us_(now_us) {
  marks_.fill({now_us, 0});
}

double Pace::wake_us(double now_us) const noexcept { return std::min(due_us_, now_us + kLongestSleep_us); }

void Pace::done(double now_us, bool did, double speed) noexcept {
  const double step_us = period_us_ / std::clamp(speed, kLeastSpeed, kMostSpeed);
  if (did) {
    ++ticks_;
    due_us_ += step_us;
    if (now_us - due_us_ > kMostDebt_us) due_us_ = now_us;
  } else {
    due_us_ = now_us + std::min(step_us, kLongestSleep_us);
  }
  // The oldest of four marks is a second old when the newest is three quarters old.
  const Mark& oldest = marks_[oldest_];
  const Mark& newest = marks_[(oldest_ + marks_.size() - 1) % marks_.size()];
  if (now_us - newest.at_us < kSecond_us / static_cast<double>(marks_.size())) return;
  factor_ = static_cast<double>(ticks_ - oldest.ticks) * period_us_ / (now_us - oldest.at_us);
  marks_[oldest_] = {now_us, ticks_};
  oldest_ = (oldest_ + 1) % marks_.size();
}

double PacedThread::now_us() noexcept { return Microseconds(Clock::now().time_since_epoch()).count(); }

PacedThread::PacedThread(std::function<bool()> tick, double period_s)
    : tick_(std::move(tick)), began_us_(now_us()) {
  if (!(period_s > 0.0)) throw Error(ErrorKind::kUsage, "the period of a paced thread must be positive");
  thread_ = std::jthread([this, period_s](const std::stop_token& stop) { run(stop, period_s); });
}

PacedThread::~PacedThread() = default;

void PacedThread::set_speed(double speed) noexcept {
  speed_.store(std::clamp(speed, Pace::kLeastSpeed, Pace::kMostSpeed), std::memory_order_relaxed);
}

double PacedThread::wall_seconds() const noexcept { return (now_us() - began_us_) / kSecond_us; }

void PacedThread::run(const std::stop_token& stop, double period_s) {
  Pace pace(period_s, now_us());
  while (!stop.stop_requested()) {
    const double now = now_us();
    if (!pace.due(now)) {
      const Microseconds wake(pace.wake_us(now));
      std::this_thread::sleep_until(Clock::time_point(std::chrono::duration_cast<Clock::duration>(wake)));
      continue;
    }
    const bool did = tick_();
    pace.done(now_us(), did, speed());
    ticks_.store(pace.ticks(), std::memory_order_relaxed);
    factor_.store(pace.real_time_factor(), std::memory_order_relaxed);
  }
}

}  // namespace fuai
