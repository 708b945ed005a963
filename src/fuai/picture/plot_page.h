// The page of plots on a Cairo surface.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/picture/canvas.h"
#include "fuai/picture/plot.h"

namespace fuai {

/// Draws plots from (0, 0) on, title first. The ground is the caller's. @param width, height [pt]
/// Throws Error kUsage when the place is too small for its plots. Thread class: set-up.
void draw_plots(cairo_t* cairo, const PlotGrid& grid, double width, double height);

}  // namespace fuai
