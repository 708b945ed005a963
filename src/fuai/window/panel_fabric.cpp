// The fabric panel: which fabric, its numbers with their provenance, and sliders of their factors.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fuai/fabric/weave.h"
#include "fuai/units/constants.h"
#include "fuai/window/ui_style.h"
#include "fuai/window/viewer_state.h"
#include "fuai/window/viewer_work.h"

namespace fuai {
namespace {

constexpr TextId kFactorNames[] = {TextId::kFactorWeight,      TextId::kFactorWarpBending,
                                   TextId::kFactorWeftBending, TextId::kFactorBendingFriction,
                                   TextId::kFactorShear,       TextId::kFactorShearFriction,
                                   TextId::kFactorWarpTension, TextId::kFactorWeftTension};
static_assert(std::size(kFactorNames) == kFabricFactorCount);

TextId provenance_text(ProvenanceKind kind) {
  constexpr TextId kTexts[] = {TextId::kMeasured, TextId::kComputed, TextId::kFitted, TextId::kStatistic,
                               TextId::kAssumed};
  return kTexts[static_cast<std::size_t>(kind)];
}

ImVec4 provenance_colour(ProvenanceKind kind, bool dark) {
  if (kind == ProvenanceKind::kAssumed || kind == ProvenanceKind::kStatistic) return assumed_colour(dark);
  return dark ? ImVec4(0.55F, 0.85F, 0.65F, 1.0F) : ImVec4(0.0F, 0.45F, 0.20F, 1.0F);
}

/// Whether a device feels this one; only where there is something to choose.
void felt_choice(ViewerState& state, std::size_t place) {
  if (state.built.fabrics.size() < 2 || (state.device.model.empty() && !state.rumbles)) return;
  if (ImGui::RadioButton(state.text(TextId::kFelt), state.felt == place))
    act(state, static_cast<KeyAction>(static_cast<std::size_t>(KeyAction::kFeel1) + place));
}

void number_tooltip(const ViewerState& state, const FabricNumber& number) {
  const KesQuantity& q = number.definition();
  const bool japanese = state.settings.language == Language::kJapanese;
  std::string text(japanese ? q.name_ja : q.name_en);
  text += "\n" + std::string(japanese ? q.definition_ja : q.definition) + "\n" + state.text(TextId::kSource) +
          ": " +
          (number.known.provenance.source.empty() ? state.text(TextId::kUnknown)
                                                  : number.known.provenance.source);
  if (!number.condition.empty()) text += "\n" + number.condition;
  if (!number.known.provenance.quality.empty()) text += "\n" + number.known.provenance.quality;
  wrapped_tooltip(text);
}

void number_row(const ViewerState& state, const FabricNumber& number) {
  if (!number.known.has_value()) return;
  const KesQuantity& q = number.definition();
  const bool kes = state.settings.units == UnitSystem::kKes;
  char value[48];
  std::snprintf(value, sizeof value, "%.4g", kes ? number.in_kes_units() : number.known.value);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(number_name(state, number).c_str());
  if (ImGui::IsItemHovered()) number_tooltip(state, number);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(value);
  ImGui::SameLine(0.0F, 4.0F);
  ImGui::TextDisabled("%s", shown_unit(q, state.settings.units).c_str());
  ImGui::TableNextColumn();
  const ProvenanceKind kind = number.known.provenance.kind;
  ImGui::TextColored(provenance_colour(kind, state.settings.dark), "%s", state.text(provenance_text(kind)));
  if (ImGui::IsItemHovered()) number_tooltip(state, number);
}

void number_table(ViewerState& state, std::size_t place) {
  if (ImGui::SmallButton(state.settings.units == UnitSystem::kKes ? "KES" : "SI"))
    act(state, KeyAction::kUnits);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s (U)", state.text(TextId::kKeyUnits));
  ImGui::SameLine();
  ImGui::TextUnformatted(state.text(TextId::kMeasuredValues));
  const ImGuiTableFlags flags =
      ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerV;
  const float sliders = (static_cast<float>(kFabricFactorCount) + 2.2F) * ImGui::GetFrameHeightWithSpacing();
  // No higher than its rows: the sliders follow them.
  const float rows = static_cast<float>(state.numbers[place].size()) *
                     (ImGui::GetTextLineHeight() + 2.0F * ImGui::GetStyle().CellPadding.y);
  const float height =
      std::max(std::min(ImGui::GetContentRegionAvail().y - sliders, rows), 6.0F * ImGui::GetFontSize());
  if (!ImGui::BeginTable("numbers", 3, flags, {0.0F, height})) return;
  ImGui::TableSetupColumn("symbol", ImGuiTableColumnFlags_WidthStretch, 0.30F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.44F);
  ImGui::TableSetupColumn("kind", ImGuiTableColumnFlags_WidthStretch, 0.26F);
  for (const FabricNumber& number : state.numbers[place]) number_row(state, number);
  ImGui::EndTable();
}

void sliders(ViewerState& state, std::size_t place) {
  ImGui::TextUnformatted(state.text(TextId::kFactors));
  // Anew each time: a change of the document moves it.
  const auto fabric = [&]() -> const ViewFabric& { return state.document.setup().fabrics[place]; };
  for (std::size_t i = 0; i < kFabricFactorCount; ++i) {
    ImGui::PushID(static_cast<int>(i));
    auto factor = static_cast<float>(fabric().factors[i]);
    ImGui::SetNextItemWidth(0.5F * ImGui::GetContentRegionAvail().x);
    const bool moved =
        ImGui::SliderFloat(state.text(kFactorNames[i]), &factor, static_cast<float>(kLeastFactor),
                           static_cast<float>(kMostFactor), "×%.2f", ImGuiSliderFlags_Logarithmic);
    if (moved && factor > 0.0F) {
      ViewSetup setup = state.document.setup();
      setup.fabrics[place].factors[i] = std::clamp(static_cast<double>(factor), kLeastFactor, kMostFactor);
      state.document.change(std::move(setup), 1 + place * kFabricFactorCount + i);
    }
    if (ImGui::IsItemDeactivated()) state.document.end_row();
    ImGui::PopID();
  }
  if (fabric().changed() && ImGui::Button(state.text(TextId::kAsMeasured))) {
    ViewSetup setup = state.document.setup();
    setup.fabrics[place].factors.fill(1.0);
    state.document.change(std::move(setup));
  }
}

/// "twill, 24 × 24 yarns/cm (assumed)": what the yarns are drawn from.
void weave_line(const ViewerState& state, const Fabric& fabric) {
  constexpr TextId kNames[] = {TextId::kPlainWeave, TextId::kTwill, TextId::kSatin, TextId::kKnit};
  static_assert(std::size(kNames) == kWeaveStructureCount);
  const Weave weave = weave_of(fabric);
  const std::string assumed = std::string(" (") + state.text(TextId::kAssumed) + ")";
  char threads[48];
  std::snprintf(threads, sizeof threads, ", %.3g × %.3g ", unit::kCentimetre / weave.warp_pitch,
                unit::kCentimetre / weave.weft_pitch);
  const std::string text =
      state.text(kNames[static_cast<std::size_t>(weave.structure)]) +
      (weave.structure_assumed ? assumed : "") + threads +
      state.text(weave.structure == WeaveStructure::kKnit ? TextId::kLoopsPerCm : TextId::kYarnsPerCm) +
      (weave.threads_assumed ? assumed : "");
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextDisabled("%s", text.c_str());
  ImGui::PopTextWrapPos();
}

void fabric_page(ViewerState& state, std::size_t place) {
  draw_fabric_choice(state, place);
  felt_choice(state, place);
  const Fabric& measured = state.document.setup().fabrics[place].measured;
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextDisabled("%s", measured.composition.c_str());
  ImGui::PopTextWrapPos();
  if (!measured.note.empty() && ImGui::IsItemHovered()) wrapped_tooltip(measured.note);
  weave_line(state, measured);
  number_table(state, place);
  sliders(state, place);
}

}  // namespace

std::string number_name(const ViewerState& state, const FabricNumber& number) {
  std::string name(number.definition().symbol);
  const auto ends = [&](const char* text) { return number.section.ends_with(text); };
  if (ends(".warp")) name += std::string(" ") + state.text(TextId::kWarp);
  if (ends(".weft")) name += std::string(" ") + state.text(TextId::kWeft);
  if (ends(".bias")) name += std::string(" ") + state.text(TextId::kBias);
  return name;
}

void draw_fabric_panel(ViewerState& state) {
  if (lay_out(state).fabric.width <= 0.0F) return;
  if (begin_panel("fabric", lay_out(state).fabric, true)) {
    const std::size_t count = state.document.setup().fabrics.size();
    if (ImGui::BeginTabBar("fabrics")) {
      for (std::size_t i = 0; i < state.numbers.size(); ++i) {
        const std::string label = std::string(state.text(TextId::kFabric)) + " " + std::to_string(i + 1) +
                                  "###fabric" + std::to_string(i);
        bool open = true;
        const bool turn = state.turn_to == i;
        if (ImGui::BeginTabItem(label.c_str(), count > 1 ? &open : nullptr,
                                turn ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None)) {
          state.page = i;
          if (turn) state.turn_to.reset();
          if (i < state.document.setup().fabrics.size()) fabric_page(state, i);
          ImGui::EndTabItem();
        }
        if (!open) {
          remove_view_fabric(state, i);
          break;
        }
      }
      if (count < kMostViewFabrics && ImGui::TabItemButton("+")) act(state, KeyAction::kCompare);
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s (C)", state.text(TextId::kKeyCompare));
      ImGui::EndTabBar();
    }
  }
  ImGui::End();
}

}  // namespace fuai
