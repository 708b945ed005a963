// Draws a Plot (picture/plot.h) in a panel, with the axes, ticks and colours that its pictures have.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/picture/plot.h"

namespace fuai {

/// How large, and on what.
struct PlotWidget {
  float width = 300.0F, height = 180.0F;  ///< [pixel]
  bool dark = true;
  const char* hint = nullptr;     ///< a line below the values under the mouse
  const char* instead = nullptr;  ///< stands where there is no curve
};

/// At the cursor of the current ImGui window. Lines, dashes, points and the legend; log axes,
/// bands and annotations are left to files. Shows the values under the mouse. @return whether it
/// was clicked. Thread class: the window's.
bool draw_plot(const Plot& plot, const PlotWidget& widget);

}  // namespace fuai
