// The keys of a fabric file that say how its yarns lie.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <string>

#include "fuai/io/fabric_file.h"
#include "io/io_test_tools.h"

using namespace fuai;
using fuai::test::contains;
using fuai::test::error_of;

namespace {

/// A fabric of which nothing else is known, with these lines of its own.
Fabric parse(const std::string& lines) {
  return parse_fabric(
      "format = \"fuai-fabric/1\"\nname = \"Wool\"\n" + lines + "[weight]\nW_mg_per_cm2 = 16.29\n",
      "wool.fabric.toml", "/nonexistent");
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("structure and yarns per centimetre are read; what is no structure is told") {
    const Fabric fabric =
        parse("structure = \"satin\"\n[weave]\nwarp_threads_per_cm = 48\nweft_threads_per_cm = 31.5\n");
    CHECK(fabric.weave.structure == WeaveStructure::kSatin);
    CHECK(fabric.weave.warp_threads.value == doctest::Approx(4800.0).epsilon(1e-14));
    CHECK(fabric.weave.weft_threads.value == doctest::Approx(3150.0).epsilon(1e-14));
    CHECK(!parse("").weave.structure.has_value());
    CHECK(
        contains(error_of([] { parse("structure = \"basket\"\n"); }).what(),
                 "wool.fabric.toml:3:13: structure: unknown structure 'basket'; write plain, twill, satin or "
                 "knit"));
    CHECK(contains(error_of([] { parse("[weave]\nwarp_threads_per_cm = 0\n"); }).what(),
                   "weave.warp_threads_per_cm: the value is zero"));
  }
}
