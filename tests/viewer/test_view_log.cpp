// Recordings: what was done comes back to the same bits; torn, broken and outdated files.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/view_log.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "fuai/core/error.h"
#include "fuai/io/fabric_file.h"
#include "viewer/small_table.h"

using namespace fuai;
using namespace fuai_test;

namespace {

std::string file_name(const std::string& name) {
  const auto folder = std::filesystem::path(FUAI_BINARY_DIR) / "test-files" / "view-log";
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void put(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

void write(Table& table, ViewLogWriter& log) {
  std::int64_t rewound = -1;
  const std::vector<ViewEvent> events = table.session.take_events(rewound);
  log.write(events, rewound);
}

/// A session with everything: hands, a factor changed with the shape kept, a seek back and another course,
/// another scene. @return hash at the end
std::uint64_t record(const std::string& path, std::int64_t& ticks) {
  ViewSetup setup = small_setup("hanging_sheet", 2);
  setup.scene_moves = true;
  Table table(setup);
  ViewLogWriter log(path, setup);
  table.handle(0, 230);
  write(table, log);
  setup.fabrics[1].factors[static_cast<std::size_t>(FabricFactor::kWarpBending)] = 1.0 / 3.0;
  table.session.replace(cloths_of(setup), true);
  log.announce(table.session.newest_build(), setup);
  table.round();
  table.handle(230, 700);
  write(table, log);
  table.seek(420);
  table.session.send(move(3, Vec3(0.1, -0.05, 0.2)));
  table.play_to(510);
  write(table, log);
  setup.scene = "table_edge";
  log.announce(table.session.replace(cloths_of(setup), false), setup);
  table.round();
  table.session.send(grab(7, {0.04, 0.07}, {0.04, 0.07, 0.0}));
  table.play_to(600);
  table.round();
  table.session.send(plain(ViewCommand::Kind::kRelease, 7));  // begins the tick: its hash is noted
  table.round();
  write(table, log);
  ticks = table.session.ticks();
  return table.session.state_hash();
}

/// The message of reading a text as a recording.
std::string refusal(const std::string& text) {
  const std::string path = file_name("broken.fuai-view");
  put(path, text);
  try {
    read_view_log(path);
  } catch (const Error& e) {
    CHECK(e.kind() == ErrorKind::kBadInput);
    return e.what();
  }
  return "accepted";
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), by);
}

}  // namespace

TEST_SUITE("determinism") {
  TEST_CASE("a replay gives the hashes that were recorded, to the end") {
    const std::string path = file_name("all.fuai-view");
    std::int64_t ticks = 0;
    const std::uint64_t end = record(path, ticks);
    const std::vector<ViewLogPart> parts = read_view_log(path);
    REQUIRE(parts.size() == 3);
    CHECK(parts[1].tick == 230);
    CHECK(parts[1].keep_shape);
    CHECK(parts[1].setup.fabrics[1].factors[1] == 1.0 / 3.0);
    CHECK(!parts[2].keep_shape);
    CHECK(parts[2].setup.scene == "table_edge");
    const ViewReplay replay = replay_view_log(parts);
    CHECK(replay.matches());
    CHECK(replay.hashes == 7);  // at 0, 100 ... 600
    CHECK(replay.ticks == ticks);
    CHECK(replay.state_hash == end);
    CHECK(replay.recorded_hash == end);

    // A hand a hundredth of a millimetre elsewhere is told at the next hash.
    std::vector<ViewLogPart> other = parts;
    for (ViewEvent& event : other[0].events)
      if (event.kind == ViewEvent::Kind::kCommand && event.tick == 60) event.command.position.z() += 1e-5;
    CHECK(replay_view_log(other).first_difference == 100);
  }

  TEST_CASE(
      "felt cloth is felt in the replay; without the line it is the scene's, as it was before there was "
      "one") {
    const std::string path = file_name("felt.fuai-view");
    ViewSetup setup = small_setup();
    setup.felt = true;
    Table table(setup);
    ViewLogWriter log(path, setup);
    CHECK(!log.begun());
    table.session.send(grab(15, {0.04, 0.02}, {0.04, -0.06, 0.0}));
    table.session.send(move(15, {0.05, -0.05, 0.01}));
    table.play_to(250);
    write(table, log);
    CHECK(log.begun());
    const std::vector<ViewLogPart> parts = read_view_log(path);
    REQUIRE(parts.size() == 1);
    CHECK(parts[0].setup.felt);
    CHECK(replay_view_log(parts).matches());

    const std::string old = file_name("old.fuai-view");
    put(old, replaced(content(path), "felt 1\n", ""));
    CHECK_FALSE(read_view_log(old)[0].setup.felt);
    CHECK(replay_view_log(read_view_log(old)).first_difference == 100);
    put(old, replaced(content(path), "felt 1\n", "felt 0\n"));
    CHECK_FALSE(read_view_log(old)[0].setup.felt);
    CHECK(refusal(replaced(content(path), "felt 1\n", "felt 2\n")).find(":6: the number 2 is out of range") !=
          std::string::npos);

    // A recording without a device has no such line: earlier versions read it.
    const std::string plain = file_name("plain.fuai-view");
    std::int64_t ticks = 0;
    record(plain, ticks);
    CHECK(content(plain).find("felt") == std::string::npos);
  }

  TEST_CASE("a recording begins with a reset or with other cloths, in the middle of a session") {
    const ViewSetup setup = small_setup();
    for (const bool reset : {true, false}) {
      CAPTURE(reset);
      const std::string path = file_name(reset ? "reset.fuai-view" : "fresh.fuai-view");
      Table table(setup);
      table.handle(0, 137);
      table.session.send(grab(9, {0.04, 0.03}, {0.04, -0.05, 0.0}));
      table.round();
      std::vector<ViewEvent> before;
      gather(table.session, before);
      ViewLogWriter log(path, setup);
      if (reset) {
        table.session.send(plain(ViewCommand::Kind::kMotion, 0, false));  // as the setup says
        table.session.send(plain(ViewCommand::Kind::kReset));
      } else {
        table.session.replace(cloths_of(setup), false);
        log.announce(table.session.newest_build(), setup);
      }
      table.round();
      write(table, log);
      table.handle(137, 333);
      write(table, log);
      const std::vector<ViewLogPart> parts = read_view_log(path);
      REQUIRE(parts.size() == 1);
      CHECK(parts[0].tick == 137);
      const ViewReplay replay = replay_view_log(parts);
      CHECK(replay.matches());
      CHECK(replay.hashes == 2);
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("numbers come back exactly, names with anything in them too") {
    const std::string path = file_name("exact.fuai-view");
    ViewSetup setup = small_setup();
    const std::string odd = file_name("a b%\n.fabric.toml");
    write_fabric_file(odd, setup.fabrics[0].measured);
    setup.fabrics[0].source = odd;
    setup.fabrics[0].measured = load_fabric(odd);
    setup.size.spacing = 0.1 / 3.0;
    ViewLogWriter log(path, setup);
    ViewEvent event;
    event.kind = ViewEvent::Kind::kHash;
    log.write({event}, -1);
    event = {};
    event.tick = 5;
    event.command = grab(2, {1.0 / 3.0, -1e-300}, {0.1, 2.0 / 7.0, -0.0});
    event.command.radius = 0.01 / 7.0;
    log.write({event}, -1);
    const ViewLogPart part = read_view_log(path).front();
    CHECK(part.setup.size.spacing == setup.size.spacing);
    CHECK(part.setup.fabrics[0].source == odd);
    REQUIRE(part.events.size() == 2);
    CHECK(part.events[1].command.material == event.command.material);
    CHECK(part.events[1].command.position == event.command.position);
    CHECK(part.events[1].command.radius == event.command.radius);
  }

  TEST_CASE("torn anywhere, a recording loses its last line and no more") {
    const std::string whole = file_name("whole.fuai-view"), torn = file_name("torn.fuai-view");
    std::int64_t ticks = 0;
    record(whole, ticks);
    const std::string text = content(whole);
    const auto count = [](const std::vector<ViewLogPart>& parts) {
      std::size_t events = 0;
      for (const ViewLogPart& part : parts) events += part.events.size();
      return events;
    };
    const std::size_t all = count(read_view_log(whole));
    put(torn, text.substr(0, text.size() - 1));
    CHECK(count(read_view_log(torn)) == all - 1);
    // In the middle of the last setup: the part never began.
    put(torn, text.substr(0, text.rfind("fabric ") + 20));
    CHECK(read_view_log(torn).size() == 2);
    // In the middle of the first one there is nothing.
    CHECK(refusal(text.substr(0, text.find("fabric ") + 20)).find("ends before it begins") !=
          std::string::npos);
  }

  TEST_CASE("broken lines are refused with their number") {
    const std::string path = file_name("good.fuai-view");
    const ViewSetup setup = small_setup();
    {
      ViewLogWriter log(path, setup);
      ViewEvent event;
      event.command.kind = ViewCommand::Kind::kReset;
      log.write({event}, -1);
      event.tick = 3;
      event.command = grab(1, {0.01, 0.02}, {0.01, 0.02, 0.03});
      log.write({event}, -1);
    }
    const std::string good = content(path);
    REQUIRE(read_view_log(path).size() == 1);
    struct Broken {
      const char *old, *by, *message;
      int line;
    };
    for (const Broken& b :
         std::initializer_list<Broken>{{"fuai-view/1", "fuai-view/2", "not a recording", 1},
                                       {"part 0 anew", "part 0 new", "'kept' or 'anew'", 2},
                                       {"scene hanging", "sceen hanging", "no 'sceen'", 3},
                                       {"size 9", "size 9.5", "not a number of the right kind", 4},
                                       {"size 9", "size 9999", "out of range", 4},
                                       {"scene_moves 0", "scene_moves 2", "out of range", 5},
                                       {"begin\n3", "begin\nx3", "not a number", 8},
                                       {"3 grab 1", "3 grasp 1", "no event 'grasp'", 8},
                                       {"3 grab 1", "3 grab 16", "out of range", 8},
                                       {"0.03 0.009\n", "0.03\n", "too short", 8},
                                       {"0.03 0.009\n", "nan 0.009\n", "out of range", 8},
                                       {"0.03 0.009\n", "0.03 0.009 0\n", "out of range", 8},
                                       {"0.03 0.009\n", "0.03 0.009 1 2\n", "goes on with '2'", 8}}) {
      CAPTURE(std::string(b.message));
      const std::string message = refusal(replaced(good, b.old, b.by));
      CHECK(message.find(b.message) != std::string::npos);
      CHECK(message.find("broken.fuai-view:" + std::to_string(b.line)) != std::string::npos);
    }
    CHECK(refusal(good + "2 reset\n").find(":9") != std::string::npos);  // ticks never fall
    CHECK(refusal(good + "rewind 0\n").find(":9") != std::string::npos);
  }

  TEST_CASE("a fabric file that has changed is told, and one that is gone") {
    const std::string path = file_name("fabric.fuai-view"), own = file_name("own.fabric.toml");
    ViewSetup setup = small_setup();
    write_fabric_file(own, setup.fabrics[0].measured);
    setup.fabrics[0].source = own;
    setup.fabrics[0].measured = load_fabric(own);
    ViewEvent reset;
    reset.command.kind = ViewCommand::Kind::kReset;
    ViewLogWriter(path, setup).write({reset}, -1);
    CHECK(read_view_log(path).size() == 1);
    Fabric heavier = setup.fabrics[0].measured;
    heavier.areal_mass.value *= 1.01;
    write_fabric_file(own, heavier);
    CHECK(refusal(content(path)).find("is not what it was when this was recorded") != std::string::npos);
    std::filesystem::remove(own);
    CHECK(refusal(content(path)).find("does not exist") != std::string::npos);
  }

  TEST_CASE("a change that was not announced is our mistake; a file that cannot be written the user's") {
    const ViewSetup setup = small_setup();
    ViewLogWriter log(file_name("unknown.fuai-view"), setup);
    ViewEvent event;
    event.command.kind = ViewCommand::Kind::kReset;
    log.write({event}, -1);
    event.kind = ViewEvent::Kind::kReplaced;
    event.build = 4;
    CHECK_THROWS_AS(log.write({event}, -1), Error);
    CHECK_THROWS_AS(ViewLogWriter(file_name("none") + "/no/where", setup), Error);
  }
}
