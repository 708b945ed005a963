// The bar below: time, the past, and how the machine keeps up.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fuai/picture/plot_axis.h"
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
  button(state, KeyAction::kStepBack, TextId::kStepBack);
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
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", state.text(TextId::kSceneMovesHint));
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
  if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
    ImGui::SetTooltip("%s", state.text(TextId::kPastHint));
}

const ImVec4& usual_ink() { return ImGui::GetStyle().Colors[ImGuiCol_Text]; }

/// Texts behind each other, the most important first. One that does not fit is left out: half a number would
/// be another number.
class StatusLine {
 public:
  void put(const std::string& text, const ImVec4& colour) {
    const float gap = 1.2F * ImGui::GetFontSize();
    if (begun_) {
      const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
      if (ImGui::GetItemRectMax().x + gap + ImGui::CalcTextSize(text.c_str()).x > end) return;
      ImGui::SameLine(0.0F, gap);
    }
    begun_ = true;
    ImGui::TextColored(colour, "%s", text.c_str());
  }
  void put(const std::string& text) { put(text, usual_ink()); }

 private:
  bool begun_ = false;
};

/// Of the cloth whose page is shown, each with its name.
std::string energies(const ViewerState& state) {
  const std::vector<ClothView>& cloths = state.snapshot().cloths;
  if (cloths.empty()) return {};
  const std::size_t shown = std::min(state.page, cloths.size() - 1);
  const ClothView& cloth = cloths[shown];
  const std::string which = cloths.size() > 1 ? " " + std::to_string(shown + 1) : "";
  const auto part = [&](TextId name, double joules) {
    return std::string(state.text(name)) + " " + format_number(1e3 * joules, 3) + " mJ";
  };
  return state.text(TextId::kStatusEnergy) + which + ": " +
         part(TextId::kEnergyDeformation, cloth.energy.internal()) + ", " +
         part(TextId::kEnergyWeight, cloth.energy.weight) + ", " +
         part(TextId::kEnergyMotion, cloth.kinetic_energy);
}

void status(ViewerState& state) {
  const ViewSnapshot& s = state.snapshot();
  StatusLine line;
  line.put(format_number(s.time, 3) + " s");
  if (state.recording || state.filming || state.logging)
    line.put(std::string("● ") + state.text(TextId::kRecording), alarm_colour(state.settings.dark));
  if (state.playing && state.clock > 2.0 && state.real_time_factor &&
      *state.real_time_factor < kTooSlow * state.settings.speed)
    line.put(state.text(TextId::kTooSlow), assumed_colour(state.settings.dark));
  line.put(energies(state));
  if (state.real_time_factor) {  // else nothing is paced, and times would say nothing
    const auto number = [&](TextId name, const char* before, double value, int decimals, const char* unit) {
      line.put(std::string(state.text(name)) + before + format_number(value, decimals) + unit);
    };
    if (state.playing) number(TextId::kStatusRealTime, " ×", *state.real_time_factor, 2, "");
    number(TextId::kStatusStep, " ", s.step_us, 0, " µs");
    number(TextId::kStatusFrames, " ", state.picture_ms, 0, " ms");
  }
  if (state.device.asked.empty()) line.put(state.text(TextId::kStatusDevice));
}

/// A line about the device: what the cloth gives, what it is given, and how fast its force loop is.
void device_status(const ViewerState& state) {
  const ShownDevice& device = state.device;
  if (device.asked.empty()) return;
  if (device.model.empty()) {
    ImGui::TextDisabled("%s: %s; %s", device.asked.c_str(), state.text(TextId::kDeviceMissing),
                        state.text(TextId::kDeviceMouseGoesOn));
    return;
  }
  StatusLine line;
  line.put(device.model);
  if (device.view.away || device.view.faulted) {
    line.put(state.text(device.view.away ? TextId::kDeviceAway : TextId::kDeviceFault),
             alarm_colour(state.settings.dark));
  } else {
    const std::vector<ClothView>& cloths = state.snapshot().cloths;
    const std::size_t felt = std::min(state.felt, cloths.size() - 1);
    const double cloth = cloths.empty() ? 0.0 : cloths[felt].hands[kDeviceHand].force.norm();
    const std::string which = cloths.size() > 1 ? " " + std::to_string(felt + 1) + ":" : "";
    line.put(state.text(TextId::kDeviceCloth) + which + " " + force_text(cloth));
    if (device.gives_force)
      line.put(std::string(state.text(TextId::kDeviceSent)) + " " + force_text(device.view.force));
    else
      line.put(state.text(TextId::kDeviceNoForce));
  }
  line.put(format_number(device.view.rate, 0) + " Hz");
  line.put(std::string(state.text(TextId::kDeviceOverruns)) + " " + std::to_string(device.view.overruns));
}

void replay_status(const ViewerState& state) {
  if (!state.replay) return;
  const bool differs = state.replay->first_difference >= 0;
  ImGui::PushStyleColor(ImGuiCol_Text, differs ? alarm_colour(state.settings.dark) : usual_ink());
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
