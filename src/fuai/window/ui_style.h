// Fonts and colours of the window.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <string>

#include "fuai/picture/colour_map.h"

namespace fuai {

/// A colour as ImGui packs it. Thread class: any.
ImU32 to_ui_colour(const Colour& colour, double alpha = 1.0);

/// Fills the font atlas of the current ImGui context with the characters of all texts and of `more`.
/// @param size height of the letters [pixel] @param more UTF-8, e.g. names of fabrics
/// @return what is missing, a sentence; empty when nothing is. Thread class: the window's.
std::string load_fonts(float size, const std::string& more);

/// Colours, rounding and paddings. @param scale of the screen, 1 at 96 dpi. Thread class: the window's.
void apply_theme(bool dark, float scale);

/// Behind the cloth.
Colour background_colour(bool dark);
/// The floor.
Colour ground_colour(bool dark);
/// Ink of what is not measured. Thread class: any.
ImVec4 assumed_colour(bool dark);
/// A tooltip of lines that end before they are too long to be read. Thread class: the window's.
void wrapped_tooltip(const std::string& text);
/// Ink of what went wrong, and of recordings. Thread class: any.
ImVec4 alarm_colour(bool dark);

}  // namespace fuai
