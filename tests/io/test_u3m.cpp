// The U3M physics reader: both shipped files, numbers as strings, and what it refuses.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <string>

#include "fuai/io/text_file.h"
#include "fuai/io/u3m.h"
#include "io/io_test_tools.h"

using namespace fuai;
using fuai::test::contains;
using fuai::test::error_of;

namespace {

const std::string kFolder = FUAI_SOURCE_DIR "/data/u3m/";

/// A complete physics file in which every strip is the same; `strip` and `mass` can be spoiled.
std::string physics(const std::string& tree = "[[2,0,2.1,3.5],[2.1,3.5,2,0]]",
                    const std::string& mass = "105.6", const std::string& width = "4") {
  const std::string part =
      R"({"freq":55,"width":)" + width + R"(,"length":"2.5","time":1580130000,"samplesTree":)" + tree + "}";
  const std::string strip = R"({"D1":)" + part + R"(,"D2":)" + part + R"(,"S1":)" + part + R"(,"S2":)" +
                            part + R"(,"U1":)" + part + "}";
  return R"({"schema":"1.1","custom":null,"raw_data":{"L":)" + strip + R"(,"W":)" + strip + R"(,"B":)" +
         strip + R"(,"T":{"freq":55,"samplesTree":[[0.02,-60]]},"M":)" + mass + "}}";
}

std::string message_of(const std::string& text) {
  return error_of([&] { parse_u3m_physics(text, "f.json"); }).what();
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the shipped cupro: values read off the file by hand, converted by hand") {
    const FabRecord record = read_u3m_physics(kFolder + "cupro-woven-su1098.physics.json");
    CHECK(record.name == "SU-1098 Cupro");
    CHECK(record.composition == "100 % Rayon");
    CHECK(record.category == "Weaves");
    // One multiplication each: a few ulp.
    CHECK(record.areal_mass == doctest::Approx(0.1055999984741211).epsilon(1e-14));
    CHECK(record.thickness == doctest::Approx(0.10464175045490265e-3).epsilon(1e-14));
    CHECK(record.source_date == "2020-01-27");
    CHECK(record.vendor_warnings.empty());
    CHECK(record.thickness_branches.size() == 10);
    const FabStripTest& bias = record.strip(Direction::kBias, FabTest::kS2);
    CHECK(bias.width == doctest::Approx(0.05).epsilon(1e-14));
    CHECK(bias.length == doctest::Approx(0.0817609977722168).epsilon(1e-14));
    CHECK(bias.sample_rate == 55.0);
    CHECK(bias.branches.size() == 8);
    CHECK(bias.branches[0].size() == 166);
    CHECK(bias.branches[0][0].clamp_distance == doctest::Approx(0.08025333404541016).epsilon(1e-14));
    CHECK(bias.branches[0][0].force == doctest::Approx(0.5517556667327881 * 9.80665e-3).epsilon(1e-14));
    // L is the warp, W the weft.
    CHECK(record.strip(Direction::kWarp, FabTest::kD1).length == doctest::Approx(0.020833001136779785));
    CHECK(record.strip(Direction::kWeft, FabTest::kD1).length == doctest::Approx(0.020907177925109863));
  }

  TEST_CASE("the shipped knit keeps the vendor's warnings and every branch") {
    const FabRecord record = read_u3m_physics(kFolder + "cotton-knit-shirley.physics.json");
    CHECK(record.composition == "100 % Cotton");
    CHECK(record.vendor_warnings.at("BendRigidityWarp") == "low-force");
    CHECK(record.vendor_warnings.size() == 2);
    CHECK(record.source_date == "2020-06-12");
    const FabStripTest& warp = record.strip(Direction::kWarp, FabTest::kS1);
    std::size_t count = 0;
    for (const auto& branch : warp.branches) count += branch.size();
    CHECK(count == 1606);  // 308+156+304+308+460+462+608+606 numbers, two a sample
  }

  TEST_CASE("numbers may be strings, and any number of branches is kept") {
    const FabRecord record = parse_u3m_physics(physics("[[\"2\",\"0\",2.1,\"3.5e0\"]]"), "x/plain.json");
    CHECK(record.name == "plain");
    CHECK(record.strip(Direction::kWarp, FabTest::kU1).branches.size() == 1);
    CHECK(record.strip(Direction::kWarp, FabTest::kU1).branches[0][1].force ==
          doctest::Approx(3.5 * 9.80665e-3).epsilon(1e-14));
    CHECK(record.strip(Direction::kWarp, FabTest::kU1).length == doctest::Approx(0.025).epsilon(1e-14));
  }

  TEST_CASE("a truncated file is refused with the place of the cut") {
    const std::string text = "{\"schema\": \"1.1\",\n  \"raw_data\": {";
    const Error error = error_of([&] { parse_u3m_physics(text, "f.json"); });
    CHECK(error.where().line == 2);
    CHECK(error.where().column >= 15);
    CHECK(contains(error.what(), "cut off"));
  }

  TEST_CASE("wrong values name their key and a cure") {
    CHECK(contains(message_of(physics("[[2,0,2.1]]")),
                   "raw_data.L.S1.samplesTree[0]: distance and force must"));
    CHECK(contains(message_of(physics("[[2,\"x\"]]")), "raw_data.L.S1.samplesTree[0][1]: a finite number"));
    CHECK(contains(message_of(physics("[[2,\"nan\"]]")), "finite"));
    CHECK(contains(message_of(physics("[[2,\"inf\"]]")), "finite"));
    CHECK(contains(message_of(physics("[[2,1e999]]")), "f.json"));
    CHECK(contains(message_of(physics("[]")), "no samples"));
    CHECK(contains(message_of(physics("[[2,0]]", "-3")),
                   "raw_data.M: a number above zero is expected, got -3"));
    CHECK(contains(message_of(physics("[[2,0]]", "1", "0")), "raw_data.L.S1.width: a number above zero"));
    CHECK(contains(message_of("[]"), "object"));
    CHECK(contains(message_of("{}"), "'schema' is missing"));
    CHECK(contains(message_of(R"({"schema":"2.0"})"), "\"2.0\", not \"1.1\""));
    CHECK(contains(message_of(R"({"schema":"1.1","raw_data":null})"), "raw_data: there are no measurements"));
    CHECK(contains(message_of(R"({"schema":"1.1","material":{}})"), "material.physics.devices.fab"));
  }

  TEST_CASE("deep nesting is refused, not followed") {
    CHECK(contains(message_of(std::string(100000, '[')), "nested deeper"));
  }
}
