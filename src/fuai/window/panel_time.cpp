// The bar below: time, the past, and how the machine keeps up.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "fuai/window/ui_style.h"
#include "fuai/window/viewer_replay.h"
#include "fuai/window/viewer_state.h"

namespace fuai {
namespace {

/// Below this part of the speed that is asked for the machine counts as too slow.
constexpr double kTooSlow = 0.9;

void button(ViewerState& state, KeyAction action, TextId text) {
  if (ImGui::Button(state.text(text))) act(state, action);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", key_label(action));
  ImGui::SameLine();
}

void controls(ViewerState& state) {
  button(state, KeyAction::kPlay, state.playing ? TextId::kPause : TextId::kPlay);
  button(state, KeyAction::kStepBack, TextId::kKeyStepBack);
  button(state, KeyAction::kStep, TextId::kStep);
  button(state, KeyAction::kReset, TextId::kReset);
  ImGui::SetNextItemWidth(7.0F * ImGui::GetFontSize());
  auto speed = static_cast<float>(state.settings.speed);
  if (ImGui::SliderFloat(state.text(TextId::kSpeed), &speed, 0.1F, 2.0F, "×%.2f",
                         ImGuiSliderFlags_Logarithmic))
    state.settings.speed = std::clamp(static_cast<double>(speed), 0.1, 2.0);
  ImGui::SameLine();
  bool moves = state.document.setup().scene_moves;
  if (ImGui::Checkbox(state.text(TextId::kSceneMoves), &moves)) {
    ViewSetup setup = state.document.setup();
    setup.scene_moves = moves;
    state.document.change(std::move(setup));
  }
  ImGui::SameLine();
}

void past(ViewerState& state) {
  const ViewSnapshot& s = state.snapshot();
  auto tick = static_cast<float>(static_cast<double>(s.tick) * kViewStep);
  const auto first = static_cast<float>(static_cast<double>(s.first_tick) * kViewStep);
  const auto now = static_cast<float>(static_cast<double>(std::max(s.newest_tick, s.tick)) * kViewStep);
  ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - 5.0F * ImGui::GetFontSize(), 60.0F));
  if (ImGui::SliderFloat(state.text(TextId::kPast), &tick, first, now, "%.3f s")) {
    state.playing = false;
    state.session->play(false);
    state.session->seek(std::llround(static_cast<double>(tick) / kViewStep));
  }
}

/// Of the cloth whose page is shown, each with its name.
void energies(const ViewerState& state) {
  const std::vector<ClothView>& cloths = state.snapshot().cloths;
  if (cloths.empty()) return;
  const std::size_t shown = std::min(state.page, cloths.size() - 1);
  const ClothView& cloth = cloths[shown];
  const std::string which = cloths.size() > 1 ? " " + std::to_string(shown + 1) : "";
  ImGui::Text(" %s%s: %s %.3f mJ, %s %.3f mJ, %s %.3f mJ", state.text(TextId::kStatusEnergy), which.c_str(),
              state.text(TextId::kEnergyDeformation), 1e3 * cloth.energy.internal(),
              state.text(TextId::kEnergyWeight), 1e3 * cloth.energy.weight, state.text(TextId::kEnergyMotion),
              1e3 * cloth.kinetic_energy);
}

void status(ViewerState& state) {
  const ViewSnapshot& s = state.snapshot();
  ImGui::Text("%.3f s", s.time);
  ImGui::SameLine();
  energies(state);
  if (state.real_time_factor) {  // else nothing is paced, and times would say nothing
    ImGui::SameLine();
    ImGui::Text("  %s %.0f µs   %s ×%.2f   %s %.0f ms", state.text(TextId::kStatusStep), s.step_us,
                state.text(TextId::kStatusRealTime), state.playing ? *state.real_time_factor : 0.0,
                state.text(TextId::kStatusFrames), state.picture_ms);
  }
  if (state.device.asked.empty()) {
    ImGui::SameLine();
    ImGui::Text("  %s", state.text(TextId::kStatusDevice));
  }
  if (state.recording || state.filming || state.logging) {
    ImGui::SameLine();
    ImGui::TextColored({0.95F, 0.3F, 0.25F, 1.0F}, "● %s", state.text(TextId::kRecording));
  }
  if (state.playing && state.clock > 2.0 && state.real_time_factor &&
      *state.real_time_factor < kTooSlow * state.settings.speed) {
    ImGui::SameLine();
    ImGui::TextColored(assumed_colour(state.settings.dark), "%s", state.text(TextId::kTooSlow));
  }
}

/// A line about the device: how fast its force loop is, what it is given, and what the cloth gives.
void device_status(const ViewerState& state) {
  const ShownDevice& device = state.device;
  if (device.asked.empty()) return;
  if (device.model.empty()) {
    ImGui::TextDisabled("%s: %s; %s", device.asked.c_str(), state.text(TextId::kDeviceMissing),
                        state.text(TextId::kDeviceMouseGoesOn));
    return;
  }
  ImGui::Text("%s   %.0f Hz   %s %llu", device.model.c_str(), device.view.rate,
              state.text(TextId::kDeviceOverruns), static_cast<unsigned long long>(device.view.overruns));
  ImGui::SameLine();
  if (device.view.away || device.view.faulted) {
    ImGui::TextColored({0.95F, 0.3F, 0.25F, 1.0F}, "  %s",
                       state.text(device.view.away ? TextId::kDeviceAway : TextId::kDeviceFault));
    return;
  }
  const std::vector<ClothView>& cloths = state.snapshot().cloths;
  const std::size_t felt = std::min(state.felt, cloths.size() - 1);
  const double cloth = cloths.empty() ? 0.0 : cloths[felt].hands[kDeviceHand].force.norm();
  const std::string which = cloths.size() > 1 ? " " + std::to_string(felt + 1) + ":" : "";
  const std::string sent =
      device.gives_force ? force_text(device.view.force) : state.text(TextId::kDeviceNoForce);
  ImGui::Text("  %s%s %s   %s %s", state.text(TextId::kDeviceCloth), which.c_str(), force_text(cloth).c_str(),
              state.text(TextId::kDeviceSent), sent.c_str());
}

void replay_status(const ViewerState& state) {
  if (!state.replay) return;
  const bool differs = state.replay->first_difference >= 0;
  ImGui::PushStyleColor(ImGuiCol_Text,
                        differs ? ImVec4{0.95F, 0.3F, 0.25F, 1.0F} : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  ImGui::TextUnformatted(replay_text(state).c_str());
  ImGui::PopStyleColor();
}

}  // namespace

void draw_time_panel(ViewerState& state) {
  if (begin_panel("time", lay_out(state).time, false)) {
    controls(state);
    past(state);
    status(state);
    device_status(state);
    replay_status(state);
  }
  ImGui::End();
}

}  // namespace fuai
