// Which hands the window believes to hold.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <memory>

#include "fuai/window/hand_book.h"
#include "fuai/window/viewer_work.h"

namespace {

using namespace fuai;

/// As the cloth's thread would tell it.
ViewSnapshot snapshot_at(std::int64_t tick, bool holds) {
  ViewSnapshot snapshot;
  snapshot.tick = tick;
  snapshot.cloths.resize(1);
  snapshot.cloths[0].hands[0].holds = holds;
  return snapshot;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("A hand outlives a snapshot from before it gripped, not a way back in time") {
    SceneOptions small;
    small.size = 5;
    const auto cloths =
        std::make_shared<ViewCloths>(make_view_setup("hanging_sheet", {"wool-tropical"}, small));
    ViewSession session(cloths);
    session.play(true);
    while (session.ticks() < 10) session.tick(0.0);
    HandBook hands;
    REQUIRE(hands.grab(session, 0, Vec2(0.01, 0.01), Vec3::Zero(), false) == 0);

    hands.follow(snapshot_at(8, false));  // made before, looked at after
    CHECK(hands.hand(0).active);
    hands.follow(snapshot_at(11, false));  // of the round that was under way
    CHECK(hands.hand(0).active);
    hands.follow(snapshot_at(12, true));
    CHECK(hands.hand(0).active);
    hands.follow(snapshot_at(8, false));  // back in time, where it did not hold
    CHECK_FALSE(hands.hand(0).active);
    hands.follow(snapshot_at(9, true));
    CHECK(hands.hand(0).active);
    hands.follow(snapshot_at(13, false));  // the session let go
    CHECK_FALSE(hands.hand(0).active);
  }
}
