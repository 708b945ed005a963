// A page of texts, tables, images and plots at given places, as PNG or SVG from one drawing routine.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/picture/colour_map.h"
#include "fuai/picture/image.h"
#include "fuai/picture/plot.h"

namespace fuai {

/// A place on the page, y downward [pt].
struct SheetBox {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
};

/// Text from the upper left corner of its box, wrapped to its width; lines that do not fit are left out, and
/// dots say so.
struct SheetText {
  SheetBox box{};
  std::string text{};  ///< UTF-8; "\n" starts a line
  double size = 9.0;   ///< of the letters [pt]
  bool bold = false;
  Colour colour{0.13, 0.13, 0.13, 1.0};
  bool centred = false;  ///< each line in the middle of the box
};

/// An image as large as its box allows, in the middle of it.
struct SheetImage {
  SheetBox box{};
  Image image{};
};

/// A row of a table.
struct SheetRow {
  std::vector<std::string> cells{};
  Colour colour{0.13, 0.13, 0.13, 1.0};
};

/// A table in lines of equal height; text that is too wide for its column ends in dots.
struct SheetTable {
  SheetBox box{};
  std::vector<double> columns{};  ///< widths as parts of their sum
  std::vector<bool> right{};      ///< aligned to the right, by column
  std::vector<std::string> head{};
  std::vector<SheetRow> rows{};
  double size = 8.0;         ///< of the letters [pt]
  double row_height = 13.0;  ///< [pt]
};

/// Plots in their box, as plot_png() draws them on a page.
struct SheetPlots {
  SheetBox box{};
  PlotGrid grid{};
};

/// The page. Things are drawn in this order.
struct Sheet {
  int width = 0, height = 0;  ///< [pt]
  std::vector<SheetPlots> plots{};
  std::vector<SheetImage> images{};
  std::vector<SheetTable> tables{};
  std::vector<SheetText> texts{};
};

/// The bytes of a PNG file of width * scale by height * scale pixels.
/// Throws Error kUsage for an impossible size, table or plot, kNoDevice when built without pictures. Thread
/// class: set-up.
std::string sheet_png(const Sheet& sheet, double scale = 2.0);
/// The same as an SVG document that holds its images.
std::string sheet_svg(const Sheet& sheet);

}  // namespace fuai
