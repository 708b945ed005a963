// The table.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/key_table.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace fuai {
namespace {

using enum KeyAction;

constexpr KeyRow kRows[] = {
    {kNone, 0, false, false, "", TextId::kMouseGrab},
    {kNone, 0, false, true, "Shift+", TextId::kMouseLeave},
    {kNone, 0, false, false, "", TextId::kMouseNearer},
    {kNone, 0, false, false, "", TextId::kMousePin},
    {kNone, 0, false, false, "", TextId::kMouseOrbit},
    {kNone, 0, false, false, "", TextId::kMousePan},
    {kNone, 0, false, false, "", TextId::kMouseZoom},
    {kPlay, GLFW_KEY_SPACE, false, false, "Space", TextId::kKeyPlay},
    {kStep, GLFW_KEY_RIGHT, false, false, "→", TextId::kKeyStep},
    {kStepBack, GLFW_KEY_LEFT, false, false, "←", TextId::kKeyStepBack},
    {kLongStep, GLFW_KEY_RIGHT, false, true, "Shift+→", TextId::kKeyLongStep},
    {kLongStepBack, GLFW_KEY_LEFT, false, true, "Shift+←", TextId::kKeyLongStepBack},
    {kReset, GLFW_KEY_R, false, false, "R", TextId::kKeyReset},
    {kReset, GLFW_KEY_BACKSPACE, false, false, "Backspace", TextId::kKeyReset},
    {kFaster, GLFW_KEY_EQUAL, false, false, "+", TextId::kKeyFaster},
    {kFaster, GLFW_KEY_EQUAL, false, true, "+", TextId::kKeyFaster},
    {kFaster, GLFW_KEY_SEMICOLON, false, true, "+", TextId::kKeyFaster},
    {kFaster, GLFW_KEY_KP_ADD, false, false, "+", TextId::kKeyFaster},
    {kSlower, GLFW_KEY_MINUS, false, false, "-", TextId::kKeySlower},
    {kSlower, GLFW_KEY_KP_SUBTRACT, false, false, "-", TextId::kKeySlower},
    {kReleaseAll, GLFW_KEY_ESCAPE, false, false, "Esc", TextId::kKeyReleaseAll},
    {kHeatMap, GLFW_KEY_H, false, false, "H", TextId::kKeyHeatMap},
    {kArrows, GLFW_KEY_F, false, false, "F", TextId::kKeyArrows},
    {kLines, GLFW_KEY_W, false, false, "W", TextId::kKeyLines},
    {kYarns, GLFW_KEY_Y, false, false, "Y", TextId::kKeyYarns},
    {kGround, GLFW_KEY_G, false, false, "G", TextId::kKeyGround},
    {kCompare, GLFW_KEY_C, false, false, "C", TextId::kKeyCompare},
    {kFeel1, GLFW_KEY_1, false, false, "1 … 4", TextId::kKeyFeel},
    {kFeel2, GLFW_KEY_2, false, false, "1 … 4", TextId::kKeyFeel},
    {kFeel3, GLFW_KEY_3, false, false, "1 … 4", TextId::kKeyFeel},
    {kFeel4, GLFW_KEY_4, false, false, "1 … 4", TextId::kKeyFeel},
    {kUnits, GLFW_KEY_U, false, false, "U", TextId::kKeyUnits},
    {kLanguage, GLFW_KEY_L, false, false, "L", TextId::kKeyLanguage},
    {kTheme, GLFW_KEY_T, false, false, "T", TextId::kKeyTheme},
    {kFrame, GLFW_KEY_HOME, false, false, "Home", TextId::kKeyFrame},
    {kHelp, GLFW_KEY_F1, false, false, "F1", TextId::kKeyHelp},
    {kInfo, GLFW_KEY_F2, false, false, "F2", TextId::kKeyInfo},
    {kPlots, GLFW_KEY_F3, false, false, "F3", TextId::kKeyPlots},
    {kFullScreen, GLFW_KEY_F11, false, false, "F11", TextId::kKeyFullScreen},
    {kScreenshot, GLFW_KEY_F12, false, false, "F12", TextId::kKeyScreenshot},
    {kVideo, GLFW_KEY_F10, false, false, "F10", TextId::kKeyVideo},
    {kRecord, GLFW_KEY_F9, false, false, "F9", TextId::kKeyRecord},
    {kUndo, GLFW_KEY_Z, true, false, "Ctrl+Z", TextId::kKeyUndo},
    {kRedo, GLFW_KEY_Z, true, true, "Ctrl+Shift+Z", TextId::kKeyRedo},
    {kSave, GLFW_KEY_S, true, false, "Ctrl+S", TextId::kKeySave},
    {kOpen, GLFW_KEY_O, true, false, "Ctrl+O", TextId::kKeyOpen},
    {kQuit, GLFW_KEY_Q, true, false, "Ctrl+Q", TextId::kKeyQuit},
};

}  // namespace

std::span<const KeyRow> key_table() { return kRows; }

KeyAction action_of(const KeyPress& press) {
  for (const KeyRow& row : kRows) {
    if (row.key == 0 || row.key != press.key || row.control != press.control || row.shift != press.shift)
      continue;
    const bool steps = row.action == kStep || row.action == kStepBack || row.action == kLongStep ||
                       row.action == kLongStepBack;
    return press.repeated && !steps ? kNone : row.action;
  }
  return kNone;
}

const char* key_label(KeyAction action) {
  for (const KeyRow& row : kRows)
    if (row.action == action) return row.label;
  return "";
}

}  // namespace fuai
