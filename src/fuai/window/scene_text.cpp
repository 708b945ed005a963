// The table of scenes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/scene_text.h"

namespace fuai {
namespace {

struct SceneText {
  std::string_view scene;
  TextId text;
};
constexpr SceneText kSceneTexts[] = {
    {"hanging_sheet", TextId::kSceneHangingSheet},
    {"hanging_strip", TextId::kSceneHangingStrip},
    {"taut_patch", TextId::kSceneTautPatch},
    {"yank", TextId::kSceneYank},
    {"shake", TextId::kSceneShake},
    {"bending", TextId::kSceneBending},
    {"corner_drape", TextId::kSceneCornerDrape},
    {"grasp_and_lift", TextId::kSceneGraspAndLift},
    {"table_edge", TextId::kSceneTableEdge},
    {"drape_tester", TextId::kSceneDrapeTester},
};

}  // namespace

const char* scene_text(std::string_view scene, Language language) {
  for (const SceneText& entry : kSceneTexts)
    if (entry.scene == scene) return ui_text(entry.text, language);
  return nullptr;
}

}  // namespace fuai
