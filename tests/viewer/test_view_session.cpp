// The session: the same bits by whichever way, going back and forth, other cloths in between.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/view_session.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "fuai/core/error.h"
#include "fuai/runtime/paced_thread.h"
#include "fuai/runtime/spin_team.h"
#include "support/allocation_guard.h"
#include "viewer/small_table.h"

using namespace fuai;
using namespace fuai_test;

TEST_SUITE("unit") {
  TEST_CASE("a session begins paused, shows the start, and steps one by one") {
    Table table(small_setup());
    CHECK(table.session.snapshot().cloths.size() == 1);
    CHECK(table.session.snapshot().cloths[0].positions.size() == 81);
    for (int i = 0; i < 5; ++i) CHECK(!table.round());
    table.session.single_steps(3);
    CHECK(table.round());
    CHECK(table.round());
    CHECK(table.round());
    CHECK(!table.round());
    CHECK(table.session.ticks() == 3);
    for (int i = 0; i < 20; ++i) table.round();
    CHECK(table.session.fetch());
    CHECK(table.session.snapshot().tick == 3);
    CHECK(table.session.snapshot().time == doctest::Approx(0.003));
  }

  TEST_CASE("a hand holds, pulls with the engine's reaction, and lets go") {
    Table table(small_setup("hanging_sheet", 2));
    const Vec3 at(0.04, -0.05, 0.0);
    table.session.send(grab(5, {0.04, 0.03}, at));
    table.play_to(20);
    table.session.send(move(5, at + Vec3(0.0, 0.0, 0.03), 200));
    table.play_to(400);
    table.seek(400);
    for (const ClothView& cloth : table.session.snapshot().cloths) {
      CHECK(cloth.hands[5].holds);
      CHECK(cloth.targets[5] == Vec3(at + Vec3(0.0, 0.0, 0.03)));  // the last step lands on the goal
      // Held up: the cloth pulls down with a part of its weight. 64 cm2 of a few hundred g/m2 weigh 10 mN.
      CHECK(cloth.hands[5].force.z() < -1e-4);
      CHECK(cloth.probed);
      CHECK(!cloth.hands[4].holds);
    }
    table.session.send(plain(Kind::kRelease, 5));
    table.play_to(440);
    table.session.fetch();
    CHECK(!table.session.snapshot().cloths[0].hands[5].holds);
    CHECK(!table.session.snapshot().cloths[0].probed);
  }

  TEST_CASE("fields come when they are asked for, and go") {
    Table table(small_setup());
    table.session.show_field(static_cast<int>(ClothField::kSpeed));
    table.play_to(50);
    table.session.fetch();
    REQUIRE(table.session.snapshot().cloths[0].field.size() == 81);
    const std::vector<double>& speed = table.session.snapshot().cloths[0].field;
    CHECK(*std::max_element(speed.begin(), speed.end()) >
          0.05);  // falling for 50 ms: 0.4 m/s at the free edge
    table.session.show_field(-1);
    for (int i = 0; i < 20; ++i) table.round();
    table.session.fetch();
    CHECK(table.session.snapshot().cloths[0].field.empty());
  }

  TEST_CASE("nonsense is not done and not recorded") {
    Table table(small_setup());
    std::vector<ViewEvent> events;
    gather(table.session, events);
    table.session.send(move(2, Vec3::Zero()));     // holds nothing
    table.session.send(plain(Kind::kRelease, 2));  // the same
    table.session.send(grab(99, {0, 0}, Vec3::Zero()));
    table.session.send(grab(1, {0, 0}, Vec3::Constant(std::numeric_limits<double>::quiet_NaN())));
    table.round();
    events.clear();
    gather(table.session, events);
    CHECK(events.empty());
  }

  TEST_CASE("too few and too many fabrics, and the paper's scenes, are refused") {
    CHECK_THROWS_AS(cloths_of(small_setup("hanging_sheet", 0)), Error);
    CHECK_THROWS_AS(cloths_of(small_setup("hanging_sheet", 5)), Error);
    CHECK_THROWS_AS(cloths_of(small_setup("paper_drape")), Error);
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("back and forth: the same bits as straight on") {
    ViewSetup setup = small_setup("grasp_and_lift");
    Table straight(setup), wandering(setup);
    straight.handle(0, 1300);
    wandering.handle(0, 1300);
    const std::uint64_t end = straight.session.state_hash();
    REQUIRE(wandering.session.state_hash() == end);
    // Back over several kept states, forth in two leaps, once to the beginning.
    for (const std::int64_t to : {700, 490, 500, 510, 120, 1250, 10, 1300}) {
      CAPTURE(to);
      wandering.seek(to);
      CHECK(wandering.session.state_hash() == straight.hashes.at(to));
    }
    CHECK(wandering.session.state_hash() == end);
    // And on from there, with all holds.
    straight.play_to(1450);
    wandering.play_to(1450);
    CHECK(wandering.session.state_hash() == straight.session.state_hash());
    std::vector<ViewEvent> a, b;
    gather(straight.session, a);
    gather(wandering.session, b);
    CHECK(a.size() == b.size());
  }

  TEST_CASE("each of several steps back and forth between two rounds counts") {
    Table table(small_setup());
    table.handle(0, 800);
    table.session.play(false);
    const auto after = [&](const char* keys) {
      table.seek(700);
      for (const char* key = keys; *key != 0; ++key) {
        if (*key == '<') table.session.step_back(1);
        if (*key == '>') table.session.single_steps(1);
        if (*key == 'L') table.session.step_back(100);
      }
      for (int i = 0; i < 200; ++i) table.round();
      if (const auto known = table.hashes.find(table.session.ticks()); known != table.hashes.end())
        CHECK(table.session.state_hash() == known->second);
      return table.session.ticks();
    };
    CHECK(after("<") == 699);
    CHECK(after("<<<") == 697);
    CHECK(after("<<><") == 698);
    CHECK(after(">><") == 701);
    CHECK(after("><<<") == 698);
    CHECK(after("LLL") == 400);
    CHECK(after("LLLLLLLLLL") == table.session.snapshot().first_tick);
    // Where nothing was done yet, steps that wait are taken back.
    table.seek(800);
    table.session.single_steps(5);
    table.session.step_back(2);
    for (int i = 0; i < 10; ++i) table.round();
    CHECK(table.session.ticks() == 803);
  }

  TEST_CASE("going back and doing something else is as if it had been done so at once") {
    const ViewSetup setup = small_setup();
    Table regretful(setup);
    regretful.handle(0, 800);
    std::vector<ViewEvent> events, expected;
    gather(regretful.session, events);
    // Looking around alone forgets nothing.
    regretful.seek(299);
    regretful.session.single_steps(1);
    regretful.round();
    CHECK(regretful.session.ticks() == 300);
    CHECK(regretful.session.snapshot().newest_tick == 800);
    regretful.seek(290);
    Table again(setup);
    again.handle(0, 290);
    for (Table* table : {&again, &regretful}) {
      table->session.send(plain(Kind::kRelease, 0));
      table->play_to(900);
    }
    // At 290 the first had moved the hand besides; both then let it go, so that the move says nothing.
    CHECK(regretful.session.state_hash() == again.session.state_hash());
    gather(regretful.session, events);
    gather(again.session, expected);
    const auto late = [](const std::vector<ViewEvent>& all) {
      return std::count_if(all.begin(), all.end(), [](const ViewEvent& e) { return e.tick > 290; });
    };
    CHECK(late(events) == late(expected));
  }

  TEST_CASE("the events, done at their ticks in a fresh session, give the same hashes") {
    const ViewSetup setup = small_setup("hanging_sheet", 2);
    Table first(setup), second(setup);
    first.handle(0, 420);
    std::vector<ViewEvent> events, repeated;
    gather(first.session, events);
    for (const ViewEvent& event : events) {
      if (event.kind != ViewEvent::Kind::kCommand) continue;
      second.play_to(event.tick);
      second.session.send(event.command);
    }
    second.play_to(420);
    gather(second.session, repeated);
    REQUIRE(events.size() == repeated.size());
    int hashes = 0;
    for (std::size_t i = 0; i < events.size(); ++i) {
      CHECK(events[i].tick == repeated[i].tick);
      CHECK(events[i].hash == repeated[i].hash);
      hashes += events[i].kind == ViewEvent::Kind::kHash ? 1 : 0;
    }
    CHECK(hashes == 5);
    CHECK(second.session.state_hash() == first.session.state_hash());
  }

  TEST_CASE("a team gives the same bits") {
    const ViewSetup setup = small_setup("hanging_sheet", 3);
    SpinTeam team(2);
    Table alone(setup), shared(setup, &team);
    alone.handle(0, 200);
    shared.handle(0, 200);
    CHECK(alone.session.state_hash() == shared.session.state_hash());
  }
}

TEST_SUITE("unit") {
  TEST_CASE("other cloths of the same cut take over shape and holds; of another one they begin anew") {
    ViewSetup setup = small_setup();
    Table table(setup);
    const Vec3 at(0.04, -0.05, 0.0);
    table.session.send(grab(1, {0.04, 0.03}, at));
    table.play_to(150);
    table.seek(150);
    const std::vector<Vec3> before = table.session.snapshot().cloths[0].positions;

    setup.fabrics[0].factors[static_cast<std::size_t>(FabricFactor::kShear)] = 2.0;
    setup.fabrics.push_back(setup.fabrics[0]);
    const std::uint64_t build = table.session.replace(cloths_of(setup), true);
    table.round();
    table.session.fetch();
    const ViewSnapshot& kept = table.session.snapshot();
    CHECK(kept.build == build);
    CHECK(kept.tick == 150);
    CHECK(kept.first_tick == 150);
    REQUIRE(kept.cloths.size() == 2);
    for (const ClothView& cloth : kept.cloths) {
      CHECK(cloth.hands[1].holds);
      CHECK(cloth.targets[1] == at);
      CHECK(cloth.positions == before);
    }
    table.play_to(200);

    setup.size.size = 11;
    table.session.replace(cloths_of(setup), true);
    table.round();
    table.session.fetch();
    CHECK(table.session.snapshot().cloths[0].positions.size() == 121);
    CHECK(!table.session.snapshot().cloths[0].hands[1].holds);
    CHECK(table.session.snapshot().time == 0.0);
    std::vector<ViewEvent> events;
    gather(table.session, events);
    CHECK(std::count_if(events.begin(), events.end(),
                        [](const ViewEvent& e) { return e.kind == ViewEvent::Kind::kReplaced; }) == 2);
  }

  TEST_CASE("of two replacements before a round the last counts, from the start if either wanted it") {
    const ViewSetup setup = small_setup();
    Table table(setup);
    table.play_to(100);
    table.session.replace(cloths_of(setup), false);
    const std::uint64_t build = table.session.replace(cloths_of(setup), true);
    table.round();
    table.session.fetch();
    CHECK(table.session.snapshot().build == build);
    CHECK(table.session.snapshot().time == 0.0);
  }

  TEST_CASE("reset: the same as the beginning") {
    const ViewSetup setup = small_setup("grasp_and_lift");
    Table table(setup), fresh(setup);
    table.handle(0, 300);
    table.session.send(plain(Kind::kMotion, 0, false));
    table.session.send(plain(Kind::kReset));
    table.play_to(360);
    fresh.play_to(60);
    CHECK(table.session.state_hash() == fresh.session.state_hash());
  }

  TEST_CASE("the scene's hand lifts only while the scene moves") {
    ViewSetup setup = small_setup("grasp_and_lift");
    setup.scene_moves = true;
    Table table(setup);
    table.play_to(60);
    table.seek(60);
    CHECK(table.session.snapshot().cloths[0].scene_hands[0].holds);
    table.session.send(plain(Kind::kMotion, 0, false));
    table.play_to(100);
    table.seek(100);
    CHECK(!table.session.snapshot().cloths[0].scene_hands[0].holds);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("a round allocates nothing: commands, fields, kept states, hashes, a seek") {
    Table table(small_setup("grasp_and_lift", 2));
    table.session.show_field(static_cast<int>(ClothField::kEnergy));
    table.session.send(grab(0, {0.04, 0.03}, {0.04, 0.03, 0.0}));
    table.session.play(true);
    std::size_t allocations = 0;
    for (int i = 0; i < 1200; ++i) {
      if (i % 16 == 0) table.session.send(move(0, {0.04, 0.03, 0.0001 * i}));
      if (i == 700) table.session.seek(100);
      if (i == 750) table.session.play(true);
      const fuai_test::AllocationGuard guard;
      table.round();
      allocations += guard.count();
      table.session.fetch();
    }
    CHECK(allocations == 0);
    CHECK(table.session.ticks() > 400);
  }

  TEST_CASE("two threads: commands one way, snapshots and events the other, cloths replaced meanwhile") {
    const ViewSetup setup = small_setup();
    ViewSession session(cloths_of(setup));
    std::vector<ViewEvent> events;
    std::uint64_t build = 0;
    std::int64_t backward = 0;
    {
      PacedThread thread([&] { return session.tick(PacedThread::now_us()); }, kViewStep);
      thread.set_speed(2.0);
      session.play(true);
      session.send(grab(0, {0.04, 0.03}, {0.04, -0.05, 0.0}));
      std::int64_t last = 0;
      for (int i = 0; i < 6; ++i) {
        const std::int64_t until = session.ticks() + 30;
        while (session.ticks() < until) {
          session.send(move(0, {0.04, -0.05, 0.001 * i}));
          if (session.fetch()) {
            backward += session.snapshot().tick < last ? 1 : 0;
            last = session.snapshot().tick;
          }
          gather(session, events);
          std::this_thread::yield();
        }
        build = session.replace(cloths_of(setup), i % 2 == 0);
      }
      while (session.snapshot().build != build) {
        session.fetch();
        std::this_thread::yield();
      }
    }
    CHECK(backward == 0);
    CHECK(session.lost_events() == 0);
    gather(session, events);
    CHECK(std::is_sorted(events.begin(), events.end(),
                         [](const ViewEvent& a, const ViewEvent& b) { return a.tick < b.tick; }));
  }
}
