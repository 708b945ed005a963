// Undo and redo, texts, keys and quantities of the window.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <tuple>

#include "fuai/window/key_table.h"
#include "fuai/window/view_document.h"
#include "fuai/window/view_quantity.h"

namespace {

using namespace fuai;

ViewSetup named(const std::string& scene) {
  ViewSetup setup;
  setup.scene = scene;
  return setup;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("Units stand behind numbers as people write them, none behind a bare number") {
    CHECK(shown_unit(kes_quantity(Kes::kB), UnitSystem::kKes) == "gf·cm²/cm");
    CHECK(shown_unit(kes_quantity(Kes::kB), UnitSystem::kSi) == "N·m");
    CHECK(shown_unit(kes_quantity(Kes::kSMD), UnitSystem::kKes) == "µm");
    CHECK(shown_unit(kes_quantity(Kes::kLT), UnitSystem::kKes).empty());
    CHECK(shown_unit(kes_quantity(Kes::kRT), UnitSystem::kKes) == "%");
    CHECK(shown_unit(kes_quantity(Kes::kRT), UnitSystem::kSi).empty());
  }

  TEST_CASE("Undo goes back, redo forward, a change forgets what could be redone") {
    ViewDocument document(named("a"));
    CHECK_FALSE(document.can_undo());
    document.change(named("b"));
    document.change(named("c"));
    document.undo();
    CHECK(document.setup().scene == "b");
    document.undo();
    CHECK(document.setup().scene == "a");
    document.redo();
    CHECK(document.setup().scene == "b");
    const auto version = document.version();
    document.change(named("d"));
    CHECK(document.version() != version);
    CHECK_FALSE(document.can_redo());
    document.undo();
    CHECK(document.setup().scene == "b");
  }

  TEST_CASE("A slider that is dragged is one change; dragged again it is another") {
    ViewDocument document(named("a"));
    document.change(named("b"), 7);
    document.change(named("c"), 7);
    document.end_row();
    document.change(named("d"), 7);
    document.undo();
    CHECK(document.setup().scene == "c");
    document.undo();
    CHECK(document.setup().scene == "a");
    CHECK_FALSE(document.can_undo());
  }

  TEST_CASE("The past is limited") {
    ViewDocument document(named("first"));
    for (std::size_t i = 0; i < 2 * ViewDocument::kMostStates; ++i) document.change(named(std::to_string(i)));
    std::size_t back = 0;
    for (; document.can_undo(); ++back) document.undo();
    CHECK(back == ViewDocument::kMostStates - 1);
  }

  TEST_CASE("Every text is there in both languages") {
    for (const UiText& text : ui_texts()) {
      const std::string english = text.english, japanese = text.japanese;
      CAPTURE(english);
      CHECK_FALSE(english.empty());
      CHECK_FALSE(japanese.empty());
      const auto ascii = [](unsigned char c) { return c < 0x80; };
      // Whatever is the same in both is a name or a symbol.
      if (std::all_of(japanese.begin(), japanese.end(), ascii)) CHECK(japanese.size() <= 4);
      // The Japanese word for the other language's name is what a reader of that language looks for.
      if (text.id != TextId::kLanguageName) CHECK(english.find("日") == std::string::npos);
    }
  }

  TEST_CASE("Every text is shown somewhere") {
    // An entry that nothing shows is a word that nobody would miss in the other language.
    const std::filesystem::path folder = FUAI_SOURCE_DIR "/src/fuai/window";
    std::string names, used;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      std::ifstream file(entry.path());
      const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
      const std::string name = entry.path().filename();
      if (name == "ui_text.h") names = text;
      if (!name.starts_with("ui_text.")) used += text;
    }
    const auto goes_on = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    std::size_t count = 0;
    std::istringstream lines(names);
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("  k") || line.find(',') == std::string::npos) continue;
      const std::string use = "TextId::" + line.substr(2, line.find(',') - 2);
      CAPTURE(use);
      std::size_t found = used.find(use);
      while (found != std::string::npos && goes_on(used[found + use.size()]))
        found = used.find(use, found + 1);
      CHECK(found != std::string::npos);
      ++count;
    }
    CHECK(count == kTextCount);
  }

  TEST_CASE("No key does two things") {
    std::set<std::tuple<int, bool, bool>> keys;
    for (const KeyRow& row : key_table()) {
      if (row.key == 0) continue;
      CAPTURE(row.label);
      CHECK(keys.insert({row.key, row.control, row.shift}).second);
      CHECK(row.action != KeyAction::kNone);
      CHECK(action_of({row.key, row.control, row.shift, false}) == row.action);
      CHECK(std::string(row.label).starts_with("Ctrl+") == row.control);
    }
    for (int action = 1; action <= static_cast<int>(KeyAction::kQuit); ++action)
      CHECK(std::string(key_label(static_cast<KeyAction>(action))) != "");
  }

  TEST_CASE("The manual has the table of keys") {
    std::ifstream file(FUAI_SOURCE_DIR "/docs/viewer.md");
    const std::string manual((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    REQUIRE_FALSE(manual.empty());
    for (const KeyRow& row : key_table()) {
      const std::string line =
          std::string("| ") + row.label + " | " + ui_text(row.what, Language::kEnglish) + " |";
      CAPTURE(line);
      CHECK(manual.find(line) != std::string::npos);
    }
  }

  TEST_CASE("Quantities stand at the numbers of their fields, with units that are not the same number") {
    const auto quantities = view_quantities();
    REQUIRE(quantities.size() == kClothFieldCount);
    for (std::size_t i = 0; i < quantities.size(); ++i) {
      CHECK(static_cast<std::size_t>(quantities[i].field) == i);
      CHECK(quantities[i].si.to_si == 1.0);
      CHECK(quantities[i].kes.to_si > 0.0);
      CHECK(quantities[i].least_range > 0.0);
    }
    // One newton a metre is 1.0197 gf/cm.
    CHECK(1.0 / quantities[static_cast<std::size_t>(ClothField::kWarpStress)].kes.to_si ==
          doctest::Approx(1.019716).epsilon(1e-6));
  }
}
