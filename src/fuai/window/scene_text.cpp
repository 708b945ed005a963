// The table of scenes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/scene_text.h"

namespace fuai {
namespace {

struct SceneText {
  std::string_view scene;
  TextId text;
  std::string_view description_ja;  ///< the English one is the catalogue's
};
constexpr SceneText kSceneTexts[] = {
    {"hanging_sheet", TextId::kSceneHangingSheet, "33 × 33 節点、間隔 1 cm。水平から放し、二つの隅で吊る"},
    {"hanging_strip", TextId::kSceneHangingStrip, "64 行 9 列、間隔 1 cm。上端で吊る"},
    {"taut_patch", TextId::kSceneTautPatch,
     "32 × 32、間隔 1 cm、上端を固定。指先が 2 Hz で引き、8 Hz で震える"},
    {"yank", TextId::kSceneYank, "同じ布。指先が 5 m/s で 20 ms 動いて止まる"},
    {"shake", TextId::kSceneShake, "同じ布。指先が 30 cm 四方を 5 m/s でジグザグに動く"},
    {"bending", TextId::kSceneBending,
     "17 × 17、間隔 1 cm、重力なし。二行を固定し、先端を 4 cm 持ち上げて戻す"},
    {"corner_drape", TextId::kSceneCornerDrape,
     "17 cm 角の布。4 cm 角の隅を支える：論文の図 4 を本エンジンで"},
    {"grasp_and_lift", TextId::kSceneGraspAndLift,
     "33 × 33、間隔 1 cm、奥の辺を固定。手が隅を 15 cm 持ち上げて放す"},
    {"table_edge", TextId::kSceneTableEdge, "33 × 33、間隔 1 cm。机の上に留め、縁から垂らす"},
    {"drape_tester", TextId::kSceneDrapeTester,
     "直径 30 cm の円い試料を直径 18 cm の円板にのせ、水平から放す"},
};

}  // namespace

const char* scene_text(std::string_view scene, Language language) {
  for (const SceneText& entry : kSceneTexts)
    if (entry.scene == scene) return ui_text(entry.text, language);
  return nullptr;
}

std::string_view scene_description(const SceneEntry& scene, Language language) {
  if (language == Language::kJapanese)
    for (const SceneText& entry : kSceneTexts)
      if (entry.scene == scene.name) return entry.description_ja;
  return scene.description;
}

}  // namespace fuai
