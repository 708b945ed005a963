// The menu bar: scene, fabrics, what is shown, files.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include <cstdio>

#include "fuai/scenes/catalogue.h"
#include "fuai/window/scene_text.h"
#include "fuai/window/ui_style.h"
#include "fuai/window/viewer_state.h"
#include "fuai/window/viewer_work.h"

namespace fuai {
namespace {

void entry(ViewerState& state, KeyAction action, TextId text, bool enabled = true) {
  if (ImGui::MenuItem(state.text(text), key_label(action), false, enabled)) act(state, action);
}

void check(ViewerState& state, KeyAction action, TextId text, bool on) {
  if (ImGui::MenuItem(state.text(text), key_label(action), on)) act(state, action);
}

void file_menu(ViewerState& state) {
  if (!ImGui::BeginMenu(state.text(TextId::kFile))) return;
  entry(state, KeyAction::kOpen, TextId::kKeyOpen);
  entry(state, KeyAction::kSave, TextId::kKeySave);
  ImGui::Separator();
  entry(state, KeyAction::kScreenshot, TextId::kKeyScreenshot);
  ImGui::Checkbox(state.text(TextId::kTransparent), &state.settings.transparent);
  ImGui::Checkbox(state.text(TextId::kCaption), &state.settings.caption);
  check(state, KeyAction::kVideo, TextId::kKeyVideo, state.filming);
  check(state, KeyAction::kRecord, TextId::kKeyRecord, state.recording);
  ImGui::Separator();
  if (ImGui::MenuItem(state.text(TextId::kMesh))) state.wishes.obj = true;
  if (ImGui::MenuItem(state.text(TextId::kMeshGltf))) state.wishes.gltf = true;
  if (ImGui::MenuItem(state.text(TextId::kForceLog), nullptr, state.logging)) state.wishes.force_log = true;
  ImGui::Separator();
  entry(state, KeyAction::kQuit, TextId::kKeyQuit);
  ImGui::EndMenu();
}

void edit_menu(ViewerState& state) {
  if (!ImGui::BeginMenu(state.text(TextId::kEdit))) return;
  entry(state, KeyAction::kUndo, TextId::kKeyUndo, state.document.can_undo());
  entry(state, KeyAction::kRedo, TextId::kKeyRedo, state.document.can_redo());
  entry(state, KeyAction::kReleaseAll, TextId::kKeyReleaseAll);
  ImGui::EndMenu();
}

void view_menu(ViewerState& state) {
  ViewSettings& s = state.settings;
  if (!ImGui::BeginMenu(state.text(TextId::kView))) return;
  check(state, KeyAction::kInfo, TextId::kKeyInfo, s.fabric_panel);
  check(state, KeyAction::kPlots, TextId::kKeyPlots, s.plots);
  check(state, KeyAction::kArrows, TextId::kKeyArrows, s.arrows);
  check(state, KeyAction::kLines, TextId::kKeyLines, s.lines);
  check(state, KeyAction::kYarns, TextId::kKeyYarns, s.yarns);
  check(state, KeyAction::kGround, TextId::kKeyGround, s.ground);
  ImGui::Separator();
  entry(state, KeyAction::kUnits, TextId::kKeyUnits);
  entry(state, KeyAction::kLanguage, TextId::kKeyLanguage);
  entry(state, KeyAction::kTheme, TextId::kKeyTheme);
  if (ImGui::BeginMenu(state.text(TextId::kLetterSize))) {
    for (const int letters : {75, 100, 125, 150, 200, 300}) {
      char text[16];
      std::snprintf(text, sizeof text, "%d %%", letters);
      if (!ImGui::MenuItem(text, nullptr, s.letters == letters)) continue;
      s.letters = letters;
      state.wishes.new_scale = true;
    }
    ImGui::EndMenu();
  }
  entry(state, KeyAction::kFrame, TextId::kKeyFrame);
  entry(state, KeyAction::kFullScreen, TextId::kKeyFullScreen);
  ImGui::EndMenu();
}

/// In a narrow window the bar has the lists alone: no names before them, and what the View menu has as well
/// is left out.
bool is_narrow() { return ImGui::GetIO().DisplaySize.x < 55.0F * ImGui::GetFontSize(); }

void scene_choice(ViewerState& state) {
  if (!is_narrow()) ImGui::TextUnformatted(state.text(TextId::kScene));
  ImGui::SetNextItemWidth((is_narrow() ? 8.0F : 10.0F) * ImGui::GetFontSize());
  const std::string& now = state.document.setup().scene;
  const char* known = scene_text(now, state.settings.language);
  if (!ImGui::BeginCombo("##scene", known != nullptr ? known : now.c_str(), ImGuiComboFlags_HeightLarge))
    return;
  std::string chosen;
  for (const SceneEntry& scene : scene_entries()) {
    if (scene.kind != SceneKind::kEngine) continue;
    const std::string name(scene.name);
    const char* text = scene_text(name, state.settings.language);
    if (ImGui::Selectable(text != nullptr ? text : name.c_str(), name == now)) chosen = name;
    if (ImGui::IsItemHovered())
      wrapped_tooltip(name + ": " + std::string(scene_description(scene, state.settings.language)));
  }
  ImGui::EndCombo();
  if (!chosen.empty() && chosen != now) set_view_scene(state, chosen);
}

void heat_choice(ViewerState& state) {
  ViewSettings& s = state.settings;
  const char* now = s.heat_map < 0 ? state.text(TextId::kHeatNone)
                                   : state.text(view_quantities()[static_cast<std::size_t>(s.heat_map)].name);
  if (!is_narrow()) ImGui::TextUnformatted(state.text(TextId::kHeatMap));
  ImGui::SetNextItemWidth(9.0F * ImGui::GetFontSize());
  if (ImGui::BeginCombo("##heat", now, ImGuiComboFlags_HeightLarge)) {
    if (ImGui::Selectable(state.text(TextId::kHeatNone), s.heat_map < 0)) s.heat_map = -1;
    for (const ViewQuantity& q : view_quantities())
      if (ImGui::Selectable(state.text(q.name), s.heat_map == static_cast<int>(q.field)))
        s.heat_map = static_cast<int>(q.field);
    ImGui::EndCombo();
  }
  if (s.heat_map < 0) return;
  const ViewUnit& unit = view_quantities()[static_cast<std::size_t>(s.heat_map)].unit(s.units);
  if (ImGui::Checkbox(state.text(TextId::kAutoRange), &s.auto_range) && !s.auto_range)
    s.range = heat_range(state).high;
  if (s.auto_range) return;
  auto range = static_cast<float>(s.range / unit.to_si);
  ImGui::SetNextItemWidth(6.0F * ImGui::GetFontSize());
  if (ImGui::InputFloat(unit.text, &range, 0.0F, 0.0F, "%.4g") && range > 0.0F)
    s.range = static_cast<double>(range) * unit.to_si;
}

}  // namespace

void draw_menu(ViewerState& state) {
  if (!ImGui::BeginMainMenuBar()) return;
  file_menu(state);
  edit_menu(state);
  view_menu(state);
  if (ImGui::MenuItem(state.text(TextId::kHelp), key_label(KeyAction::kHelp))) act(state, KeyAction::kHelp);
  ImGui::Separator();
  scene_choice(state);
  heat_choice(state);
  const char* other =
      ui_text(TextId::kLanguageName,
              state.settings.language == Language::kEnglish ? Language::kJapanese : Language::kEnglish);
  if (!is_narrow() && ImGui::MenuItem(other, key_label(KeyAction::kLanguage)))
    act(state, KeyAction::kLanguage);
  ImGui::EndMainMenuBar();
}

}  // namespace fuai
