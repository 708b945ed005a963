// What each key and menu entry does.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "fuai/window/viewer_replay.h"
#include "fuai/window/viewer_state.h"
#include "fuai/window/viewer_work.h"

namespace fuai {
namespace {

constexpr int kLongStep = 100;  // a tenth of a second [ticks]
constexpr double kSpeeds[] = {0.1, 0.25, 0.5, 1.0, 2.0};

void change_speed(ViewerState& state, int by) {
  const auto* at = std::find_if(std::begin(kSpeeds), std::end(kSpeeds) - 1,
                                [&](double s) { return s >= state.settings.speed; });
  const auto place = std::clamp<std::ptrdiff_t>((at - kSpeeds) + by, 0, std::ssize(kSpeeds) - 1);
  state.settings.speed = kSpeeds[place];
}

void reset(ViewerState& state) {
  if (state.replay) return restart_replay(state);
  ViewCommand command;
  command.kind = ViewCommand::Kind::kReset;
  state.session->send(command);
  state.hands.release_all(*state.session);
  state.forces.clear();
}

void set_playing(ViewerState& state, bool plays) {
  state.playing = plays;
  state.session->play(plays);
}

void step(ViewerState& state, int ticks) {
  if (state.playing) set_playing(state, false);  // which forgets steps that are still to be done
  state.session->single_steps(ticks);
}

void step_back(ViewerState& state, int ticks) {
  if (state.playing) set_playing(state, false);
  state.session->step_back(ticks);
}

/// The bundled fabric after the last one that is shown.
void add_fabric(ViewerState& state) {
  ViewSetup setup = state.document.setup();
  if (setup.fabrics.size() >= kMostViewFabrics || state.fabric_names.empty()) return;
  const auto& names = state.fabric_names;
  auto at = std::find(names.begin(), names.end(), setup.fabrics.back().source);
  const auto shown = [&](const std::string& name) {
    return std::any_of(setup.fabrics.begin(), setup.fabrics.end(),
                       [&](const ViewFabric& f) { return f.source == name; });
  };
  std::size_t next = at == names.end() ? 0 : static_cast<std::size_t>(at - names.begin()) + 1;
  for (std::size_t i = 0; i < names.size() && shown(names[next % names.size()]); ++i) ++next;
  add_view_fabric(state, names[next % names.size()]);
}

/// A device feels another cloth, if it is there.
void feel(ViewerState& state, std::size_t cloth) {
  if (cloth >= state.built.fabrics.size()) return;
  state.felt = cloth;
  state.say(state.built.fabrics[cloth].measured.name + ": " + state.text(TextId::kFelt));
}

}  // namespace

void ViewWishes::one_done() noexcept {
  ViewWishes left;
  left.quit = quit;
  left.full_screen = std::max(full_screen - 1, 0);
  left.screenshot = std::max(screenshot - 1, 0);
  left.video = std::max(video - 1, 0);
  left.record = std::max(record - 1, 0);
  left.save = std::max(save - 1, 0);
  *this = std::move(left);
}

void act(ViewerState& state, KeyAction action) {
  ViewSettings& s = state.settings;
  ViewWishes& w = state.wishes;
  switch (action) {
    case KeyAction::kNone:
      break;
    case KeyAction::kPlay:
      set_playing(state, !state.playing);
      break;
    case KeyAction::kStep:
      step(state, 1);
      break;
    case KeyAction::kLongStep:
      step(state, kLongStep);
      break;
    case KeyAction::kStepBack:
      step_back(state, 1);
      break;
    case KeyAction::kLongStepBack:
      step_back(state, kLongStep);
      break;
    case KeyAction::kReset:
      reset(state);
      break;
    case KeyAction::kFaster:
      change_speed(state, 1);
      break;
    case KeyAction::kSlower:
      change_speed(state, -1);
      break;
    case KeyAction::kReleaseAll:
      state.hands.release_all(*state.session);
      break;
    case KeyAction::kHeatMap:
      s.heat_map = s.heat_map + 1 < kClothFieldCount ? s.heat_map + 1 : -1;
      break;
    case KeyAction::kArrows:
      s.arrows = !s.arrows;
      break;
    case KeyAction::kLines:
      s.lines = !s.lines;
      break;
    case KeyAction::kYarns:
      s.yarns = !s.yarns;
      break;
    case KeyAction::kGround:
      s.ground = !s.ground;
      break;
    case KeyAction::kCompare:
      add_fabric(state);
      break;
    case KeyAction::kFeel1:
    case KeyAction::kFeel2:
    case KeyAction::kFeel3:
    case KeyAction::kFeel4:
      feel(state, static_cast<std::size_t>(action) - static_cast<std::size_t>(KeyAction::kFeel1));
      break;
    case KeyAction::kUnits:
      s.units = s.units == UnitSystem::kKes ? UnitSystem::kSi : UnitSystem::kKes;
      break;
    case KeyAction::kLanguage:
      s.language = s.language == Language::kEnglish ? Language::kJapanese : Language::kEnglish;
      break;
    case KeyAction::kTheme:
      s.dark = !s.dark;
      w.new_theme = true;
      break;
    case KeyAction::kFrame:
      frame_view(state);
      break;
    case KeyAction::kHelp:
      s.help = !s.help;
      break;
    case KeyAction::kInfo:
      s.fabric_panel = !s.fabric_panel;
      break;
    case KeyAction::kPlots:
      s.plots = !s.plots;
      break;
    case KeyAction::kFullScreen:
      ++w.full_screen;
      break;
    case KeyAction::kScreenshot:
      ++w.screenshot;
      break;
    case KeyAction::kVideo:
      ++w.video;
      break;
    case KeyAction::kRecord:
      ++w.record;
      break;
    case KeyAction::kUndo:
      state.document.undo();
      break;
    case KeyAction::kRedo:
      state.document.redo();
      break;
    case KeyAction::kSave:
      ++w.save;
      break;
    case KeyAction::kOpen:
      state.browsing = !state.browsing;
      break;
    case KeyAction::kQuit:
      w.quit = true;
      break;
  }
}

}  // namespace fuai
