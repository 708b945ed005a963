// Whose force the plots show.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <utility>

#include "fuai/window/viewer_state.h"
#include "fuai/window/viewer_work.h"

using namespace fuai;

namespace {

/// A window's state whose cloths go on by hand.
struct Stage {
  ViewerState state;
  double clock = 0.0;  // [us]

  explicit Stage(ViewSetup setup) : state(std::move(setup)) {
    begin_session(state);
    state.session->play(true);
  }
  void go_on(int ticks) {
    for (int i = 0; i < ticks; ++i) state.session->tick(clock += 1e6 * kViewStep);
    take_snapshot(state);
  }
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("The plots show the hand of a recording that is done again, from where it gripped") {
    constexpr std::uint8_t kHand = 3;
    Stage stage(make_view_setup("hanging_sheet", {"wool-tropical"}, {9, 0.02}));
    ViewerState& state = stage.state;
    ViewCommand grab;
    grab.kind = ViewCommand::Kind::kGrab;
    grab.hand = kHand;
    grab.material = Vec2(0.08, 0.08);
    const Vec3 begin = state.slot_positions(0)[40];  // the middle of 9 x 9
    grab.position = begin;
    REQUIRE(state.session->send(grab));
    stage.go_on(50);
    // Without a recording somebody else's hand is not the user's.
    CHECK(state.forces.back().hand == -1);

    state.replay.emplace();
    stage.go_on(50);
    CHECK(state.forces.back().hand == kHand);
    CHECK(state.forces.back().way == 0.0);
    ViewCommand move;
    move.hand = kHand;
    move.position = begin + Vec3(0.0, 0.03, 0.04);
    REQUIRE(state.session->send(move));
    stage.go_on(50);
    CHECK(state.forces.back().hand == kHand);
    CHECK(state.forces.back().way == doctest::Approx(0.05));
    CHECK(state.forces.back().forces.front() > 0.0);
  }

  TEST_CASE("The plots show the scene's own hand until the user takes hold") {
    ViewSetup setup = make_view_setup("taut_patch", {"wool-tropical"}, {17, 0.02});
    setup.scene_moves = true;
    Stage stage(std::move(setup));
    ViewerState& state = stage.state;
    for (int i = 0; i < 30; ++i) stage.go_on(10);
    double farthest = 0.0, strongest = 0.0;
    for (const ForceMoment& moment : state.forces) {
      if (moment.hand < 0) continue;  // it has not gripped yet
      CHECK(moment.hand == kSceneHand);
      farthest = std::max(farthest, moment.way);
      strongest = std::max(strongest, moment.forces.front());
    }
    // The scene pulls to the farthest place within a quarter of a second; the patch lags behind the hand.
    const SceneMotion& motion = *state.cloths->scene(0).motion;
    const double pull = (motion.hand(0, 0.25).position - motion.hand(0, 0.0).position).norm();
    CHECK(farthest == doctest::Approx(pull).epsilon(0.03));
    CHECK(strongest > 0.0);

    const Vec3 place = state.slot_positions(0)[150];
    CHECK(state.hands.grab(*state.session, 0, Vec2(0.16, 0.16), place, false) == 0);
    stage.go_on(20);
    CHECK(state.forces.back().hand == 0);
  }
}
