// A recording that is done again in the window.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "Recordings".
#pragma once

#include <string>

#include "fuai/window/viewer_state.h"

namespace fuai {

/// Reads a recording and begins it with the next picture. @throws Error as read_view_log(); nothing changes
/// then. Thread class: the window's.
void open_replay(ViewerState& state, const std::string& path);
/// From the beginning again. Thread class: the window's.
void restart_replay(ViewerState& state);
/// Once a picture, before follow_document(): begins parts when their time has come, and tells the end.
/// @return whether the cloths are new. Thread class: the window's.
bool follow_replay(ViewerState& state);

/// What the bar below says about it; empty: there is none. Thread class: the window's.
std::string replay_text(const ViewerState& state);

}  // namespace fuai
