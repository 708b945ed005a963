// The plots: force against time and way, and the live loops of the place that is held over the laws.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "fuai/experiments/fabric_plot.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/picture/plot_axis.h"
#include "fuai/units/constants.h"
#include "fuai/window/plot_widget.h"
#include "fuai/window/ui_style.h"
#include "fuai/window/viewer_state.h"

namespace fuai {
namespace {

double force_unit(const ViewerState& state) {
  return state.settings.units == UnitSystem::kKes ? unit::kGramForce : 1.0;
}

const char* force_label(const ViewerState& state) {
  return state.text(state.settings.units == UnitSystem::kKes ? TextId::kForceGram : TextId::kForceNewton);
}

/// Which of the moments a plot shows: those of the hand that holds now.
Plot force_plot(const ViewerState& state, bool against_way) {
  Plot plot;
  plot.title = state.text(against_way ? TextId::kForceWay : TextId::kForceTime);
  plot.x_label = state.text(against_way ? TextId::kWayMillimetre : TextId::kTimeSeconds);
  plot.y_label = force_label(state);
  const std::size_t count = state.built.fabrics.size();
  plot.legend = count > 1;
  double most = 0.0;
  for (std::size_t cloth = 0; cloth < count; ++cloth) {
    Series series;
    series.colour = static_cast<int>(cloth);
    if (count > 1) series.label = std::to_string(cloth + 1);
    for (const ForceMoment& m : state.forces) {
      if (cloth >= m.forces.size() || (against_way && m.hand < 0)) continue;
      series.x.push_back(against_way ? m.way / unit::kMillimetre : m.time);
      series.y.push_back(m.forces[cloth] / force_unit(state));
    }
    for (const double y : series.y) most = std::max(most, y);
    plot.series.push_back(std::move(series));
  }
  if (against_way) {
    double far = 1.0;  // [mm]
    for (const Series& series : plot.series)
      for (const double x : series.x) far = std::max(far, x);
    plot.x_range = Range{0.0, 1.05 * far};
  }
  // Not down to what rounding makes of nothing.
  constexpr double kLeastForce = 1e-3;  // [N]
  plot.y_range = Range{0.0, 1.05 * std::max(most, kLeastForce / force_unit(state))};
  return plot;
}

struct LoopPair {
  const PlayLaw* law;
  ClothProbe::Pair ClothProbe::*pair;
  Direction colour;
  TextId name;
};

std::vector<LoopPair> pairs_of(const FabricLaws& laws, PlottedLoop kind) {
  switch (kind) {
    case PlottedLoop::kBending:
      return {{laws.bending.data(), &ClothProbe::warp_bending, Direction::kWarp, TextId::kWarp},
              {&laws.bending[1], &ClothProbe::weft_bending, Direction::kWeft, TextId::kWeft}};
    case PlottedLoop::kShear:
      return {{&laws.shear, &ClothProbe::shear, Direction::kBias, TextId::kShear}};
    case PlottedLoop::kTension:
      break;
  }
  return {{laws.tensile.data(), &ClothProbe::warp_tension, Direction::kWarp, TextId::kWarp},
          {&laws.tensile[1], &ClothProbe::weft_tension, Direction::kWeft, TextId::kWeft}};
}

/// The steady loop of a law over the range of its instrument; of a tensile law a pull from rest and back.
SteadyLoop instrument_loop(const PlayLaw& law, PlottedLoop kind) {
  constexpr int kSamples = 41;
  if (kind == PlottedLoop::kBending) return steady_loop(law, kKesBendingRange, kSamples);
  if (kind == PlottedLoop::kShear) return steady_loop(law, kes_shear_range(), kSamples);
  SteadyLoop loop;
  PlayState memory;
  const double end = law.elastic().high();
  for (int i = 0; i < 2 * kSamples; ++i) {
    const double share = i < kSamples ? i / (kSamples - 1.0) : (2.0 * kSamples - 1 - i) / (kSamples - 1.0);
    loop.strain.push_back(share * end);
    loop.stress.push_back(law.advance(share * end, memory).stress);
  }
  return loop;
}

/// About the numbers, from zero where it is near, never of no width; none: nothing is known.
std::optional<Range> range_about(const std::vector<double>& numbers) {
  if (numbers.empty()) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(numbers);
  const double margin = std::max(0.1 * (high - low), 1e-3 * std::max(std::abs(low), std::abs(high)));
  if (!(margin > 0.0)) return std::nullopt;
  return Range{low - margin, high + margin};
}

/// The axes reach as far as what the cloth did.
void come_near(Plot& plot) {
  std::vector<double> x, y;
  for (const Series& series : plot.series) {
    if (series.style != SeriesStyle::kLine) continue;
    x.insert(x.end(), series.x.begin(), series.x.end());
    y.insert(y.end(), series.y.begin(), series.y.end());
  }
  plot.x_range = range_about(x);
  plot.y_range = range_about(y);
}

Plot loop_plot(const ViewerState& state, std::size_t cloth, PlottedLoop kind) {
  const LoopAxes axes = loop_axes(kind, state.settings.units);
  constexpr TextId kTitles[] = {TextId::kBending, TextId::kShear, TextId::kTension};
  Plot plot;
  plot.title = state.text(kTitles[static_cast<std::size_t>(kind)]);
  plot.x_label = state.text(axes.strain);
  plot.y_label = state.text(axes.stress);
  plot.legend = kind != PlottedLoop::kShear;
  for (const LoopPair& pair : pairs_of(state.laws[cloth], kind)) {
    const SteadyLoop loop = instrument_loop(*pair.law, kind);
    Series law;
    law.style = SeriesStyle::kDashed;
    law.colour = series_index(pair.colour);
    for (std::size_t i = 0; i < loop.strain.size(); ++i) {
      law.x.push_back(loop.strain[i] / axes.strain_to_si);
      law.y.push_back(loop.stress[i] / axes.stress_to_si);
    }
    Series live;
    live.colour = law.colour;
    live.line_width = 2.5;
    live.label = state.text(pair.name);
    for (const ForceMoment& m : state.forces) {
      if (!m.probed || cloth >= m.probes.size()) continue;
      const ClothProbe::Pair& p = m.probes[cloth].*pair.pair;
      live.x.push_back(p.strain / axes.strain_to_si);
      live.y.push_back(p.stress / axes.stress_to_si);
    }
    if (!live.x.empty()) {  // where it is now
      Series now;
      now.style = SeriesStyle::kPoints;
      now.colour = law.colour;
      now.x.push_back(live.x.back());
      now.y.push_back(live.y.back());
      plot.series.push_back(std::move(now));
    }
    plot.series.push_back(std::move(law));
    plot.series.push_back(std::move(live));
  }
  if (state.loops_near) come_near(plot);
  return plot;
}

/// "+25 %", from ten times on "×12".
std::string change_text(double change) {
  constexpr double kManyTimes = 9.0;
  if (change >= kManyTimes) return "×" + format_number(1.0 + change, 0);
  return (change < 0.0 ? "" : "+") + format_number(100.0 * change, 0) + " %";
}

std::string value_text(const ViewerState& state, const FabricNumber& number) {
  if (!number.known.has_value()) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.3g",
                state.settings.units == UnitSystem::kKes ? number.in_kes_units() : number.known.value);
  return text;
}

/// Of the columns, so that nothing in them is cut [pixel].
struct ComparisonWidths {
  float name = 0.0F, number = 0.0F;
};

ComparisonWidths comparison_widths(const ViewerState& state) {
  ComparisonWidths widths;
  // The line between columns, and what is lost when their widths become whole pixels.
  const float space = 2.0F * ImGui::GetStyle().CellPadding.x + 2.0F;
  const auto widen = [&](float& width, const std::string& text) {
    width = std::max(width, std::ceil(ImGui::CalcTextSize(text.c_str()).x) + space);
  };
  for (const ComparedNumber& number : state.comparison->numbers) {
    widen(widths.name, number_name(state, number.first()));
    widen(widths.name, shown_unit(number.first().definition(), state.settings.units));
    for (std::size_t i = 0; i < number.each.size(); ++i) {
      widen(widths.number, value_text(state, number.each[i]));
      if (std::isfinite(number.change[i])) widen(widths.number, change_text(number.change[i]));
    }
  }
  return widths;
}

void comparison_row(const ViewerState& state, const ComparedNumber& number) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const KesQuantity& q = number.first().definition();
  ImGui::TextUnformatted(number_name(state, number.first()).c_str());
  if (ImGui::IsItemHovered())
    wrapped_tooltip(std::string(state.settings.language == Language::kJapanese ? q.name_ja : q.name_en));
  ImGui::TextDisabled("%s", shown_unit(q, state.settings.units).c_str());
  for (std::size_t i = 0; i < number.each.size(); ++i) {
    ImGui::TableNextColumn();
    const FabricNumber& each = number.each[i];
    const std::string text = value_text(state, each);
    if (!each.known.has_value()) {
      ImGui::TextDisabled("%s", text.c_str());
      continue;
    }
    if (is_evidence(each.known.provenance)) {
      ImGui::TextUnformatted(text.c_str());
    } else {
      ImGui::TextColored(assumed_colour(state.settings.dark), "%s", text.c_str());
      if (ImGui::IsItemHovered()) wrapped_tooltip(each.known.provenance.source);
    }
    if (i == 0) continue;
    if (std::isfinite(number.change[i])) ImGui::TextDisabled("%s", change_text(number.change[i]).c_str());
    if (std::isfinite(number.jnd[i]) && ImGui::IsItemHovered())
      ImGui::SetTooltip("%+.1f %s", number.jnd[i], state.text(TextId::kJndUnit));
  }
}

}  // namespace

void draw_plots_panel(ViewerState& state) {
  if (lay_out(state).plots.width <= 0.0F) return;
  if (begin_panel("plots", lay_out(state).plots, true)) {
    if (state.comparison) draw_comparison(state);
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = std::max(ImGui::GetContentRegionAvail().y / 5.0F - ImGui::GetStyle().ItemSpacing.y,
                                  7.4F * ImGui::GetFontSize());
    const PlotWidget widget{width, height, state.settings.dark};
    ImGui::PushID("time");
    draw_plot(force_plot(state, false), widget);
    ImGui::PopID();
    ImGui::PushID("way");
    PlotWidget way = widget;
    way.instead = state.text(TextId::kGrabFirst);
    draw_plot(force_plot(state, true), way);
    ImGui::PopID();
    const std::size_t cloth =
        state.hands.last() < 0 ? 0 : state.hands.hand(static_cast<std::size_t>(state.hands.last())).cloth;
    if (cloth < state.laws.size()) {
      for (const PlottedLoop kind : {PlottedLoop::kBending, PlottedLoop::kShear, PlottedLoop::kTension}) {
        ImGui::PushID(static_cast<int>(kind));
        PlotWidget loop = widget;
        loop.hint = state.text(TextId::kLoopHint);
        if (draw_plot(loop_plot(state, cloth, kind), loop)) state.loops_near = !state.loops_near;
        ImGui::PopID();
      }
    }
  }
  ImGui::End();
}

void draw_comparison(ViewerState& state) {
  const FabricComparison& comparison = *state.comparison;
  ImGui::TextUnformatted(state.text(TextId::kDifferences));
  ImGui::SameLine();
  ImGui::TextDisabled("%s", state.text(TextId::kAgainstFirst));
  ImGui::SameLine();
  ImGui::TextColored(assumed_colour(state.settings.dark), "%s, %s", state.text(TextId::kAssumed),
                     state.text(TextId::kStatistic));
  const auto columns = static_cast<int>(comparison.fabrics.size()) + 1;
  const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                ImGuiTableFlags_BordersInnerV;
  const ComparisonWidths widths = comparison_widths(state);
  const float least = widths.name + widths.number * static_cast<float>(columns - 1);
  const float room = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize;
  if (!ImGui::BeginTable("differences", columns, flags, {0.0F, 14.0F * ImGui::GetFontSize()},
                         std::max(least, room)))
    return;
  ImGui::TableSetupScrollFreeze(1, 1);
  ImGui::TableSetupColumn(state.text(TextId::kQuantity), ImGuiTableColumnFlags_WidthFixed, widths.name);
  for (int i = 1; i < columns; ++i) {
    const std::string name =
        std::to_string(i) + " " + comparison.fabrics[static_cast<std::size_t>(i - 1)].name;
    ImGui::TableSetupColumn(name.c_str(), ImGuiTableColumnFlags_WidthStretch);
  }
  ImGui::TableHeadersRow();
  for (const ComparedNumber& number : comparison.numbers) comparison_row(state, number);
  ImGui::EndTable();
}

}  // namespace fuai
