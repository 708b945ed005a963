// The list of fabrics: found by words, sorted by name or by a number that tells them apart.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include <cmath>
#include <cstdio>

#include "fuai/core/error.h"
#include "fuai/window/ui_style.h"
#include "fuai/window/viewer_state.h"
#include "fuai/window/viewer_work.h"

namespace fuai {
namespace {

/// Reads them when they are wanted first: a window that opens has no time for it.
void read_fabrics(ViewerState& state) {
  if (!state.choice.fabrics.empty()) return;
  for (const std::string& id : state.fabric_names) {
    try {
      state.choice.fabrics.push_back(make_fabric_choice(id));
    } catch (const Error& e) {
      state.say(state.text(e), true);
    }
  }
}

/// Headings that sort when they are clicked.
void headings(ViewerState& state) {
  ImGui::TableSetupColumn(state.text(TextId::kFabric), ImGuiTableColumnFlags_WidthStretch, 0.40F);
  for (std::size_t i = 0; i < kChoiceNumbers; ++i) {
    const KesQuantity& q = choice_quantity(i);
    const std::string name =
        std::string(q.symbol) + " [" + shown_unit(q, state.settings.units) + "]###number" + std::to_string(i);
    ImGui::TableSetupColumn(name.c_str(), ImGuiTableColumnFlags_WidthStretch, 0.20F);
  }
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableHeadersRow();
  const ImGuiTableSortSpecs* sorting = ImGui::TableGetSortSpecs();
  if (sorting == nullptr || sorting->SpecsCount == 0) return;
  state.choice.by = static_cast<ChoiceColumn>(sorting->Specs->ColumnIndex);
  state.choice.descending = sorting->Specs->SortDirection == ImGuiSortDirection_Descending;
}

void number(const ViewerState& state, const FabricChoice& fabric, std::size_t i) {
  ImGui::TableNextColumn();
  if (!std::isfinite(fabric.numbers[i])) return ImGui::TextDisabled("-");
  const bool kes = state.settings.units == UnitSystem::kKes;
  const double value = kes ? fabric.numbers[i] / choice_quantity(i).to_si : fabric.numbers[i];
  if (fabric.assumed[i])
    ImGui::TextColored(assumed_colour(state.settings.dark), "%.3g *", value);
  else
    ImGui::Text("%.3g", value);
}

/// @return the id that was chosen; empty: none
std::string rows(ViewerState& state, const std::string& now) {
  std::string chosen;
  const ShownChoice& choice = state.choice;
  const std::vector<std::size_t> order =
      choose_fabrics(choice.fabrics, choice.text, choice.by, choice.descending);
  for (const std::size_t i : order) {
    const FabricChoice& fabric = choice.fabrics[i];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable((fabric.name + "##" + fabric.id).c_str(), fabric.id == now,
                          ImGuiSelectableFlags_SpanAllColumns))
      chosen = fabric.id;
    if (ImGui::IsItemHovered() && !fabric.composition.empty())
      wrapped_tooltip(fabric.id + ": " + fabric.composition);
    for (std::size_t n = 0; n < kChoiceNumbers; ++n) number(state, fabric, n);
  }
  return chosen;
}

}  // namespace

void draw_fabric_choice(ViewerState& state, std::size_t place) {
  const ViewFabric& fabric = state.document.setup().fabrics[place];
  const float em = ImGui::GetFontSize();
  ImGui::SetNextItemWidth(-1.0F);
  const ImVec2 size{38.0F * em, 26.0F * em};
  ImGui::SetNextWindowSizeConstraints(size, size);
  if (!ImGui::BeginCombo("##fabric", fabric.measured.name.c_str(), ImGuiComboFlags_HeightLargest)) return;
  read_fabrics(state);
  if (ImGui::IsWindowAppearing()) {
    state.choice.text[0] = '\0';
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::SetNextItemWidth(-1.0F);
  ImGui::InputTextWithHint("##search", state.text(TextId::kSearch), state.choice.text,
                           sizeof state.choice.text);
  std::string chosen;
  const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_Sortable;
  const ImVec2 table{0.0F, ImGui::GetContentRegionAvail().y - 1.5F * em};
  if (ImGui::BeginTable("choice", 1 + static_cast<int>(kChoiceNumbers), flags, table)) {
    headings(state);
    chosen = rows(state, fabric.source);
    if (ImGui::TableGetRowIndex() < 1) {  // the headings alone
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", state.text(TextId::kNothingFound));
    }
    ImGui::EndTable();
  }
  ImGui::TextColored(assumed_colour(state.settings.dark), "* %s, %s", state.text(TextId::kAssumed),
                     state.text(TextId::kStatistic));
  if (!chosen.empty()) ImGui::CloseCurrentPopup();
  ImGui::EndCombo();
  if (!chosen.empty() && chosen != fabric.source) set_view_fabric(state, place, chosen);
}

}  // namespace fuai
