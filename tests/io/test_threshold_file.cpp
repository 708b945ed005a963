// Difference thresholds: the bundled table, and tables that are wrong.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <string>

#include "fuai/core/error.h"
#include "fuai/io/threshold_file.h"

using namespace fuai;

namespace {

const std::string kHeader = "quantities,kind,threshold,unit,what,condition,remark,source\n";

std::string message_of(const std::string& row) {
  try {
    parse_thresholds(kHeader + row, "t.csv");
  } catch (const Error& e) {
    CHECK(e.kind() == ErrorKind::kBadInput);
    return e.what();
  }
  return "accepted";
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the bundled thresholds are those of their sources, in SI") {
    const std::vector<Threshold> all = bundled_thresholds();
    for (const Kes quantity : {Kes::kB, Kes::kG, Kes::kEMT}) {
      const Threshold* compliance = find_threshold(all, quantity);
      REQUIRE(compliance);
      CHECK(compliance->kind == ThresholdKind::kFraction);
      CHECK(compliance->value == doctest::Approx(0.22));
      CHECK(compliance->in_words == "22 %");
      CHECK(compliance->source.find("Tan") == 0);
    }
    const Threshold* roughness = find_threshold(all, Kes::kSMD);
    REQUIRE(roughness);
    CHECK(roughness->kind == ThresholdKind::kDifference);
    CHECK(roughness->value == doctest::Approx(0.86e-6));
    // Nobody measured these; a number would be made up.
    for (const Kes quantity : {Kes::k2HB, Kes::k2HG, Kes::kMIU, Kes::kT, Kes::kDrapeCoefficient})
      CHECK(find_threshold(all, quantity) == nullptr);
    for (const Threshold& t : all) {
      CHECK_FALSE(t.source.empty());
      if (t.quantities.empty()) CHECK(t.remark.starts_with("not used: "));
    }
  }

  TEST_CASE("a wrong table is refused with its place") {
    CHECK(message_of("B,fraction,0.2,-,w,c,r,s\n") == "accepted");
    CHECK(message_of("SMD,difference,0.9,um,w,c,r,s\n") == "accepted");
    CHECK(message_of("Q,fraction,0.2,-,w,c,r,s\n").find("t.csv:2:1: quantities: 'Q' is no KES quantity") ==
          0);
    CHECK(message_of("B,share,0.2,-,w,c,r,s\n").find("no kind of threshold") != std::string::npos);
    CHECK(message_of("B,fraction,0,-,w,c,r,s\n").find("above zero") != std::string::npos);
    CHECK(message_of("B,fraction,nan,-,w,c,r,s\n") != "accepted");
    CHECK(message_of("SMD,difference,0.9,gf,w,c,r,s\n").find("is no unit of a difference of SMD") !=
          std::string::npos);
    CHECK(message_of("B,fraction,0.2,um,w,c,r,s\n").find("is no unit of a fraction of B") !=
          std::string::npos);
    CHECK(message_of("B,fraction,0.2\n").find("3 cells instead of 8") != std::string::npos);
    CHECK_THROWS_AS(parse_thresholds("a,b\n1,2\n", "t.csv"), Error);
  }
}
