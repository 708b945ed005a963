// What the window keeps: the round trip, broken files, where the file is, and options that hold for once.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "fuai/core/error.h"
#include "fuai/window/kept_settings.h"
#include "io/io_test_tools.h"

namespace {

using namespace fuai;
using fuai::test::error_of;
using fuai::test::TemporaryFolder;

/// A variable of the environment that is as it was at the end. @param value null: not set
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    set(value);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { set(before_ ? before_->c_str() : nullptr); }

 private:
  void set(const char* value) const {
    if (value != nullptr)
      ::setenv(name_, value, 1);
    else
      ::unsetenv(name_);
  }
  const char* name_;
  std::optional<std::string> before_;
};

ViewSettings random_settings() {
  const auto coin = [] { return *rc::gen::arbitrary<bool>(); };
  ViewSettings s;
  s.language = coin() ? Language::kJapanese : Language::kEnglish;
  s.units = coin() ? UnitSystem::kSi : UnitSystem::kKes;
  for (bool* choice : {&s.dark, &s.fabric_panel, &s.plots, &s.yarns, &s.lines, &s.arrows, &s.ground})
    *choice = coin();
  s.letters = *rc::gen::inRange(kLeastLetters, kMostLetters + 1);
  return s;
}

bool same(const ViewSettings& a, const ViewSettings& b) {
  return a.language == b.language && a.units == b.units && a.dark == b.dark &&
         a.fabric_panel == b.fabric_panel && a.plots == b.plots && a.yarns == b.yarns && a.lines == b.lines &&
         a.arrows == b.arrows && a.ground == b.ground && a.letters == b.letters;
}

}  // namespace

TEST_SUITE("property") {
  TEST_CASE("What is written is read back") {
    CHECK(rc::check("round trip", [] {
      const KeptSettings kept{random_settings(),
                              *rc::gen::element(std::string(), std::string("/布/a \"b\"\\"))};
      const KeptSettings back = parse_kept_settings(format_kept_settings(kept), "viewer.toml");
      RC_ASSERT(same(back.settings, kept.settings));
      RC_ASSERT(back.folder == kept.folder);
    }));
  }

  TEST_CASE("An option of the command line holds for once, a choice in the window for good") {
    CHECK(rc::check("kept", [] {
      const ViewSettings before = random_settings(), start = random_settings(), end = random_settings();
      RC_ASSERT(same(settings_to_keep(before, start, start), before));
      RC_ASSERT(same(settings_to_keep(before, before, end), end));
      const ViewSettings keep = settings_to_keep(before, start, end);
      RC_ASSERT(keep.yarns == (end.yarns == start.yarns ? before.yarns : end.yarns));
      RC_ASSERT(keep.language == (end.language == start.language ? before.language : end.language));
    }));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("The file is written with its folder, and read; without a file there are the defaults") {
    const TemporaryFolder folder;
    const std::string path = folder / "new/fuai/viewer.toml";
    CHECK(same(read_kept_settings(path).settings, ViewSettings{}));
    CHECK(same(read_kept_settings("").settings, ViewSettings{}));
    KeptSettings kept;
    kept.settings.language = Language::kJapanese;
    kept.settings.yarns = false;
    kept.folder = "/tmp";
    write_kept_settings(path, kept);
    CHECK(same(read_kept_settings(path).settings, kept.settings));
    CHECK(read_kept_settings(path).folder == "/tmp");
    const std::string blocked = folder.write("file", "x") + "/fuai/viewer.toml";
    error_of([&] { write_kept_settings(blocked, kept); });
  }

  TEST_CASE("A broken file is told with its place; a key of another version is left out") {
    const auto message = [](const char* text) {
      return std::string(error_of([&] { parse_kept_settings(text, "v.toml"); }).what());
    };
    CHECK(message("language = \"en\"\ntheme =").find("v.toml:2:") == 0);
    CHECK(message("\nlanguage = \"fr\"").find("v.toml:2:12: language: ") == 0);
    CHECK(message("language = \"fr\"").find("write \"en\" or \"ja\"") != std::string::npos);
    CHECK(message("plots = 1").find("plots: ") != std::string::npos);
    CHECK(message("plots = \"true\"").find("write true or false") != std::string::npos);
    CHECK(message("folder = 3").find("folder: a text is expected") != std::string::npos);
    const KeptSettings kept = parse_kept_settings("sound = 0.5\nplots = false\n", "v.toml");
    CHECK_FALSE(kept.settings.plots);
    CHECK(kept.settings.fabric_panel);
  }

  TEST_CASE("The file stands where the XDG specification says") {
    const Variable home("HOME", "/home/a");
    {
      const Variable config("XDG_CONFIG_HOME", "/conf");
      CHECK(kept_settings_path() == "/conf/fuai/viewer.toml");
    }
    for (const char* none : {static_cast<const char*>(nullptr), "", "relative"}) {
      const Variable config("XDG_CONFIG_HOME", none);
      CHECK(kept_settings_path() == "/home/a/.config/fuai/viewer.toml");
      const Variable nowhere("HOME", nullptr);
      CHECK(kept_settings_path().empty());
    }
  }
}
