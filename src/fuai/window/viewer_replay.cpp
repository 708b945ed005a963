// Begins the parts of a recording and follows them.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/viewer_replay.h"

#include <cstdio>
#include <filesystem>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/window/viewer_work.h"

namespace fuai {
namespace {

/// Mark of the document's changes: undo takes all parts of a recording back at once. Sliders count from 1.
constexpr std::uint64_t kReplayMark = std::uint64_t{1} << 32;

std::string seconds_text(std::int64_t ticks) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", static_cast<double>(ticks) * kViewStep);
  return text;
}

bool begin_part(ViewerState& state, std::size_t number) {
  ShownReplay& replay = *state.replay;
  const ViewLogPart& part = replay.parts[number];
  try {
    auto cloths = std::make_shared<ViewCloths>(part.setup);
    state.document.change(part.setup, kReplayMark);
    const bool keep = number > 0 && part.keep_shape;
    replay.build = take_cloths(state, std::move(cloths), keep,
                               std::make_shared<const ViewScript>(view_script(replay.parts, number)));
    replay.part = number;
    replay.last_tick = view_script(replay.parts, number).last_tick;
    replay.begun = true;
    if (number > 0) return true;
    state.hands.forget();
    state.drag = {};
    state.forces.clear();
    state.playing = true;
    state.session->play(true);
    return true;
  } catch (const Error& e) {
    state.say(replay.name + ": " + state.text(e), true);
    state.replay.reset();
    return false;
  }
}

/// It is over: one line says whether it came out as it was recorded.
void end_replay(ViewerState& state) {
  ShownReplay& replay = *state.replay;
  replay.over = true;
  state.playing = false;
  state.say(replay_text(state) + "; " + state.text(TextId::kReplayOver), replay.first_difference >= 0);
}

}  // namespace

void open_replay(ViewerState& state, const std::string& path) {
  ShownReplay replay;
  replay.parts = read_view_log(path);
  replay.end = view_script(replay.parts, replay.parts.size() - 1).last_tick;
  replay.name = std::filesystem::path(path).filename().string();
  state.replay = std::move(replay);
}

void restart_replay(ViewerState& state) {
  ShownReplay again;
  again.end = state.replay->end;
  again.name = std::move(state.replay->name);
  again.parts = std::move(state.replay->parts);
  state.replay = std::move(again);
}

bool follow_replay(ViewerState& state) {
  if (!state.replay) return false;
  ShownReplay& replay = *state.replay;
  if (!replay.begun) return begin_part(state, 0);
  const ViewSnapshot& snapshot = state.snapshot();
  if (snapshot.build != replay.build) return false;  // it is on its way
  const ScriptView& script = snapshot.script;
  const std::int64_t last = replay.last_tick;
  replay.tick = script.tick;
  replay.hashes = replay.hashes_before + script.hashes;
  if (replay.first_difference < 0) replay.first_difference = script.first_difference;
  if (script.follows) {
    if (script.tick < last || replay.part + 1 == replay.parts.size()) return false;
    replay.hashes_before = replay.hashes;
    return begin_part(state, replay.part + 1);
  }
  if (!replay.over && script.tick >= last) {
    end_replay(state);
    replay.end_tick = snapshot.tick;
  } else if (!replay.over || snapshot.tick > replay.end_tick) {
    if (!replay.over) state.say(state.text(TextId::kReplayLeft));
    state.replay.reset();
  }
  return false;
}

std::string replay_text(const ViewerState& state) {
  if (!state.replay) return {};
  const ShownReplay& replay = *state.replay;
  const std::int64_t first = replay.parts.front().tick;
  std::string text = std::string(state.text(TextId::kReplay)) + " " + replay.name + "  " +
                     seconds_text(replay.tick - first) + " / " + seconds_text(replay.end - first) + " s";
  if (replay.first_difference >= 0) {
    text +=
        ", " + seconds_text(replay.first_difference - first) + " s: " + state.text(TextId::kReplayDiffers);
  } else if (replay.hashes > 0) {
    text += ", " + std::to_string(replay.hashes) + " " + state.text(TextId::kReplayAlike);
  }
  return text;
}

}  // namespace fuai
