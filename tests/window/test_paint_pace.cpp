// How often the window paints.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include "fuai/window/paint_pace.h"

namespace {

using namespace fuai;

/// Pictures in so many seconds, each of which takes some time to paint. @param from, seconds, painting [s]
int pictures(PaintPace& pace, double seconds, double painting, bool goes_on, double from = 0.0) {
  int count = 0;
  double now = from;
  while (now < from + seconds) {
    if (goes_on) pace.wake();
    const double wait = pace.due_in(now);
    if (wait > 0.0) {
      now += wait < 1e-3 ? wait : 1e-3;
      continue;
    }
    pace.begin(now);
    ++count;
    now += painting;
  }
  return count;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("What goes on is painted as often as the screen shows it") {
    PaintPace quick(60.0), fine(144.0);
    CHECK(pictures(quick, 10.0, 0.001, true) >= 600);
    CHECK(pictures(quick, 10.0, 0.001, true, 20.0) <= 608);  // 1 % more, and the first: rates are rounded
    CHECK(pictures(fine, 10.0, 0.001, true) >= 1440);
    CHECK(pictures(fine, 10.0, 0.001, true, 20.0) <= 1456);
  }

  TEST_CASE("A slow driver paints one picture after the other") {
    PaintPace pace(60.0);
    CHECK(pictures(pace, 10.0, 0.125, true) == 80);
  }

  TEST_CASE("Where nothing changes only what is left is painted, and an event at once") {
    PaintPace pace(60.0);
    CHECK(pictures(pace, 10.0, 0.001, false) == PaintPace::kSettling);
    CHECK(pace.at_rest());
    CHECK(pace.due_in(10.0) == PaintPace::kNever);
    pace.wake(1);
    CHECK(pace.due_in(10.0) <= 0.0);
    pace.begin(10.0);
    CHECK(pace.at_rest());
    pace.wake();
    pace.wake(1);  // takes nothing away
    CHECK(pictures(pace, 10.0, 0.001, false, 11.0) == PaintPace::kSettling);
  }

  TEST_CASE("A picture that follows an event at once does not come faster than the screen") {
    PaintPace pace(60.0);
    pace.begin(1.0);
    CHECK(pace.due_in(1.001) > 0.0);
    CHECK(pace.due_in(1.001) < 1.0 / 60.0);
  }

  TEST_CASE("Out of sight it looks after things ten times a second") {
    PaintPace pace(60.0);
    pace.hide(true);
    CHECK(pictures(pace, 10.0, 0.001, true) <= 102);  // 1 % more, and the first
  }
}
