// What a newcomer is told and finds: the lines of the hint, the list of fabrics, the names of scenes.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "fuai/io/fabric_library.h"
#include "fuai/scenes/catalogue.h"
#include "fuai/window/fabric_choice.h"
#include "fuai/window/first_steps.h"
#include "fuai/window/scene_text.h"

namespace {

using namespace fuai;

const std::vector<FabricChoice>& bundled() {
  static const std::vector<FabricChoice> all = [] {
    std::vector<FabricChoice> fabrics;
    for (const std::string& id : bundled_fabric_ids()) fabrics.push_back(make_fabric_choice(id));
    return fabrics;
  }();
  return all;
}

std::vector<std::string> ids(const std::string& text, ChoiceColumn by = ChoiceColumn::kName,
                             bool descending = false) {
  std::vector<std::string> found;
  for (const std::size_t i : choose_fabrics(bundled(), text, by, descending))
    found.push_back(bundled()[i].id);
  return found;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("Each line of the hint goes away once it was done, in any order") {
    FirstSteps steps;
    CHECK(steps.lines() == std::vector{TextId::kHintGrab, TextId::kHintSwitch, TextId::kHintCompare});
    steps.did(FirstStep::kSwitch);
    CHECK(steps.lines() == std::vector{TextId::kHintGrab, TextId::kHintCompare});
    steps.did(FirstStep::kSwitch);
    steps.did(FirstStep::kGrab);
    CHECK(steps.lines() == std::vector{TextId::kHintCompare});
    steps.did(FirstStep::kCompare);
    CHECK(steps.lines().empty());
  }

  TEST_CASE("A fabric is found by every word of its id, name and composition, whatever the case") {
    CHECK(ids("").size() == bundled().size());
    CHECK(ids("wOOl") == std::vector<std::string>{"wool-tropical"});
    CHECK(ids("tropical 100") == std::vector<std::string>{"wool-tropical"});
    CHECK(ids("tropical cupro").empty());
    CHECK(ids("graded").size() == 4);
  }

  TEST_CASE("Fabrics are sorted by name or by a number, unknown numbers last both ways") {
    for (const ChoiceColumn by : {ChoiceColumn::kWeight, ChoiceColumn::kBending, ChoiceColumn::kShear}) {
      const std::vector<std::size_t> up = choose_fabrics(bundled(), "", by, false);
      const std::vector<std::size_t> down = choose_fabrics(bundled(), "", by, true);
      const auto column = static_cast<std::size_t>(by) - 1;
      for (std::size_t i = 1; i < up.size(); ++i) {
        CHECK(bundled()[up[i - 1]].numbers[column] <= bundled()[up[i]].numbers[column]);
        CHECK(bundled()[down[i - 1]].numbers[column] >= bundled()[down[i]].numbers[column]);
      }
    }
    std::vector<FabricChoice> some(3);
    some[0].name = "b";
    some[1].name = "a";
    some[2].name = "c";
    some[0].numbers[0] = std::numeric_limits<double>::quiet_NaN();
    some[1].numbers[0] = 2.0;
    some[2].numbers[0] = 1.0;
    CHECK(choose_fabrics(some, "", ChoiceColumn::kWeight, false) == std::vector<std::size_t>{2, 1, 0});
    CHECK(choose_fabrics(some, "", ChoiceColumn::kWeight, true) == std::vector<std::size_t>{1, 2, 0});
    CHECK(choose_fabrics(some, "", ChoiceColumn::kName, false) == std::vector<std::size_t>{1, 0, 2});
    CHECK(choose_fabrics(some, "", ChoiceColumn::kName, true) == std::vector<std::size_t>{2, 0, 1});
  }

  TEST_CASE("The list shows what the fabric file says, the mean of warp and weft, and what is assumed") {
    const FabricChoice wool = make_fabric_choice("wool-tropical");
    // W 16.29 mg/cm2 and B 0.067 gf cm2/cm both ways are in its file; its shear is assumed.
    CHECK(wool.numbers[0] / choice_quantity(0).to_si == doctest::Approx(16.29).epsilon(1e-12));
    CHECK(wool.numbers[1] / choice_quantity(1).to_si == doctest::Approx(0.067).epsilon(1e-12));
    CHECK(wool.assumed == std::array{false, false, true});
    CHECK(std::isfinite(wool.numbers[2]));
  }

  TEST_CASE(
      "Every scene that has time has a name and a description in both languages, no two the same name") {
    std::set<std::string> names;
    std::size_t count = 0;
    for (const SceneEntry& scene : scene_entries()) {
      if (scene.kind != SceneKind::kEngine) continue;
      CAPTURE(std::string(scene.name));
      for (const Language language : {Language::kEnglish, Language::kJapanese}) {
        const char* text = scene_text(scene.name, language);
        REQUIRE(text != nullptr);
        names.insert(text);
        ++count;
      }
      CHECK(scene_description(scene, Language::kEnglish) == scene.description);
      const std::string_view japanese = scene_description(scene, Language::kJapanese);
      CHECK(std::ranges::any_of(japanese, [](char c) { return static_cast<unsigned char>(c) >= 0x80; }));
    }
    CHECK(names.size() == count);
    CHECK(scene_text("nosuch", Language::kEnglish) == nullptr);
  }
}
