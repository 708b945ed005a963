// Lays plots out on a page and writes the page as PNG or SVG.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/plot.h"

#include <algorithm>
#include <cmath>

#include "fuai/core/error.h"
#include "fuai/picture/plot_page.h"
#include "fuai/picture/plot_panel.h"

namespace fuai {
namespace {

constexpr double kTitleSize = 13.0;  // [pt]

void check_grid(const PlotGrid& grid, int width, int height, double scale) {
  if (grid.columns < 1) throw Error(ErrorKind::kUsage, "a grid of plots needs at least one column");
  if (!(scale > 0.0) || scale > 64.0)
    throw Error(ErrorKind::kUsage, "the scale of a plot must be in (0, 64]");
  check_image_size(width, height);
}

}  // namespace

void draw_plots(cairo_t* cairo, const PlotGrid& grid, double width, double height) {
  double top = 4.0;
  if (!grid.title.empty()) {
    TextStyle style;
    style.size = kTitleSize;
    style.bold = true;
    const std::string title = wrap_text(cairo, grid.title, style, width - 20.0);
    draw_text(cairo, title, 0.5 * width, 6.0, {0.5, 0.0}, style);
    top += 6.0 + measure_text(cairo, title, style).height;
  }
  // Every panel has the same margins, so that the frames stand in line.
  const auto columns = static_cast<std::size_t>(grid.columns);
  const std::size_t rows = (grid.plots.size() + columns - 1) / columns;
  const double cell_width = (width - 8.0) / static_cast<double>(columns);
  const double cell_height = (height - top - 4.0) / static_cast<double>(std::max<std::size_t>(rows, 1));
  std::vector<PlotPanel> panels;
  PlotMargins margins;
  for (const Plot& plot : grid.plots) {
    panels.emplace_back(plot, cell_width, cell_height);
    const PlotMargins own = panels.back().margins(cairo);
    margins.left = std::max(margins.left, own.left);
    margins.right = std::max(margins.right, own.right);
    margins.top = std::max(margins.top, own.top);
    margins.bottom = std::max(margins.bottom, own.bottom);
  }
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::size_t row = i / columns, column = i % columns;
    const double left = 4.0 + cell_width * static_cast<double>(column);
    const double cell_top = top + cell_height * static_cast<double>(row);
    const Rectangle frame{left + margins.left, cell_top + margins.top, left + cell_width - margins.right,
                          cell_top + cell_height - margins.bottom};
    if (frame.width() < 20.0 || frame.height() < 20.0)
      throw Error(ErrorKind::kUsage, "the page is too small for its plots", {},
                  "choose a larger width or height");
    panels[i].draw(cairo, frame);
  }
}

std::string plot_png(const PlotGrid& grid, int width, int height, double scale) {
  check_grid(grid, width, height, scale);
  Image blank;
  blank.width = static_cast<int>(std::lround(width * scale));
  blank.height = static_cast<int>(std::lround(height * scale));
  check_image_size(blank.width, blank.height);
  blank.pixels.assign(4 * static_cast<std::size_t>(blank.width) * static_cast<std::size_t>(blank.height),
                      255);
  Canvas canvas(blank);
  cairo_scale(canvas.cairo(), scale, scale);
  draw_plots(canvas.cairo(), grid, width, height);
  return encode_png(canvas.take_image());
}

std::string plot_png(const Plot& plot, int width, int height, double scale) {
  return plot_png(PlotGrid{{}, 1, {plot}}, width, height, scale);
}

std::string plot_svg(const PlotGrid& grid, int width, int height) {
  check_grid(grid, width, height, 1.0);
  Canvas canvas(static_cast<double>(width), static_cast<double>(height));
  set_colour(canvas.cairo(), {1.0, 1.0, 1.0, 1.0});
  cairo_paint(canvas.cairo());
  draw_plots(canvas.cairo(), grid, width, height);
  return canvas.take_svg();
}

std::string plot_svg(const Plot& plot, int width, int height) {
  return plot_svg(PlotGrid{{}, 1, {plot}}, width, height);
}

}  // namespace fuai
