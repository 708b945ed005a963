// What is drawn of a weave: keys before words before rules.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <string>

#include "fuai/fabric/assumptions.h"
#include "fuai/fabric/weave.h"
#include "fuai/io/fabric_library.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("the structure: a key before words, words before plain") {
    Fabric fabric;
    CHECK(weave_of(fabric).structure == WeaveStructure::kPlain);
    CHECK(weave_of(fabric).structure_assumed);
    const struct {
      const char* text;
      WeaveStructure structure;
    } cases[] = {{"100 % wool, plain weave", WeaveStructure::kPlain},
                 {"Cotton Denim", WeaveStructure::kTwill},
                 {"silk, SATIN", WeaveStructure::kSatin},
                 {"綿 天竺編", WeaveStructure::kKnit},
                 {"毛 綾織", WeaveStructure::kTwill},
                 {"knitted satin", WeaveStructure::kKnit}};
    for (const auto& c : cases) {
      CAPTURE(c.text);
      fabric.composition = c.text;
      CHECK(weave_of(fabric).structure == c.structure);
      CHECK_FALSE(weave_of(fabric).structure_assumed);
    }
    fabric.weave.structure = WeaveStructure::kSatin;
    CHECK(weave_of(fabric).structure == WeaveStructure::kSatin);
  }

  TEST_CASE("yarns per length: one direction stands for the other, without both a rule says that it is one") {
    Fabric fabric;
    CHECK(weave_of(fabric).warp_pitch == doctest::Approx(1.0 / assumed::kWovenThreads));
    CHECK(weave_of(fabric).threads_assumed);
    fabric.weave.structure = WeaveStructure::kKnit;
    CHECK(weave_of(fabric).weft_pitch == doctest::Approx(1.0 / assumed::kKnitLoops));
    fabric.weave.warp_threads.value = 3000.0;
    CHECK(weave_of(fabric).warp_pitch == doctest::Approx(1.0 / 3000.0));
    CHECK(weave_of(fabric).weft_pitch == doctest::Approx(1.0 / 3000.0));
    CHECK_FALSE(weave_of(fabric).threads_assumed);
    fabric.weave.weft_threads.value = 2000.0;
    CHECK(weave_of(fabric).weft_pitch == doctest::Approx(1.0 / 2000.0));
  }

  TEST_CASE("of the bundled fabrics the knit is drawn as one") {
    for (const std::string& id : bundled_fabric_ids()) {
      CAPTURE(id);
      const bool knit = weave_of(load_fabric(id)).structure == WeaveStructure::kKnit;
      CHECK(knit == (id == "cotton-knit-shirley"));
    }
  }
}
