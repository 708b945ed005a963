// Every key and button of the window: one table, for the window itself, its help and the manual.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "fuai/window/ui_text.h"

namespace fuai {

/// What a key does.
enum class KeyAction : std::uint8_t {
  kNone,  ///< a row of the table about the mouse
  kPlay,
  kStep,
  kStepBack,
  kLongStep,
  kLongStepBack,
  kReset,
  kFaster,
  kSlower,
  kReleaseAll,
  kHeatMap,
  kArrows,
  kLines,
  kYarns,
  kGround,
  kCompare,
  kFeel1,
  kFeel2,
  kFeel3,
  kFeel4,
  kUnits,
  kLanguage,
  kTheme,
  kFrame,
  kHelp,
  kInfo,
  kPlots,
  kFullScreen,
  kScreenshot,
  kVideo,
  kRecord,
  kUndo,
  kRedo,
  kSave,
  kOpen,
  kQuit,
};

/// A row.
struct KeyRow {
  KeyAction action;
  int key;  ///< as GLFW numbers them; 0: no key
  bool control, shift;
  const char* label;  ///< as the help writes it: "Ctrl+Z"
  TextId what;
};

/// A key that went down, or repeats.
struct KeyPress {
  int key = 0;  ///< as GLFW numbers them
  bool control = false, shift = false, repeated = false;
};

/// What a key does, kNone for most; of repeated ones only those that step. Thread class: any.
KeyAction action_of(const KeyPress& press);

/// All rows in the order of the help; the mouse first. Thread class: any.
std::span<const KeyRow> key_table();

/// "Ctrl+Z", or "" for an action without a key. Thread class: any.
const char* key_label(KeyAction action);

}  // namespace fuai
