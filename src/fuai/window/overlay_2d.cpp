// Lines of grabs, arrows and numbers of forces, colour bar, names, hint and messages over the cloths.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "fuai/experiments/scene_pictures.h"
#include "fuai/picture/plot_axis.h"
#include "fuai/units/constants.h"
#include "fuai/window/ui_style.h"
#include "fuai/window/viewer_state.h"
#include "fuai/window/viewer_work.h"

namespace fuai {
namespace {

ImVec2 flat(const Vec3& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

/// From blue for a tenth of a millinewton to red for ten newtons, dark on a light ground.
Colour force_colour(double share, bool dark) {
  if (dark) return {0.35 + 0.65 * share, 0.80 - 0.45 * share, 1.0 - 0.75 * share, 1.0};
  return {0.85 * share, 0.30 * (1.0 - share), 0.70 - 0.60 * share, 1.0};
}

/// On a plate, readable over cloth of any colour. @param wrap width of a line, 0: any @return its height
float write(ImDrawList& list, ImVec2 at, const std::string& text, bool dark, ImU32 colour,
            float wrap = 0.0F) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap > 0.0F ? wrap : -1.0F);
  const float rim = 0.2F * ImGui::GetFontSize();
  list.AddRectFilled({at.x - rim, at.y}, {at.x + size.x + rim, at.y + size.y},
                     dark ? IM_COL32(20, 22, 25, 215) : IM_COL32(250, 250, 248, 225), rim);
  list.AddText(nullptr, 0.0F, at, colour, text.c_str(), nullptr, wrap);
  return size.y;
}

void draw_head(ImDrawList& list, ImVec2 root, ImVec2 tip, float size, ImU32 colour) {
  const Vec2 way(static_cast<double>(tip.x - root.x), static_cast<double>(tip.y - root.y));
  if (way.norm() < 1e-3) return;
  const Vec2 ahead = static_cast<double>(size) * way.normalized(), aside(-0.5 * ahead.y(), 0.5 * ahead.x());
  const auto point = [&](const Vec2& v) {
    return ImVec2{tip.x + static_cast<float>(v.x()), tip.y + static_cast<float>(v.y())};
  };
  list.AddTriangleFilled(tip, point(aside - ahead), point(-aside - ahead), colour);
}

struct HandMark {
  GraspReading reading;
  Vec3 target = Vec3::Zero();
  bool pinned = false, user = true;
};

/// @return the force as it is written beside the hand; empty: it is not
std::string draw_hand(const ViewerState& state, ImDrawList& list, const ScreenTile& tile,
                      const HandMark& mark) {
  const float scale = state.settings.scale;
  const double force = mark.reading.force.norm(), share = force_share(force);
  const ImU32 colour = to_ui_colour(force_colour(share, state.settings.dark));
  const Vec3 patch = to_screen(state, tile, mark.reading.centre);
  if (patch.z() <= 0.0) return {};
  const float radius = (mark.pinned ? 4.0F : 6.0F) * scale;
  if (mark.user) {
    const Vec3 hand = to_screen(state, tile, mark.target);
    list.AddLine(flat(patch), flat(hand), colour, (1.5F + 3.0F * static_cast<float>(share)) * scale);
    list.AddCircleFilled(flat(hand), radius, colour);
    list.AddCircle(flat(hand), radius, state.settings.dark ? IM_COL32_WHITE : IM_COL32_BLACK);
  }
  ImVec2 label = flat(patch);
  if (state.settings.arrows && share > 0.0) {
    // The pull of the hand, against what it feels. As long on the screen as the force says, whatever the
    // zoom.
    const double reach = 0.25 * std::min(tile.width, tile.height) * share;
    const Vec3 far = to_screen(
        state, tile, mark.reading.centre - 0.05 * state.camera.distance() * mark.reading.force.normalized());
    const Vec2 way = (far - patch).head<2>();
    const double foreshortening = std::min(1.0, way.norm() / (0.05 * tile.height));
    const Vec2 tip = patch.head<2>() + (way.norm() > 1e-6 ? Vec2(way.normalized() * reach * foreshortening)
                                                          : Vec2(Vec2::Zero()));
    label = {static_cast<float>(tip.x()), static_cast<float>(tip.y())};
    list.AddLine(flat(patch), label, colour, 3.0F * scale);
    draw_head(list, flat(patch), label, 10.0F * scale, colour);
  }
  if (mark.pinned && force < 1e-3) return {};
  std::string text = force_text(force);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  // Beside the tip, on the side the arrow points to; inside the tile, at its upper left edge where it is too
  // small.
  if (label.x < flat(patch).x) label.x -= size.x + 20.0F * scale;
  const float right = static_cast<float>(tile.left + tile.width) - size.x - 4.0F;
  const float low = static_cast<float>(tile.top + tile.height) - size.y - 4.0F;
  const float x = std::max(std::min(label.x + 10.0F * scale, right), static_cast<float>(tile.left) + 4.0F);
  const float y = std::max(std::min(label.y - 8.0F * scale, low), static_cast<float>(tile.top) + 4.0F);
  write(list, {x, y}, text, state.settings.dark, colour);
  return text;
}

void draw_hands(ViewerState& state, ImDrawList& list, std::size_t cloth) {
  const ClothView& view = state.snapshot().cloths[cloth];
  const auto draw = [&](const std::string& hand, const HandMark& mark) {
    const std::string text = draw_hand(state, list, state.tiles[cloth], mark);
    if (!text.empty()) state.shown_forces.push_back({cloth, hand, text});
  };
  for (std::size_t i = 0; i < kMostViewHands; ++i) {
    if (!view.hands[i].holds) continue;
    // What is dragged stays under the cursor; the cloth has heard of the last move only after this picture.
    const bool dragged = state.drag.kind == Drag::Kind::kHand && state.drag.hand == static_cast<int>(i);
    draw(std::to_string(i), {view.hands[i], dragged ? state.hands.hand(i).target : view.targets[i],
                             state.hands.hand(i).pinned, true});
  }
  for (std::size_t i = 0; i < kMostHands; ++i) {
    const GraspReading& reading = view.scene_hands[i];
    if (reading.holds) draw("scene " + std::to_string(i), {reading, reading.centre, false, false});
  }
}

/// Where the hand of the device is, whether it holds or not.
void draw_device(const ViewerState& state, ImDrawList& list, std::size_t cloth) {
  const ShownDevice& device = state.device;
  if (device.model.empty() || device.view.rate == 0.0) return;
  const Vec3 at = to_screen(state, state.tiles[cloth], device.view.tool);
  if (at.z() <= 0.0) return;
  const float scale = state.settings.scale;
  const ImU32 ink = state.settings.dark ? IM_COL32_WHITE : IM_COL32_BLACK;
  const ImU32 colour = device.view.away ? IM_COL32(128, 128, 128, 255) : IM_COL32(255, 170, 40, 255);
  list.AddCircle(flat(at), 9.0F * scale, ink, 0, 4.0F * scale);
  list.AddCircle(flat(at), 9.0F * scale, colour, 0, 2.0F * scale);
  list.AddCircleFilled(flat(at), 2.0F * scale, colour);
}

/// Name, mark of the device and faults of a cloth, below each other. @return where they end [pixel]
float draw_name(const ViewerState& state, ImDrawList& list, std::size_t cloth) {
  const ViewFabric& fabric = state.built.fabrics[cloth];
  const ScreenTile& tile = state.tiles[cloth];
  const float unit = ImGui::GetFontSize();
  const float wrap = std::max(static_cast<float>(tile.width) - 1.4F * unit, unit);
  ImVec2 at{static_cast<float>(tile.left) + 0.7F * unit, static_cast<float>(tile.top) + 0.5F * unit};
  const auto line = [&](const std::string& text, ImU32 colour) {
    at.y += write(list, at, text, state.settings.dark, colour, wrap) + 0.3F * unit;
  };
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  std::string name = fabric.measured.name;
  if (fabric.changed()) name += std::string(" (") + state.text(TextId::kChanged) + ")";
  if (state.tiles.size() > 1) name = std::to_string(cloth + 1) + "  " + name;
  line(name, ink);
  if (state.tiles.size() > 1 && cloth == state.felt && (!state.device.model.empty() || state.rumbles))
    line(std::string("● ") + state.text(TextId::kFeltNow), ink);
  if (state.snapshot().cloths[cloth].failed_steps > 0)
    line(state.text(TextId::kBadNumbers), ImGui::ColorConvertFloat4ToU32(alarm_colour(state.settings.dark)));
  if (state.tiles.size() > 1)
    list.AddRect({static_cast<float>(tile.left), static_cast<float>(tile.top)},
                 {static_cast<float>(tile.left + tile.width), static_cast<float>(tile.top + tile.height)},
                 ImGui::GetColorU32(ImGuiCol_Separator));
  return at.y;
}

/// At the right of the last tile. @param below where the tile's name ends [pixel]
void draw_colour_bar(const ViewerState& state, ImDrawList& list, float below) {
  if (state.settings.heat_map < 0 || state.tiles.empty()) return;
  const ViewQuantity& quantity = view_quantities()[static_cast<std::size_t>(state.settings.heat_map)];
  const ViewUnit& unit = quantity.unit(state.settings.units);
  const HeatRange range = heat_range(state);
  const ScreenTile& tile = state.tiles.back();
  const float em = ImGui::GetFontSize();
  const float height = std::min(0.5F * static_cast<float>(tile.height), 16.0F * em), width = 1.1F * em;
  const Axis axis = make_axis(range.low / unit.to_si, range.high / unit.to_si, false,
                              std::max(2, static_cast<int>(height / (2.0F * em))));
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  std::string title = std::string(state.text(quantity.name)) + " [" + unit.text + "]";
  if (!axis.factor.empty()) title += " " + axis.factor;
  const float title_width = ImGui::CalcTextSize(title.c_str()).x;
  const auto edge = static_cast<float>(tile.left + tile.width);
  float top = static_cast<float>(tile.top) + em;
  // Beside the name where there is room, else below it.
  const float name_width =
      ImGui::CalcTextSize(state.built.fabrics.back().measured.name.c_str()).x + 10.0F * em;
  if (name_width + title_width > static_cast<float>(tile.width)) top = std::max(top, below);
  write(list, {std::max(edge - title_width - 0.7F * em, static_cast<float>(tile.left) + 0.4F * em), top},
        title, state.settings.dark, ink);
  top += 1.6F * em;
  const float right = edge - 5.0F * em;
  const ColourMap map = is_signed(quantity.field) ? ColourMap::kDiverging : ColourMap::kSequential;
  constexpr int kStripes = 64;
  for (int i = 0; i < kStripes; ++i) {
    const float y0 = top + height * static_cast<float>(i) / kStripes;
    list.AddRectFilled({right - width, y0}, {right, y0 + height / kStripes + 1.0F},
                       to_ui_colour(sample_colour_map(map, 1.0 - (i + 0.5) / kStripes)));
  }
  for (const Tick& tick : axis.ticks) {
    if (tick.label.empty()) continue;
    const float y = top + height * (1.0F - static_cast<float>(axis.place(tick.value)));
    list.AddLine({right, y}, {right + 4.0F, y}, ink);
    write(list, {right + 7.0F, y - 0.5F * em}, tick.label, state.settings.dark, ink);
  }
}

void draw_notes(const ViewerState& state, ImDrawList& list) {
  if (state.tiles.empty()) return;
  const float em = ImGui::GetFontSize();
  const float rim = 0.3F * em;
  const ViewBox view = lay_out(state).view;
  const auto centred = [&](const char* text, float y, ImU32 colour) {
    const ImVec2 size = ImGui::CalcTextSize(text, nullptr, false, view.width - 2.0F * em);
    const float x = view.left + 0.5F * (view.width - size.x);
    list.AddRectFilled({x - 0.6F * em, y - rim}, {x + size.x + 0.6F * em, y + size.y + rim},
                       ImGui::GetColorU32(ImGuiCol_WindowBg), 4.0F);
    list.AddText(nullptr, 0.0F, {x, y}, colour, text, nullptr, view.width - 2.0F * em);
    return size.y + 0.9F * em;
  };
  float y = view.top + view.height - 2.2F * em;
  std::vector<std::string> hints;  // each with the lines before it
  std::vector<float> heights;
  for (const TextId line : state.steps.lines()) {
    hints.push_back((hints.empty() ? "" : hints.back() + "\n") + state.text(line));
    heights.push_back(ImGui::CalcTextSize(hints.back().c_str(), nullptr, false, view.width - 2.0F * em).y +
                      2.0F * rim);
  }
  const std::size_t fitting = lines_that_fit(view, heights);
  const std::string hint = fitting > 0 ? hints[fitting - 1] : "";
  if (!hint.empty()) {
    const ImVec2 size = ImGui::CalcTextSize(hint.c_str(), nullptr, false, view.width - 2.0F * em);
    y -= centred(hint.c_str(), y - size.y + em, ImGui::GetColorU32(ImGuiCol_Text));
  }
  for (auto m = state.messages.rbegin(); m != state.messages.rend(); ++m) {
    const ImVec2 size = ImGui::CalcTextSize(m->text.c_str(), nullptr, false, view.width - 2.0F * em);
    const ImU32 colour = m->bad ? ImGui::ColorConvertFloat4ToU32(alarm_colour(state.settings.dark))
                                : ImGui::GetColorU32(ImGuiCol_Text);
    y -= centred(m->text.c_str(), y - size.y + em, colour);
  }
}

}  // namespace

std::string force_text(double newtons) {
  char text[64];
  if (newtons < 1.0)
    std::snprintf(text, sizeof text, "%.1f mN   %.2f gf", 1e3 * newtons, newtons / unit::kGramForce);
  else
    std::snprintf(text, sizeof text, "%.3f N   %.1f gf", newtons, newtons / unit::kGramForce);
  return text;
}

void draw_overlay_2d(ViewerState& state) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ViewSnapshot& snapshot = state.snapshot();
  state.shown_forces.clear();
  draw_notes(state, list);  // below the forces, which are to be read whatever is told besides
  float below = 0.0F;       // the name of the last cloth
  for (std::size_t i = 0; i < std::min(state.tiles.size(), snapshot.cloths.size()); ++i) {
    const ScreenTile& tile = state.tiles[i];
    list.PushClipRect(
        {static_cast<float>(tile.left), static_cast<float>(tile.top)},
        {static_cast<float>(tile.left + tile.width), static_cast<float>(tile.top + tile.height)});
    draw_hands(state, list, i);
    draw_device(state, list, i);
    below = draw_name(state, list, i);
    list.PopClipRect();
  }
  draw_colour_bar(state, list, below);
}

}  // namespace fuai
