// The pace in virtual time; the thread starts, ticks and stops.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/paced_thread.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>

#include "fuai/core/error.h"

using namespace fuai;

namespace {

constexpr double kPeriod = 1e-3;

/// Runs a pace for some virtual seconds, each tick costing so much. @return ticks done
std::int64_t run(Pace& pace, double& now_us, double seconds, double cost_us, double speed,
                 bool plays = true) {
  const std::int64_t before = pace.ticks();
  const double end = now_us + 1e6 * seconds;
  while (now_us < end) {
    if (!pace.due(now_us)) {
      now_us = pace.wake_us(now_us);
      continue;
    }
    if (plays) now_us += cost_us;
    pace.done(now_us, plays, speed);
  }
  return pace.ticks() - before;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("real time, whatever the speed, while the machine can follow") {
    double now = 5e6;
    Pace pace(kPeriod, now);
    for (double speed : {1.0, 0.1, 2.0, 0.5}) {
      CAPTURE(speed);
      // One tick more or less at the ends.
      CHECK(std::abs(static_cast<double>(run(pace, now, 3.0, 200.0, speed)) - 3000.0 * speed) <= 1.0);
      CHECK(pace.real_time_factor() == doctest::Approx(speed).epsilon(0.01));
    }
    // Beyond the range it is the range that counts.
    CHECK(std::abs(static_cast<double>(run(pace, now, 1.0, 100.0, 7.0)) - 2000.0) <= 1.0);
  }

  TEST_CASE("too slow a machine: the simulation becomes slower, and does not race afterwards") {
    double now = 0.0;
    Pace pace(kPeriod, now);
    CHECK(run(pace, now, 4.0, 4000.0, 1.0) == 1000);
    CHECK(pace.real_time_factor() == doctest::Approx(0.25).epsilon(0.02));
    // Fast again: of four seconds' debt at most 50 ms are made up for.
    const auto after = static_cast<double>(run(pace, now, 1.0, 10.0, 1.0));
    CHECK(after >= 999.0);
    CHECK(after <= 1000.0 + Pace::kMostDebt_us * 1e-3 + 1.0);
  }

  TEST_CASE("a short delay is made up for") {
    double now = 0.0;
    Pace pace(kPeriod, now);
    run(pace, now, 1.0, 10.0, 1.0);
    now += 30e3;
    CHECK(std::abs(static_cast<double>(pace.ticks() + run(pace, now, 1.0, 10.0, 1.0)) - 2030.0) <= 31.0);
    CHECK(pace.ticks() >= 2029);
  }

  TEST_CASE("it looks at least every 2 ms, also when it is slow or has nothing to do") {
    double now = 0.0;
    Pace pace(kPeriod, now);
    pace.done(now, true, 0.1);  // next tick in 10 ms
    CHECK(!pace.due(now));
    CHECK(pace.wake_us(now) <= now + 2e3);
    CHECK(run(pace, now, 1.0, 0.0, 0.1, false) == 0);
    CHECK(pace.wake_us(now) <= now + 2e3);
    // Back from a pause there is no debt.
    now += 1e6;
    CHECK(run(pace, now, 0.5, 10.0, 1.0) <= 500 + 51);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("the thread ticks, counts what was done, and ends with its object") {
    std::atomic<int> calls{0};
    {
      PacedThread thread([&] { return calls.fetch_add(1) % 2 == 0; }, 1e-4);
      thread.set_speed(100.0);
      CHECK(thread.speed() == Pace::kMostSpeed);
      while (thread.ticks() < 50) std::this_thread::yield();
      CHECK(thread.wall_seconds() > 0.0);
    }
    const int ended = calls.load();
    CHECK(ended >= 99);  // every second call did something
    std::this_thread::yield();
    CHECK(calls.load() == ended);
  }

  TEST_CASE("a period that is none is refused") {
    CHECK_THROWS_AS(PacedThread([] { return false; }, 0.0), Error);
  }
}
