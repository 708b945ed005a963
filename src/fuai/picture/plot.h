// Scientific plots as PNG or SVG, from one drawing routine.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fuai/picture/colour_map.h"

namespace fuai {

enum class SeriesStyle { kLine, kDashed, kPoints, kLineAndPoints };

/// One curve or cloud of points. NaN and infinite numbers interrupt the line.
struct Series {
  std::vector<double> x{};
  std::vector<double> y{};                 ///< as many as x
  std::string label{};                     ///< in the legend; empty: not there
  int colour = -1;                         ///< series_colour() number; -1: the series' place in the plot
  SeriesStyle style = SeriesStyle::kLine;  ///< of lines and markers
  double line_width = 1.8;                 ///< [pt]
  bool arrows = false;                     ///< arrowheads along the line, in the order of the points
};

/// A thin line across the whole plot.
struct ReferenceLine {
  double value = 0.0;
  bool vertical = false;  ///< at an x instead of at a y
  std::string label{};    ///< written along it; may be empty
  int colour = 6;         ///< series_colour() number
};

/// A tinted strip across the whole plot, e.g. a tolerance.
struct Band {
  double low = 0.0;
  double high = 0.0;
  bool vertical = false;  ///< between two x instead of two y
  std::string label{};    ///< in the legend; may be empty
  int colour = 5;         ///< series_colour() number
};

/// Text at a point of the plot.
struct Annotation {
  double x = 0.0;
  double y = 0.0;
  std::string text{};  ///< UTF-8; "\n" starts a line
};

struct Range {
  double low = 0.0;
  double high = 1.0;
};

/// Units stand in the labels, e.g. "curvature [1/cm]". All text is UTF-8.
struct Plot {
  std::string title{};
  std::string x_label{};
  std::string y_label{};
  std::vector<Series> series{};
  std::vector<ReferenceLine> reference_lines{};
  std::vector<Band> bands{};
  std::vector<Annotation> annotations{};
  std::optional<Range> x_range{};  ///< empty: whatever the data need
  std::optional<Range> y_range{};
  bool x_log = false;  ///< logarithmic; numbers <= 0 are left out, and the legend says how many
  bool y_log = false;
  bool legend = true;  ///< in the corner with the fewest data
};

/// Plots in rows and columns under one title.
struct PlotGrid {
  std::string title{};
  int columns = 1;
  std::vector<Plot> plots{};  ///< row by row
};

/// The bytes of a PNG file, width * scale by height * scale pixels. The same plot gives the same bytes on the
/// same machine. Thread class: set-up.
/// @param width, height [pt]
/// @param scale pixels per pt
/// Throws Error kUsage when a size, a range or a series is impossible, kNoDevice when built without pictures.
std::string plot_png(const PlotGrid& grid, int width, int height, double scale = 2.0);
std::string plot_png(const Plot& plot, int width, int height, double scale = 2.0);

/// The same as an SVG document. @param width, height [pt]
std::string plot_svg(const PlotGrid& grid, int width, int height);
std::string plot_svg(const Plot& plot, int width, int height);

}  // namespace fuai
