// A session that does a recording again: the same bits, also after a way back in time; and who ends it.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <memory>
#include <utility>
#include <vector>

#include "viewer/small_table.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr std::int64_t kEnd = 430;

/// What was done, and what came out of it.
struct Recorded {
  ViewScript script;
  std::uint64_t hash = 0;
};

const Recorded& recorded() {
  static const Recorded once = [] {
    Recorded r;
    Table table(small_setup());
    table.handle(0, kEnd);
    gather(table.session, r.script.events);
    std::erase_if(r.script.events, [](const ViewEvent& e) { return e.tick >= kEnd; });
    r.script.last_tick = kEnd;
    r.hash = table.session.state_hash();
    return r;
  }();
  return once;
}

/// Begins it at a tick that is not that of the recording.
void begin(Table& table, ViewScript script) {
  table.play_to(7);
  table.session.replace(cloths_of(small_setup()), false,
                        std::make_shared<const ViewScript>(std::move(script)));
  table.session.play(true);
}

const ScriptView& look(Table& table) {
  for (int i = 0; i < 20; ++i) table.round();  // a snapshot comes every few rounds
  table.session.fetch();
  return table.session.snapshot().script;
}

void run_out(Table& table) {
  for (int i = 0; i < 2 * kEnd; ++i) table.round();
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a session does a recording again, compares its hashes and pauses at its end") {
    Table table(small_setup());
    begin(table, recorded().script);
    for (int i = 0; i < 100; ++i) table.round();
    CHECK(look(table).follows);
    CHECK(look(table).tick > 100);
    run_out(table);
    const ScriptView end = look(table);
    CHECK_FALSE(end.follows);
    CHECK(end.tick == kEnd);
    CHECK(end.hashes == 5);  // every hundred ticks from 0 on
    CHECK(end.first_difference == -1);
    CHECK_FALSE(table.session.snapshot().playing);
    CHECK(table.session.ticks() == 7 + kEnd);
    CHECK(table.session.state_hash() == recorded().hash);
    table.session.play(true);  // and life goes on
    table.round();
    CHECK(table.session.ticks() == 7 + kEnd + 1);
  }

  TEST_CASE("a way back in a recording, single steps there, and on to the same end") {
    Table table(small_setup());
    begin(table, recorded().script);
    for (int i = 0; i < 250; ++i) table.round();
    for (const std::int64_t back : {57, 117, 7}) {  // among them a tick with a command, and the beginning
      table.session.seek(back);
      for (int i = 0; i < 40; ++i) table.round();
      table.session.single_steps(3);  // once more what was done
      for (int i = 0; i < 5; ++i) table.round();
      CHECK(table.session.ticks() == back + 3);
      table.session.play(true);
      for (int i = 0; i < 120; ++i) table.round();
    }
    run_out(table);
    CHECK(look(table).first_difference == -1);
    CHECK(table.session.ticks() == 7 + kEnd);
    CHECK(table.session.state_hash() == recorded().hash);
  }

  TEST_CASE("a hash that is not met is told with its tick") {
    ViewScript script = recorded().script;
    for (ViewEvent& event : script.events)
      if (event.kind == ViewEvent::Kind::kHash && event.tick == 200) event.hash ^= 1;
    Table table(small_setup());
    begin(table, std::move(script));
    run_out(table);
    CHECK(look(table).first_difference == 200);
    CHECK(look(table).hashes == 5);
  }

  TEST_CASE("the user's hand ends a recording, that of a device waits for its end") {
    Table table(small_setup());
    begin(table, recorded().script);
    DevicePose device{Vec3(0.04, -0.06, 0.01), true, 0.05};
    for (int i = 0; i < 30; ++i) table.session.tick(table.wall_us += 1000.0, &device);
    CHECK_FALSE(table.session.device_touch().reading.holds);
    table.session.send(grab(1, {0.04, 0.02}, {0.04, -0.06, 0.0}));
    CHECK_FALSE(look(table).follows);
    for (int i = 0; i < 30; ++i) table.session.tick(table.wall_us += 1000.0, &device);
    CHECK(table.session.device_touch().reading.holds);
    run_out(table);
    CHECK(table.session.ticks() > 7 + kEnd);  // it did not stop
  }

  TEST_CASE("a part that is followed by another waits for it at its last tick") {
    ViewScript first = recorded().script, second;
    first.last_tick = 150;
    first.more = true;
    std::erase_if(first.events, [](const ViewEvent& e) { return e.tick > 150; });
    second.first_tick = 150;
    second.last_tick = 160;
    Table table(small_setup());
    begin(table, std::move(first));
    run_out(table);
    CHECK(look(table).follows);
    CHECK(look(table).tick == 150);
    CHECK(table.session.ticks() == 157);
    table.session.replace(cloths_of(small_setup()), true, std::make_shared<const ViewScript>(second));
    run_out(table);
    CHECK(table.session.ticks() == 167);
    CHECK(look(table).tick == 160);
  }

  TEST_CASE("a device feels and grips the cloth that was chosen, and a new choice is a disturbance") {
    ViewSetup setup = small_setup("hanging_sheet", 2);
    setup.fabrics[1].factors[static_cast<std::size_t>(FabricFactor::kWeight)] = 4.0;
    Table table(setup);
    table.session.play(true);
    DevicePose pose{Vec3(0.04, -0.06, 0.0), true, 0.02, 400.0};
    const auto ticks = [&](int count) {
      for (int i = 0; i < count; ++i) table.session.tick(table.wall_us += 1000.0, &pose);
    };
    ticks(200);
    REQUIRE(table.session.device_touch().reading.holds);
    table.session.fetch();
    const auto force = [&](std::size_t cloth) {
      table.session.fetch();
      return table.session.snapshot().cloths[cloth].hands[kDeviceHand].force;
    };
    const auto felt = [&] { return table.session.device_touch().reading.force; };
    table.session.play(false);
    ticks(20);
    CHECK(felt() == force(0));
    REQUIRE(force(0) != force(1));
    const std::uint64_t before = table.session.device_touch().disturbances;
    table.session.feel(1);
    ticks(1);
    CHECK(felt() == force(1));
    CHECK(table.session.device_touch().disturbances == before + 1);
    ticks(1);
    CHECK(table.session.device_touch().disturbances == before + 1);
    table.session.feel(3);  // there are two: the last
    ticks(1);
    CHECK(felt() == force(1));
    CHECK(table.session.device_touch().disturbances == before + 1);
  }
}
