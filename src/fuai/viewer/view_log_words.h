// The words of a recording, for its writer and its reader.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "Recordings".
#pragma once

#include <array>
#include <string_view>

#include "fuai/viewer/view_session.h"

namespace fuai::view_log {

inline constexpr std::string_view kFormat = "fuai-view/1";
inline constexpr std::string_view kPart = "part", kScene = "scene", kSize = "size", kMoves = "scene_moves",
                                  kFelt = "felt", kFabric = "fabric", kBegin = "begin", kRewind = "rewind",
                                  kHash = "hash";

struct CommandWord {
  ViewCommand::Kind kind;
  std::string_view word;
};
inline constexpr std::array kCommandWords{
    CommandWord{ViewCommand::Kind::kGrab, "grab"}, CommandWord{ViewCommand::Kind::kMove, "move"},
    CommandWord{ViewCommand::Kind::kRelease, "release"}, CommandWord{ViewCommand::Kind::kReset, "reset"},
    CommandWord{ViewCommand::Kind::kMotion, "motion"}};

constexpr std::string_view word_of(ViewCommand::Kind kind) {
  for (const CommandWord& entry : kCommandWords)
    if (entry.kind == kind) return entry.word;
  return {};
}

}  // namespace fuai::view_log
