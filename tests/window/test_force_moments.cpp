// Whose force the plots show.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include "fuai/window/viewer_state.h"
#include "fuai/window/viewer_work.h"

TEST_SUITE("unit") {
  TEST_CASE("The plots show the hand of a recording that is done again, from where it gripped") {
    using namespace fuai;
    constexpr std::uint8_t kHand = 3;
    ViewerState state(make_view_setup("hanging_sheet", {"wool-tropical"}, {9, 0.02}));
    begin_session(state);
    double clock = 0.0;  // [us]
    const auto go_on = [&](int ticks) {
      for (int i = 0; i < ticks; ++i) state.session->tick(clock += 1e6 * kViewStep);
      take_snapshot(state);
    };
    state.session->play(true);
    ViewCommand grab;
    grab.kind = ViewCommand::Kind::kGrab;
    grab.hand = kHand;
    grab.material = Vec2(0.08, 0.08);
    const Vec3 begin = state.slot_positions(0)[40];  // the middle of 9 x 9
    grab.position = begin;
    REQUIRE(state.session->send(grab));
    go_on(50);
    // Without a recording somebody else's hand is not the user's.
    CHECK(state.forces.back().hand == -1);

    state.replay.emplace();
    go_on(50);
    CHECK(state.forces.back().hand == kHand);
    CHECK(state.forces.back().way == 0.0);
    ViewCommand move;
    move.hand = kHand;
    move.position = begin + Vec3(0.0, 0.03, 0.04);
    REQUIRE(state.session->send(move));
    go_on(50);
    CHECK(state.forces.back().hand == kHand);
    CHECK(state.forces.back().way == doctest::Approx(0.05));
    CHECK(state.forces.back().forces.front() > 0.0);
  }
}
