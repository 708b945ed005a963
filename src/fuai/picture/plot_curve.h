// One series of a plot on the paper: its line, arrowheads and markers, and the room it leaves free.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo/cairo.h>

#include <string>
#include <vector>

#include "fuai/core/types.h"
#include "fuai/picture/plot.h"

namespace fuai {

/// A rectangle on the paper, y downward [pt].
struct Rectangle {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  double width() const { return right - left; }
  double height() const { return bottom - top; }
  bool contains(const Vec2& p) const {
    return p.x() > left && p.x() < right && p.y() > top && p.y() < bottom;
  }
};

/// A series on the paper: where its points lie, and what the legend says of it. Thread class: set-up.
struct PlotCurve {
  const Series* series = nullptr;
  Colour colour;
  std::vector<Vec2> points;  ///< [pt]; NaN where the line is interrupted
  std::string label;
  int marker_stride = 1;  ///< one marker every so many points

  bool has_line() const { return series->style != SeriesStyle::kPoints; }
  bool has_markers() const {
    return series->style == SeriesStyle::kPoints || series->style == SeriesStyle::kLineAndPoints;
  }
  /// Markers on a line that would hide one another are thinned out; the label then says so.
  void thin_markers();
  void draw(cairo_t* cairo) const;
  /// A piece of it for the legend, from x0 to x1 at height y [pt].
  void draw_sample(cairo_t* cairo, double x0, double x1, double y) const;
  /// How much of the curve lies in a box: length of line plus width of markers [pt].
  double crowd(const Rectangle& box) const;
};

}  // namespace fuai
