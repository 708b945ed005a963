// Every key and button, and the file panel.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fuai/window/viewer_state.h"

namespace fuai {
namespace {

void centre_window(float width, float height) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5F * size.x, 0.5F * size.y}, ImGuiCond_Appearing, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(width, 0.95F * size.x), std::min(height, 0.9F * size.y)},
                           ImGuiCond_Appearing);
}

/// Folders first, then the files that can be opened, by name.
struct Listing {
  std::vector<std::string> folders, files;
};

Listing list_folder(const std::filesystem::path& folder) {
  Listing listing;
  std::error_code code;
  for (std::filesystem::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
    const std::filesystem::directory_entry& entry = *at;
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    std::error_code ignored;
    if (entry.is_directory(ignored)) listing.folders.push_back(name);
    const std::string kind = entry.path().extension().string();
    if (kind == ".toml" || kind == ".csv" || kind == ".txt" || kind == ".json" || kind == kViewLogEnding)
      listing.files.push_back(name);
  }
  std::sort(listing.folders.begin(), listing.folders.end());
  std::sort(listing.files.begin(), listing.files.end());
  return listing;
}

void key_row(const ViewerState& state, const KeyRow& row) {
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(row.label);
  ImGui::TableNextColumn();
  ImGui::TextWrapped("%s", state.text(row.what));
}

}  // namespace

void draw_help(ViewerState& state) {
  if (!state.settings.help) return;
  const float em = ImGui::GetFontSize();
  centre_window(66.0F * em, 28.0F * em);
  const std::string title = std::string(state.text(TextId::kKeyHelp)) + "###help";
  if (ImGui::Begin(title.c_str(), &state.settings.help,
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse)) {
    // Each key once, in two halves side by side, so that all of them are seen at 1280 x 720.
    std::vector<const KeyRow*> rows;
    for (const KeyRow& row : key_table())
      if (rows.empty() || row.key == 0 || std::string_view(row.label) != rows.back()->label)
        rows.push_back(&row);
    const std::size_t half = (rows.size() + 1) / 2;
    if (ImGui::BeginTable("keys", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV)) {
      for (const char* name : {"left", "right"}) {
        ImGui::TableSetupColumn((std::string("key ") + name).c_str(), ImGuiTableColumnFlags_WidthFixed,
                                6.5F * em);
        ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthStretch);
      }
      for (std::size_t i = 0; i < half; ++i) {
        ImGui::TableNextRow();
        key_row(state, *rows[i]);
        if (half + i < rows.size()) key_row(state, *rows[half + i]);
      }
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

void draw_browser(ViewerState& state) {
  if (!state.browsing) return;
  const float em = ImGui::GetFontSize();
  centre_window(42.0F * em, 32.0F * em);
  const std::string title = std::string(state.text(TextId::kOpenFile)) + "###open";
  if (ImGui::Begin(title.c_str(), &state.browsing,
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse)) {
    namespace fs = std::filesystem;
    const fs::path folder(state.browse_folder);
    ImGui::TextWrapped("%s", state.text(TextId::kOpenHint));
    ImGui::TextDisabled("%s: %s", state.text(TextId::kFolder), state.browse_folder.c_str());
    fs::path next;
    if (ImGui::Selectable(state.text(TextId::kUp))) next = folder.parent_path();
    ImGui::Separator();
    if (ImGui::BeginChild("files")) {
      const Listing listing = list_folder(folder);
      for (const std::string& name : listing.folders)
        if (ImGui::Selectable((name + "/").c_str())) next = folder / name;
      for (const std::string& name : listing.files) {
        if (!ImGui::Selectable(name.c_str())) continue;
        state.wishes.open = (folder / name).string();
        state.browsing = false;
      }
    }
    ImGui::EndChild();
    if (!next.empty()) state.browse_folder = next.string();
  }
  ImGui::End();
}

}  // namespace fuai
