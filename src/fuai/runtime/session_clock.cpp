// The system's monotonic clock.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/session_clock.h"

#include <cerrno>
#include <cmath>
#include <ctime>

namespace fuai {

double MonotonicClock::now() noexcept {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void MonotonicClock::sleep_until(double time) noexcept {
  timespec until{};
  const double whole = std::floor(time);
  until.tv_sec = static_cast<std::time_t>(whole);
  until.tv_nsec = static_cast<long>(1e9 * (time - whole));
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace fuai
