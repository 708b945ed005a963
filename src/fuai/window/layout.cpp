// Where panels and cloths lie.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "fuai/window/viewer_state.h"

namespace fuai {
namespace {

/// Of the window [heights of a letter].
constexpr float kLeastWidthForNumbers = 30.0F, kLeastWidthForPlots = 50.0F, kLeastHeightForPlots = 30.0F;
/// Of the height of the view, that a hint may hide.
constexpr float kMostHint = 0.2F;

}  // namespace

ViewLayout lay_out(const ViewerState& state) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float unit = ImGui::GetFontSize();
  const int lines = (state.device.asked.empty() ? 0 : 1) + (state.replay ? 1 : 0);  // beyond the usual
  const float top = ImGui::GetFrameHeight(), bottom = (4.6F + 1.4F * static_cast<float>(lines)) * unit;
  // In a small window the cloth comes first: a panel that could not be read is left out.
  const bool numbers = state.settings.fabric_panel && size.x >= kLeastWidthForNumbers * unit;
  const bool plots =
      state.settings.plots && size.x >= kLeastWidthForPlots * unit && size.y >= kLeastHeightForPlots * unit;
  // Alone it may have more of a narrow window: numbers and their units stand in a row.
  const float left = numbers ? std::min(21.0F * unit, (plots ? 0.3F : 0.45F) * size.x) : 0.0F;
  // Four columns of numbers are wider than the plots below them.
  const bool many = state.document.setup().fabrics.size() > 3;
  const float right = plots ? std::min((many ? 27.0F : 23.0F) * unit, 0.3F * size.x) : 0.0F;
  const float height = std::max(size.y - top - bottom, 1.0F);
  ViewLayout layout;
  layout.fabric = {0.0F, top, left, height};
  layout.plots = {size.x - right, top, right, height};
  layout.time = {0.0F, size.y - bottom, size.x, bottom};
  layout.view = {left, top, std::max(size.x - left - right, 1.0F), height};
  return layout;
}

std::size_t lines_that_fit(const ViewBox& view, std::span<const float> heights) {
  return static_cast<std::size_t>(
      std::ranges::count_if(heights, [&](float height) { return height <= kMostHint * view.height; }));
}

bool begin_panel(const char* name, const ViewBox& box, bool scrolls) {
  ImGui::SetNextWindowPos({box.left, box.top});
  ImGui::SetNextWindowSize({box.width, box.height});
  ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                           ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
  if (!scrolls) flags |= ImGuiWindowFlags_NoScrollbar;
  // Square: behind a round corner nothing is drawn.
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
  const bool begun = ImGui::Begin(name, nullptr, flags);
  ImGui::PopStyleVar();
  return begun;
}

std::vector<ScreenTile> make_tiles(const ViewBox& box, std::size_t count) {
  const auto n = static_cast<int>(std::max<std::size_t>(count, 1));
  // As many columns as make the tiles least elongated.
  int columns = 1;
  double best = 1e9;
  for (int c = 1; c <= n; ++c) {
    const int rows = (n + c - 1) / c;
    const double aspect = (static_cast<double>(box.width) / c) / (static_cast<double>(box.height) / rows);
    // A further line in the bar below must not turn rows into columns: narrow tiles cut the cloth.
    constexpr double kColumn = 0.15, kHole = 0.3;
    const double badness = std::abs(std::log(aspect)) + kHole * (rows * c - n) + kColumn * (c - 1);
    if (badness < best) {
      best = badness;
      columns = c;
    }
  }
  const int rows = (n + columns - 1) / columns;
  const int width = std::max(static_cast<int>(box.width) / columns, 16);
  const int height = std::max(static_cast<int>(box.height) / rows, 16);
  std::vector<ScreenTile> tiles;
  tiles.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    tiles.push_back({static_cast<int>(box.left) + (i % columns) * width,
                     static_cast<int>(box.top) + (i / columns) * height, width, height});
  return tiles;
}

Vec3 to_screen(const ViewerState& state, const ScreenTile& tile, const Vec3& point) {
  const Vec3 pixel = project_to_pixel(state.camera.camera(), tile.width, tile.height, point);
  return {pixel.x() + tile.left, pixel.y() + tile.top, pixel.z()};
}

}  // namespace fuai
