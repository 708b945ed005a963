// Draws a page and writes it as PNG or SVG.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/sheet.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fuai/core/error.h"
#include "fuai/picture/canvas.h"
#include "fuai/picture/plot_page.h"

namespace fuai {
namespace {

constexpr double kCellGap = 4.0;  // between columns [pt]
constexpr const char* kDots = "…";

TextStyle style_of(double size, bool bold, const Colour& colour) {
  TextStyle style;
  style.size = size;
  style.bold = bold;
  style.colour = colour;
  return style;
}

/// The text, cut before a character so that it and the dots fit.
std::string fitted(cairo_t* cairo, const std::string& text, const TextStyle& style, double width) {
  if (measure_text(cairo, text, style).width <= width) return text;
  std::string cut = clean_utf8(text);
  while (!cut.empty()) {
    // A whole character: its continuation bytes, then its first.
    while (cut.size() > 1 && (static_cast<unsigned char>(cut.back()) & 0xc0U) == 0x80U) cut.pop_back();
    cut.pop_back();
    if (measure_text(cairo, cut + kDots, style).width <= width) break;
  }
  return cut + kDots;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return lines;
}

void draw(cairo_t* cairo, const SheetText& text) {
  const TextStyle style = style_of(text.size, text.bold, text.colour);
  std::vector<std::string> lines = lines_of(wrap_text(cairo, text.text, style, text.box.width));
  const double line_height = measure_text(cairo, "x", style).height;
  const auto room = static_cast<std::size_t>(std::max(1.0, std::floor(text.box.height / line_height + 0.01)));
  if (lines.size() > room) {
    lines.resize(room);
    lines.back() = fitted(cairo, lines.back() + " " + kDots, style, text.box.width);
  }
  const double x = text.box.left + (text.centred ? 0.5 * text.box.width : 0.0);
  double y = text.box.top;
  for (const std::string& line : lines) {
    draw_text(cairo, line, x, y, {text.centred ? 0.5 : 0.0, 0.0}, style);
    y += line_height;
  }
}

void draw(cairo_t* cairo, const SheetImage& item) {
  const Image& image = item.image;
  const SheetBox& box = item.box;
  const double scale = std::min(box.width / image.width, box.height / image.height);
  const double width = scale * image.width, height = scale * image.height;
  draw_image(cairo, image, box.left + 0.5 * (box.width - width), box.top + 0.5 * (box.height - height), width,
             height);
}

void draw_line(cairo_t* cairo, const SheetBox& box, double y, double width, double grey) {
  set_colour(cairo, {grey, grey, grey, 1.0});
  cairo_set_line_width(cairo, width);
  cairo_move_to(cairo, box.left, y);
  cairo_line_to(cairo, box.left + box.width, y);
  cairo_stroke(cairo);
}

void draw_row(cairo_t* cairo, const SheetTable& table, const std::vector<std::string>& cells, double middle,
              const TextStyle& style) {
  const double sum = std::accumulate(table.columns.begin(), table.columns.end(), 0.0);
  double left = table.box.left;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double width = table.box.width * table.columns[i] / sum;
    const std::string text = fitted(cairo, cells[i], style, width - kCellGap);
    const bool right = i < table.right.size() && table.right[i];
    draw_text(cairo, text, right ? left + width - kCellGap : left, middle, {right ? 1.0 : 0.0, 0.5}, style);
    left += width;
  }
}

void draw(cairo_t* cairo, const SheetTable& table) {
  constexpr double kDark = 0.45, kPale = 0.88;
  double y = table.box.top;
  draw_row(cairo, table, table.head, y + 0.5 * table.row_height,
           style_of(table.size, true, {0.13, 0.13, 0.13, 1.0}));
  y += table.row_height;
  draw_line(cairo, table.box, y, 0.8, kDark);
  for (const SheetRow& row : table.rows) {
    draw_row(cairo, table, row.cells, y + 0.5 * table.row_height, style_of(table.size, false, row.colour));
    y += table.row_height;
    draw_line(cairo, table.box, y, 0.4, kPale);
  }
}

void draw(cairo_t* cairo, const SheetPlots& plots) {
  cairo_save(cairo);
  cairo_translate(cairo, plots.box.left, plots.box.top);
  draw_plots(cairo, plots.grid, plots.box.width, plots.box.height);
  cairo_restore(cairo);
}

void draw_sheet(cairo_t* cairo, const Sheet& sheet) {
  set_colour(cairo, {1.0, 1.0, 1.0, 1.0});
  cairo_paint(cairo);
  for (const SheetPlots& plots : sheet.plots) draw(cairo, plots);
  for (const SheetImage& image : sheet.images) draw(cairo, image);
  for (const SheetTable& table : sheet.tables) draw(cairo, table);
  for (const SheetText& text : sheet.texts) draw(cairo, text);
}

void check_sheet(const Sheet& sheet) {
  check_image_size(sheet.width, sheet.height);
  for (const SheetTable& table : sheet.tables) {
    const auto fits = [&](const std::vector<std::string>& cells) {
      return cells.size() == table.columns.size();
    };
    if (!fits(table.head) ||
        !std::ranges::all_of(table.rows, [&](const SheetRow& row) { return fits(row.cells); }))
      throw Error(ErrorKind::kUsage, "a table of a page has rows of different lengths");
  }
  for (const SheetImage& image : sheet.images) check_image_size(image.image.width, image.image.height);
}

}  // namespace

std::string sheet_png(const Sheet& sheet, double scale) {
  check_sheet(sheet);
  Image blank;
  blank.width = static_cast<int>(std::lround(sheet.width * scale));
  blank.height = static_cast<int>(std::lround(sheet.height * scale));
  check_image_size(blank.width, blank.height);
  blank.pixels.assign(4 * static_cast<std::size_t>(blank.width) * static_cast<std::size_t>(blank.height),
                      255);
  Canvas canvas(blank);
  cairo_scale(canvas.cairo(), scale, scale);
  draw_sheet(canvas.cairo(), sheet);
  return encode_png(canvas.take_image());
}

std::string sheet_svg(const Sheet& sheet) {
  check_sheet(sheet);
  Canvas canvas(static_cast<double>(sheet.width), static_cast<double>(sheet.height));
  draw_sheet(canvas.cairo(), sheet);
  return canvas.take_svg();
}

}  // namespace fuai
