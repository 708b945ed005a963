// What the panels write is not cut off: both languages, from a small window to 4K, one fabric and four.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "fuai/window/ui_style.h"
#include "fuai/window/viewer_state.h"
#include "fuai/window/viewer_work.h"

namespace {

using namespace fuai;

/// ImGui with the fonts of the window. No screen: what would be drawn is looked at as triangles.
struct Ui {
  explicit Ui(float letters) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    REQUIRE(load_fonts(letters, {}).empty());
    apply_theme(true, letters / 15.0F);
    unsigned char* pixels = nullptr;
    int columns = 0, rows = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &columns, &rows);
  }
  Ui(const Ui&) = delete;
  Ui& operator=(const Ui&) = delete;
  ~Ui() { ImGui::DestroyContext(); }
};

void draw(ViewerState& state) {
  ImGui::NewFrame();
  state.tiles = make_tiles(lay_out(state).view, state.meshes.size());
  draw_menu(state);
  draw_fabric_panel(state);
  draw_plots_panel(state);
  draw_time_panel(state);
  draw_help(state);
  draw_overlay_2d(state);
  ImGui::Render();
}

/// A table that is wider than its panel has a bar to scroll it.
bool scrolls_sideways(const std::string& window) {
  const ImGuiWindow* found = ImGui::FindWindowByName(window.c_str());
  return found != nullptr && found->ScrollMax.x > 0.0F;
}

/// Names of the windows with a letter that its edge cuts: a pixel of it is on either side at least.
std::vector<std::string> cut_letters() {
  std::vector<std::string> found;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImDrawList& list = *data.CmdLists[l];
    const std::string owner = list._OwnerName != nullptr ? list._OwnerName : "";
    if (scrolls_sideways(owner)) continue;
    for (const ImDrawCmd& command : list.CmdBuffer) {
      for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
        const auto vertex = [&](unsigned k) -> const ImDrawVert& {
          const ImDrawIdx at = list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)];
          return list.VtxBuffer[static_cast<int>(command.VtxOffset + at)];
        };
        // Only letters take an area of the texture.
        const auto [v0, v1] = std::minmax({vertex(0).uv.y, vertex(1).uv.y, vertex(2).uv.y});
        const auto [u0, u1] = std::minmax({vertex(0).uv.x, vertex(1).uv.x, vertex(2).uv.x});
        if (v1 <= v0 || u1 <= u0) continue;
        // The dots of a shortened heading, which stick out by a pixel or two of nothing.
        const ImFontGlyph* dots = ImGui::GetIO().Fonts->Fonts[0]->FindGlyph(0x2026);
        if (u0 >= dots->U0 && u1 <= dots->U1 && v0 >= dots->V0 && v1 <= dots->V1) continue;
        const auto [left, right] = std::minmax({vertex(0).pos.x, vertex(1).pos.x, vertex(2).pos.x});
        const auto [top, bottom] = std::minmax({vertex(0).pos.y, vertex(1).pos.y, vertex(2).pos.y});
        const auto cut = [](float low, float high, float edge) {
          return low < edge - 1.0F && high > edge + 1.0F;
        };
        bool is_cut = cut(left, right, command.ClipRect.x) || cut(left, right, command.ClipRect.z);
        // Where it scrolls, lines may be cut.
        if (owner == "time" || owner == "##Background")
          is_cut = is_cut || cut(top, bottom, command.ClipRect.w);
        if (is_cut && std::ranges::find(found, owner) == found.end()) found.push_back(owner);
      }
    }
  }
  return found;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += name + " ";
  return text;
}

/// Everything that a window may tell at once.
std::unique_ptr<ViewerState> busy_state(std::size_t fabrics) {
  const std::vector<std::string> all{"cupro-woven-su1098", "wool-tropical", "graded-10", "polyester-faille"};
  const std::vector<std::string> some(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(fabrics));
  auto state = std::make_unique<ViewerState>(make_view_setup("hanging_sheet", some, {9, 0.02}));
  begin_session(*state);
  state->session->tick(0.0);
  take_snapshot(*state);
  state->real_time_factor = 0.5;
  state->clock = 10.0;
  state->recording = true;
  state->device.asked = "simulated";
  state->device.model = "3D Systems Touch";
  state->device.gives_force = true;
  state->device.view.rate = 1000.0;
  return state;
}

}  // namespace

TEST_SUITE("property") {
  TEST_CASE("No letter of a panel is cut at its side") {
    std::vector<std::unique_ptr<ViewerState>> states;
    for (const std::size_t fabrics : {1, 2, 4}) states.push_back(busy_state(fabrics));
    struct Size {
      float width, height, letters;
    };
    constexpr Size kSizes[] = {{640, 480, 15},   {900, 600, 15},   {1280, 720, 15}, {1280, 720, 11},
                               {1920, 1080, 23}, {3840, 2160, 15}, {3840, 2160, 30}};
    for (const Size& size : kSizes) {
      const Ui ui(size.letters);
      ImGui::GetIO().DisplaySize = {size.width, size.height};
      for (const auto& state : states) {
        for (const Language language : {Language::kEnglish, Language::kJapanese}) {
          for (const int heat_map : {-1, 5}) {
            CAPTURE(state->meshes.size());
            CAPTURE(size.width);
            CAPTURE(size.letters);
            CAPTURE(heat_map);
            CAPTURE((language == Language::kJapanese));
            state->settings.language = language;
            state->settings.heat_map = heat_map;
            // Tables know their columns, and windows are seen, from the second picture on.
            for (int i = 0; i < 3; ++i) draw(*state);
            CHECK(joined(cut_letters()) == "");
          }
        }
      }
    }
  }
}
