// The hand of a device in the viewer: what it grips, when it lets go, repeated without it.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "fuai/viewer/view_log.h"
#include "viewer/small_table.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr double kReach = 0.02;

/// A table with a hand of a device at it.
struct DeviceTable : Table {
  explicit DeviceTable(const ViewSetup& setup) : Table(setup) { session.play(true); }
  void tick() { session.tick(wall_us += 1000.0, &pose); }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  bool holds() const { return session.device_touch().reading.holds; }
  DevicePose pose{Vec3(0.04, -0.06, 0.01), false, kReach, 400.0};
};

std::vector<ViewCommand> commands(const std::vector<ViewEvent>& events) {
  std::vector<ViewCommand> found;
  for (const ViewEvent& event : events)
    if (event.kind == ViewEvent::Kind::kCommand) found.push_back(event.command);
  return found;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a device's hand grips the nearest cloth within its reach, follows every tick, lets go") {
    DeviceTable table(small_setup());
    table.ticks(3);
    CHECK_FALSE(table.holds());
    table.pose.holds = true;
    table.pose.position.z() = 0.5;  // out of reach: it waits until there is cloth
    table.ticks(3);
    CHECK_FALSE(table.holds());
    table.pose.position.z() = 0.01;
    table.tick();
    CHECK(table.holds());
    table.pose.position.x() += 1e-3;
    table.ticks(2);  // the second has nothing to tell
    table.pose.holds = false;
    table.tick();
    CHECK_FALSE(table.holds());
    std::vector<ViewEvent> events;
    gather(table.session, events);
    const std::vector<ViewCommand> done = commands(events);
    REQUIRE(done.size() == 3);
    CHECK(done[0].kind == Kind::kGrab);
    CHECK(done[0].hand == kDeviceHand);
    CHECK(done[0].stiffness == 400.0);
    // Nearest to (0.04, -0.06) on a sheet that starts at (weft, warp - 0.08).
    CHECK((done[0].material - Vec2(0.04, 0.02)).norm() < 1e-12);  // exact nodes
    CHECK(done[1].kind == Kind::kMove);
    CHECK(done[1].ticks == 1);
    CHECK(done[2].kind == Kind::kRelease);
  }

  TEST_CASE("a device's hand that jumps farther than its reach lets go") {
    DeviceTable table(small_setup());
    table.pose.holds = true;
    table.tick();
    REQUIRE(table.holds());
    table.pose.position += Vec3(0.0, 0.0, 0.99 * kReach);
    table.tick();
    CHECK(table.holds());
    table.pose.position += Vec3(0.0, 0.5, 0.5);
    table.ticks(2);
    CHECK_FALSE(table.holds());
    table.pose.position.x() = std::nan("");
    table.ticks(2);
    CHECK_FALSE(table.holds());
  }

  TEST_CASE("nothing happens while the session stands; its own hand is no disturbance, others are") {
    DeviceTable table(small_setup());
    table.pose.holds = true;
    table.session.play(false);
    table.ticks(3);
    CHECK_FALSE(table.holds());
    table.session.play(true);
    table.tick();
    CHECK(table.holds());
    const std::uint64_t quiet = table.session.device_touch().disturbances;
    for (int i = 0; i < 5; ++i) {
      table.pose.position.z() += 1e-4;
      table.tick();
    }
    CHECK(table.session.device_touch().disturbances == quiet);
    table.session.send(grab(0, {0.01, 0.01}, {0.01, -0.07, 0.0}));
    table.tick();
    const std::uint64_t gripped = table.session.device_touch().disturbances;
    CHECK(gripped > quiet);
    table.ticks(3);  // a hand that holds still gives nothing
    CHECK(table.session.device_touch().disturbances == gripped);
    table.session.send(move(0, {0.01, -0.07, 0.02}));
    table.ticks(3);
    CHECK(table.session.device_touch().disturbances > gripped);
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("what a device's hand did is recorded, and repeated without it, back in time too") {
    const auto folder = std::filesystem::path(FUAI_BINARY_DIR) / "test-files" / "device-pose";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / "felt.fuai-view").string();
    const ViewSetup setup = small_setup("hanging_sheet", 2);
    DeviceTable table(setup);
    ViewLogWriter log(path, setup);
    for (int i = 0; i <= 400; ++i) {
      table.pose.holds = i > 20 && i < 300;
      table.pose.position.z() = 0.01 + 0.01 * std::sin(0.02 * i);
      table.tick();
      table.hashes[table.session.ticks()] = table.session.state_hash();
    }
    table.session.play(false);
    table.tick();
    std::int64_t rewound = -1;
    log.write(table.session.take_events(rewound), rewound);
    const ViewReplay replay = replay_view_log(read_view_log(path));
    CHECK(replay.matches());
    CHECK(replay.hashes == 5);  // at 0, 100 ... 400
    table.seek(250);
    CHECK(table.session.state_hash() == table.hashes[250]);
    CHECK(table.holds());
  }
}
