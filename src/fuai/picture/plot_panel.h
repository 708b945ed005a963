// One panel of a plot: its axes, the room its labels need, and its drawing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/picture/canvas.h"
#include "fuai/picture/plot.h"
#include "fuai/picture/plot_axis.h"
#include "fuai/picture/plot_curve.h"

namespace fuai {

struct PlotMargins {
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;  ///< [pt]
};

/// A plot with its axes worked out. It keeps a reference to the plot. Thread class: set-up.
class PlotPanel {
 public:
  /// @param width, height of the panel with its labels [pt]; throws Error kUsage for an impossible plot
  PlotPanel(const Plot& plot, double width, double height);

  /// Room for the labels around the frame.
  PlotMargins margins(cairo_t* cairo) const;
  /// Draws the panel with its data inside `frame`, its labels around it.
  void draw(cairo_t* cairo, const Rectangle& frame) const;

 private:
  struct Placement;  // free places for text
  PlotCurve make_curve(std::size_t index, const Rectangle& frame) const;
  void draw_bands_and_grid(cairo_t* cairo, const Rectangle& frame) const;
  void draw_lines_and_notes(cairo_t* cairo, Placement& placement) const;
  void draw_legend(cairo_t* cairo, Placement& placement) const;
  void draw_labels(cairo_t* cairo, const Rectangle& frame) const;
  std::string x_label() const {
    return plot_.x_label + (x_axis_.factor.empty() ? "" : "  " + x_axis_.factor);
  }
  std::string y_label() const {
    return plot_.y_label + (y_axis_.factor.empty() ? "" : "  " + y_axis_.factor);
  }
  double x_on(const Rectangle& frame, double x) const {
    return frame.left + frame.width() * x_axis_.place(x);
  }
  double y_on(const Rectangle& frame, double y) const {
    return frame.bottom - frame.height() * y_axis_.place(y);
  }

  const Plot& plot_;
  Axis x_axis_, y_axis_;
};

}  // namespace fuai
