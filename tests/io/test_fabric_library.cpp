// Finding bundled fabrics by name, and the suggestions for a misspelt one.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "fuai/io/fabric_library.h"
#include "fuai/io/nearest_name.h"
#include "io/io_test_tools.h"

using namespace fuai;
using fuai::test::contains;
using fuai::test::error_of;
using fuai::test::TemporaryFolder;

namespace {

/// Sets FUAI_DATA as long as the object lives.
class DataFolder {
 public:
  explicit DataFolder(const std::string& path) { ::setenv("FUAI_DATA", path.c_str(), 1); }
  DataFolder(const DataFolder&) = delete;
  DataFolder& operator=(const DataFolder&) = delete;
  ~DataFolder() { ::unsetenv("FUAI_DATA"); }
};

const std::string kFabric = "format = \"fuai-fabric/1\"\nname = \"Cloth\"\n[weight]\nW_mg_per_cm2 = 10\n";

std::string message_of(const std::string& name) {
  return error_of([&] { load_fabric(name); }).what();
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("bundled fabrics are found by name, files by path") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "fabrics");
    folder.write("fabrics/wool-tropical.fabric.toml", kFabric);
    folder.write("fabrics/cotton-knit.fabric.toml", kFabric);
    folder.write("fabrics/cotton-knit.bending.warp.csv", "x");
    folder.write("own.toml", kFabric);
    const DataFolder data(folder.path());
    CHECK(data_folder() == folder.path());
    CHECK(bundled_fabric_ids() == std::vector<std::string>{"cotton-knit", "wool-tropical"});
    CHECK(load_fabric("wool-tropical").id == "wool-tropical");
    CHECK(load_fabric(folder / "own.toml").id == "own");
    CHECK(contains(message_of("wool-tropcial"),
                   "there is no bundled fabric 'wool-tropcial'; did you mean wool-tropical?"));
    CHECK(contains(message_of("zzzzzzzzzzzzzzz"), "the bundled fabrics are cotton-knit or wool-tropical"));
    CHECK(contains(message_of("./none.fabric.toml"), "./none.fabric.toml: the file does not exist"));
    CHECK(contains(message_of(folder.path()), "this is a directory"));
  }

  TEST_CASE("names with numbers stand in the order of the numbers") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "fabrics");
    for (const char* id : {"graded-10", "graded-3", "graded-03", "graded", "a2b10", "a2b9", "a10b1"})
      folder.write(std::string("fabrics/") + id + ".fabric.toml", kFabric);
    const DataFolder data(folder.path());
    CHECK(bundled_fabric_ids() ==
          std::vector<std::string>{"a2b9", "a2b10", "a10b1", "graded", "graded-03", "graded-3", "graded-10"});
  }

  TEST_CASE("the data folder: a wrong FUAI_DATA is an error, the source tree is the last resort") {
    const TemporaryFolder folder;
    {
      const DataFolder data(folder / "none");
      CHECK(contains(error_of([] { data_folder(); }).what(), "FUAI_DATA names a folder that does not exist"));
    }
    CHECK(std::filesystem::is_directory(data_folder() + "/u3m"));
    const DataFolder empty(folder.path());
    CHECK(bundled_fabric_ids().empty());
    CHECK(contains(message_of("x"), "there are none in"));
  }

  TEST_CASE("edit distances and suggestions") {
    CHECK(edit_distance("", "abc") == 3);
    CHECK(edit_distance("kitten", "sitting") == 3);
    CHECK(edit_distance("same", "same") == 0);
    const std::vector<std::string> names = {"cotton", "button", "wool"};
    CHECK(nearest_names("coton", names) == std::vector<std::string>{"cotton"});
    CHECK(nearest_names("otton", names, 2) == std::vector<std::string>{"cotton", "button"});
    CHECK(either(std::vector<std::string>{"a", "b", "c"}) == "a, b or c");
    CHECK(either({}) == "");
  }
}
