// The force log: every hand that holds, once a snapshot, readable while it grows.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/force_log.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "fuai/core/error.h"

using namespace fuai;

namespace {

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a row for every hand that holds, in newtons and gram-force, with every new snapshot") {
    const auto folder = std::filesystem::path(FUAI_BINARY_DIR) / "test-files" / "force-log";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / "forces.csv").string();
    ForceLog log(path);
    CHECK(lines_of(path).size() == 1);
    ViewSnapshot snapshot;
    snapshot.tick = 125;
    snapshot.time = 0.125;
    snapshot.cloths.resize(2);
    log.write(snapshot, {"silk", "wool"});
    CHECK(lines_of(path).size() == 1);  // nobody holds
    GraspReading& hand = snapshot.cloths[1].hands[3];
    hand.holds = true;
    hand.force = Vec3(0.0, -0.0196133, 0.0);
    hand.centre = Vec3(0.25, 0.5, -0.125);
    hand.saturated = true;
    snapshot.cloths[0].scene_hands[0].holds = true;
    snapshot.tick = 126;
    snapshot.time = 0.126;
    log.write(snapshot, {"silk, \"raw\"", "wool"});
    log.write(snapshot, {"silk, \"raw\"", "wool"});  // the same picture again
    const std::vector<std::string> lines = lines_of(path);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0] == "time_s,cloth,fabric,hand,x_m,y_m,z_m,fx_N,fy_N,fz_N,force_N,force_gf,slips");
    CHECK(lines[1] == "0.126,1,\"silk, \"\"raw\"\"\",scene 0,0,0,0,0,0,0,0,0,0");
    CHECK(lines[2] == "0.126,2,wool,3,0.25,0.5,-0.125,0,-0.0196133,0,0.0196133,2,1");
    snapshot.build = 1;  // other cloths at the same tick
    log.write(snapshot, {});
    CHECK(lines_of(path).size() == 5);
    CHECK_THROWS_AS(ForceLog((folder / "none" / "forces.csv").string()), Error);
  }
}
