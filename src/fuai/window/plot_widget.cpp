// A plot by lines and texts of ImGui.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/plot_widget.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "fuai/picture/plot_axis.h"
#include "fuai/window/ui_style.h"

namespace fuai {
namespace {

/// Smallest range of the finite numbers, a little widened; around zero when there is none.
Range range_of(const Plot& plot, bool vertical) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Series& series : plot.series) {
    for (const double value : vertical ? series.y : series.x) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!(low <= high)) return {0.0, 1.0};
  const double margin = std::max(0.05 * (high - low), 1e-9 + 1e-6 * std::abs(high));
  return {low - margin, high + margin};
}

struct Frame {
  ImVec2 low, high;  // corners of the axes on the screen, y downward
  Axis x, y;

  ImVec2 at(double vx, double vy) const {
    return {low.x + static_cast<float>(x.place(vx)) * (high.x - low.x),
            high.y - static_cast<float>(y.place(vy)) * (high.y - low.y)};
  }
};

std::string with_factor(const std::string& label, const Axis& axis) {
  return label + (axis.factor.empty() ? "" : " " + axis.factor);
}

void draw_axes(ImDrawList& list, const Frame& f, const Plot& plot, ImU32 ink, ImU32 grid) {
  const float line = ImGui::GetTextLineHeight();
  for (const Tick& tick : f.x.ticks) {
    if (tick.label.empty()) continue;
    const float x = f.at(tick.value, f.y.low).x;
    list.AddLine({x, f.low.y}, {x, f.high.y}, grid);
    const ImVec2 size = ImGui::CalcTextSize(tick.label.c_str());
    list.AddText({x - 0.5F * size.x, f.high.y + 2.0F}, ink, tick.label.c_str());
  }
  for (const Tick& tick : f.y.ticks) {
    if (tick.label.empty()) continue;
    const float y = f.at(f.x.low, tick.value).y;
    list.AddLine({f.low.x, y}, {f.high.x, y}, grid);
    const ImVec2 size = ImGui::CalcTextSize(tick.label.c_str());
    list.AddText({f.low.x - size.x - 4.0F, y - 0.5F * size.y}, ink, tick.label.c_str());
  }
  list.AddRect(f.low, f.high, ink);
  const std::string x_label = with_factor(plot.x_label, f.x), y_label = with_factor(plot.y_label, f.y);
  const float width = ImGui::CalcTextSize(x_label.c_str()).x;
  list.AddText({f.high.x - width, f.high.y + 2.0F + line}, ink, x_label.c_str());
  list.AddText({f.low.x, f.low.y - line - 2.0F}, ink, y_label.c_str());
}

/// The part of a way from a to b that is between two places of an axis, as shares of the way.
Range part_between(float a, float b, float low, float high) {
  if (std::abs(b - a) < 1e-6F) return a < low || a > high ? Range{1.0, 0.0} : Range{0.0, 1.0};
  const double s = static_cast<double>((low - a) / (b - a)), t = static_cast<double>((high - a) / (b - a));
  return {std::max(0.0, std::min(s, t)), std::min(1.0, std::max(s, t))};
}

/// Dashes as long on the screen however near one looks. @param run length of the line before [pixel]
void draw_dashes(ImDrawList& list, const Frame& f, ImVec2 from, ImVec2 to, double run, double period,
                 ImU32 colour, float width) {
  const Range x = part_between(from.x, to.x, f.low.x, f.high.x),
              y = part_between(from.y, to.y, f.low.y, f.high.y);
  const double length = static_cast<double>(std::hypot(to.x - from.x, to.y - from.y));
  const double begin = run + length * std::max(x.low, y.low), end = run + length * std::min(x.high, y.high);
  const auto at = [&](double way) {
    const auto share = static_cast<float>((way - run) / length);
    return ImVec2{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
  };
  for (double dash = std::floor(begin / period) * period; dash < end; dash += period) {
    const double a = std::max(dash, begin), b = std::min(dash + 0.6 * period, end);
    if (a < b) list.AddLine(at(a), at(b), colour, width);
  }
}

void draw_series(ImDrawList& list, const Frame& f, const Series& series, int place) {
  const ImU32 colour = to_ui_colour(series_colour(series.colour < 0 ? place : series.colour));
  const bool points = series.style == SeriesStyle::kPoints || series.style == SeriesStyle::kLineAndPoints;
  const bool lines = series.style != SeriesStyle::kPoints;
  const bool dashed = series.style == SeriesStyle::kDashed;
  const float scale = ImGui::GetFontSize() / 15.0F;
  const float width = scale * (dashed ? 1.3F : static_cast<float>(series.line_width));
  double run = 0.0;  // [pixel]
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
    const ImVec2 here = f.at(series.x[i], series.y[i]);
    if (points) list.AddCircleFilled(here, 3.0F * scale, colour, 8);
    if (!lines || i == 0 || !std::isfinite(series.x[i - 1]) || !std::isfinite(series.y[i - 1])) continue;
    const ImVec2 before = f.at(series.x[i - 1], series.y[i - 1]);
    if (dashed) {
      draw_dashes(list, f, before, here, run, 10.0 * static_cast<double>(scale), colour, width);
      run += static_cast<double>(std::hypot(here.x - before.x, here.y - before.y));
    } else {
      list.AddLine(before, here, colour, width);
    }
  }
}

/// In the row of the name of the x axis, where no curve runs.
void draw_legend(ImDrawList& list, const Frame& f, const Plot& plot, ImU32 ink) {
  const float line = ImGui::GetTextLineHeight();
  const float y = f.high.y + 2.0F + line;
  const auto advance = [&](const Series& series) {
    return series.label.empty() ? 0.0F : 1.6F * line + ImGui::CalcTextSize(series.label.c_str()).x;
  };
  float width = ImGui::CalcTextSize(with_factor(plot.x_label, f.x).c_str()).x + 0.3F * line;
  for (const Series& series : plot.series) width += advance(series);
  float x = std::min(f.low.x, f.high.x - width);  // in a narrow plot under the numbers of the other axis
  int place = 0;
  for (const Series& series : plot.series) {
    const int colour = series.colour < 0 ? place : series.colour;
    ++place;
    if (series.label.empty()) continue;
    const ImU32 tint = to_ui_colour(series_colour(colour));
    list.AddLine({x, y + 0.55F * line}, {x + 0.9F * line, y + 0.55F * line}, tint, 0.15F * line);
    list.AddText({x + 1.1F * line, y}, ink, series.label.c_str());
    x += advance(series);
  }
}

/// In the middle of the axes, instead of a curve.
void draw_instead(ImDrawList& list, const Frame& f, const char* text, ImU32 ink) {
  const float width = f.high.x - f.low.x - ImGui::GetTextLineHeight();
  const ImVec2 size = ImGui::CalcTextSize(text, nullptr, false, width);
  list.AddText(nullptr, 0.0F, {0.5F * (f.low.x + f.high.x - size.x), 0.5F * (f.low.y + f.high.y - size.y)},
               ink, text, nullptr, width);
}

}  // namespace

bool draw_plot(const Plot& plot, const PlotWidget& widget) {
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight();
  ImGui::PushID(&plot);
  ImGui::InvisibleButton("plot", {widget.width, widget.height});
  const bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
  ImGui::PopID();
  Frame f;
  f.low = {origin.x + 4.2F * line, origin.y + 1.3F * line};
  f.high = {origin.x + widget.width - 0.6F * line, origin.y + widget.height - 2.4F * line};
  if (f.high.x - f.low.x < 20.0F || f.high.y - f.low.y < 20.0F) return clicked;
  const Range x = plot.x_range.value_or(range_of(plot, false)),
              y = plot.y_range.value_or(range_of(plot, true));
  const auto ticks = [&](float pixels, float each) { return std::max(2, static_cast<int>(pixels / each)); };
  f.x = make_axis(x.low, x.high, false, ticks(f.high.x - f.low.x, 4.5F * line));
  f.y = make_axis(y.low, y.high, false, ticks(f.high.y - f.low.y, 2.2F * line));

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text), grid = ImGui::GetColorU32(ImGuiCol_Separator, 0.45F);
  list.AddRectFilled(f.low, f.high, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.5F));
  draw_axes(list, f, plot, ink, grid);
  list.PushClipRect(f.low, f.high, true);
  int place = 0;
  for (const Series& series : plot.series) draw_series(list, f, series, place++);
  list.PopClipRect();
  if (widget.instead != nullptr &&
      std::ranges::all_of(plot.series, [](const Series& s) { return s.x.empty(); }))
    draw_instead(list, f, widget.instead, ink);
  if (plot.legend) draw_legend(list, f, plot, ink);
  if (!plot.title.empty()) {
    const float width = ImGui::CalcTextSize(plot.title.c_str()).x;
    list.AddText({f.high.x - width, origin.y}, ink, plot.title.c_str());
  }
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (hovered && mouse.x >= f.low.x && mouse.x <= f.high.x && mouse.y >= f.low.y && mouse.y <= f.high.y) {
    const double px = f.x.low + (f.x.high - f.x.low) * (mouse.x - f.low.x) / (f.high.x - f.low.x);
    const double py = f.y.low + (f.y.high - f.y.low) * (f.high.y - mouse.y) / (f.high.y - f.low.y);
    char values[64];
    std::snprintf(values, sizeof values, "%.4g\n", px);
    std::string text = plot.x_label + ": " + values;
    std::snprintf(values, sizeof values, "%.4g", py);
    text += plot.y_label + ": " + values;
    if (widget.hint != nullptr) text += std::string("\n") + widget.hint;
    wrapped_tooltip(text);
  }
  return clicked;
}

}  // namespace fuai
