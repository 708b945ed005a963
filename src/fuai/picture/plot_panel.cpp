// Draws one plot: bands, grid, curves with markers and arrowheads, labels and legend.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/plot_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "fuai/core/error.h"

namespace fuai {
namespace {

constexpr double kTextSize = 10.0;  // [pt]
constexpr Colour kInk{0.13, 0.13, 0.13, 1.0};
constexpr Colour kGridColour{0.88, 0.89, 0.90, 1.0};
constexpr Colour kMinorGridColour{0.94, 0.945, 0.95, 1.0};
constexpr Colour kZeroColour{0.45, 0.45, 0.45, 1.0};
TextStyle plain(double size = kTextSize) {
  TextStyle style;
  style.size = size;
  style.colour = kInk;
  return style;
}

Colour with_alpha(Colour colour, double alpha) {
  colour.alpha = alpha;
  return colour;
}

[[noreturn]] void wrong(const Plot& plot, const std::string& what) {
  throw Error(ErrorKind::kUsage, "plot \"" + plot.title + "\": " + what);
}

/// The range of an axis: as given, or around the finite numbers of all series and reference lines.
Range find_range(const Plot& plot, bool horizontal) {
  const std::optional<Range>& given = horizontal ? plot.x_range : plot.y_range;
  const bool log = horizontal ? plot.x_log : plot.y_log;
  if (given) {
    if (!std::isfinite(given->low) || !std::isfinite(given->high) || given->low >= given->high)
      wrong(plot, "the range of an axis is empty");
    if (log && given->low <= 0.0) wrong(plot, "a logarithmic axis starts at or below zero");
    return *given;
  }
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto include = [&](double value) {
    if (!std::isfinite(value) || (log && value <= 0.0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const Series& series : plot.series) {
    for (double value : horizontal ? series.x : series.y) include(value);
  }
  for (const ReferenceLine& line : plot.reference_lines) {
    if (line.vertical == horizontal) include(line.value);
  }
  if (low > high) return log ? Range{1.0, 10.0} : Range{0.0, 1.0};
  if (log) {
    const double room = std::max(std::pow(high / low, 0.05), 1.1);
    return {low / room, high * room};
  }
  // A twentieth of room at both ends; a single number gets a tenth of itself.
  const double least = high == 0.0 && low == 0.0 ? 1.0 : 0.1 * std::max(std::abs(low), std::abs(high));
  const double room = high - low > 1e-9 * least ? 0.05 * (high - low) : least;
  return {low - room, high + room};
}

Axis find_axis(const Plot& plot, bool horizontal, double length) {
  const Range range = find_range(plot, horizontal);
  return make_axis(range.low, range.high, horizontal ? plot.x_log : plot.y_log,
                   static_cast<int>(std::clamp(length / (horizontal ? 62.0 : 40.0), 2.0, 12.0)));
}

void line(cairo_t* cairo, double x0, double y0, double x1, double y1) {
  cairo_move_to(cairo, x0, y0);
  cairo_line_to(cairo, x1, y1);
  cairo_stroke(cairo);
}

}  // namespace

/// Finds free places for text among the curves.
struct PlotPanel::Placement {
  const Rectangle& frame;
  const std::vector<PlotCurve>& curves;
  std::vector<Rectangle> taken;

  /// Of the upper left corners offered, the one whose box is least crowded, the first of equals; it is moved
  /// into the frame, and its place is taken.
  Rectangle choose(const std::vector<Vec2>& corners, const TextBox& size) {
    Rectangle best;
    double least = std::numeric_limits<double>::infinity();
    for (const Vec2& corner : corners) {
      Rectangle box;
      box.left = std::clamp(corner.x(), frame.left, std::max(frame.left, frame.right - size.width));
      box.top = std::clamp(corner.y(), frame.top, std::max(frame.top, frame.bottom - size.height));
      box.right = box.left + size.width;
      box.bottom = box.top + size.height;
      double crowd = 0.0;
      for (const PlotCurve& curve : curves) crowd += curve.crowd(box);
      // Text over text is worse than text over a line.
      for (const Rectangle& other : taken) {
        const double width = std::min(box.right, other.right) - std::max(box.left, other.left);
        const double height = std::min(box.bottom, other.bottom) - std::max(box.top, other.top);
        if (width > 0.0 && height > 0.0) crowd += 10.0 * std::max(width, height);
      }
      if (crowd < least) {
        least = crowd;
        best = box;
      }
    }
    taken.push_back(best);
    return best;
  }
};

PlotPanel::PlotPanel(const Plot& plot, double width, double height)
    : plot_(plot), x_axis_(find_axis(plot, true, width)), y_axis_(find_axis(plot, false, height)) {
  for (const Series& series : plot.series) {
    if (series.x.size() != series.y.size())
      wrong(plot, "series \"" + series.label + "\" has " + std::to_string(series.x.size()) + " x but " +
                      std::to_string(series.y.size()) + " y");
    if (series.colour < -1) wrong(plot, "series \"" + series.label + "\" has a negative colour");
  }
}

PlotMargins PlotPanel::margins(cairo_t* cairo) const {
  double widest = 0.0;
  for (const Tick& tick : y_axis_.ticks)
    widest = std::max(widest, measure_text(cairo, tick.label, plain()).width);
  PlotMargins m;
  m.left = widest + 9.0 + (y_label().empty() ? 0.0 : 1.5 * kTextSize);
  m.bottom = 2.0 * kTextSize + (x_label().empty() ? 0.0 : 1.7 * kTextSize);
  m.top = (plot_.title.empty() ? 0.9 : 2.4) * kTextSize;
  m.right = 1.4 * kTextSize;
  return m;
}

PlotCurve PlotPanel::make_curve(std::size_t index, const Rectangle& frame) const {
  const Series& series = plot_.series[index];
  const int number = series.colour >= 0 ? series.colour : static_cast<int>(index);
  PlotCurve curve{&series, series_colour(number), {}, series.label};
  curve.points.reserve(series.x.size());
  int left_out = 0;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double x = series.x[i], y = series.y[i];
    Vec2 point = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    if (std::isfinite(x) && std::isfinite(y)) {
      if ((plot_.x_log && x <= 0.0) || (plot_.y_log && y <= 0.0)) {
        ++left_out;
      } else {
        // Far outside the frame Cairo's fixed-point numbers overflow; what is seen stays the same.
        point = Vec2(std::clamp(x_on(frame, x), -1e5, 1e5), std::clamp(y_on(frame, y), -1e5, 1e5));
      }
    }
    curve.points.push_back(point);
  }
  curve.thin_markers();
  if (left_out > 0) curve.label += " (" + std::to_string(left_out) + " values \u2264 0 left out)";
  return curve;
}

void PlotPanel::draw(cairo_t* cairo, const Rectangle& frame) const {
  cairo_save(cairo);
  cairo_rectangle(cairo, frame.left, frame.top, frame.width(), frame.height());
  cairo_clip(cairo);
  draw_bands_and_grid(cairo, frame);
  std::vector<PlotCurve> curves;
  for (std::size_t i = 0; i < plot_.series.size(); ++i) curves.push_back(make_curve(i, frame));
  for (const PlotCurve& curve : curves) curve.draw(cairo);
  Placement placement{frame, curves, {}};
  draw_lines_and_notes(cairo, placement);
  if (plot_.legend) draw_legend(cairo, placement);
  cairo_restore(cairo);
  draw_labels(cairo, frame);
}

void PlotPanel::draw_bands_and_grid(cairo_t* cairo, const Rectangle& frame) const {
  for (const Band& band : plot_.bands) {
    set_colour(cairo, with_alpha(series_colour(band.colour), 0.20));
    if (band.vertical) {
      const double a = x_on(frame, band.low), b = x_on(frame, band.high);
      cairo_rectangle(cairo, a, frame.top, b - a, frame.height());
    } else {
      const double a = y_on(frame, band.low), b = y_on(frame, band.high);
      cairo_rectangle(cairo, frame.left, a, frame.width(), b - a);
    }
    cairo_fill(cairo);
  }
  const auto grid_line = [&](const Axis& axis, bool vertical, double value) {
    const double x = vertical ? frame.left + frame.width() * axis.place(value) : frame.left;
    const double y = vertical ? frame.top : frame.bottom - frame.height() * axis.place(value);
    line(cairo, x, y, vertical ? x : frame.right, vertical ? frame.bottom : y);
  };
  for (bool vertical : {true, false}) {
    const Axis& axis = vertical ? x_axis_ : y_axis_;
    for (const Tick& tick : axis.ticks) {
      set_colour(cairo, tick.label.empty() ? kMinorGridColour : kGridColour);
      cairo_set_line_width(cairo, 0.7);
      grid_line(axis, vertical, tick.value);
    }
  }
  // The lines x = 0 and y = 0 over the grid.
  for (bool vertical : {true, false}) {
    const Axis& axis = vertical ? x_axis_ : y_axis_;
    if (axis.logarithmic || axis.low > 0.0 || axis.high < 0.0) continue;
    set_colour(cairo, kZeroColour);
    cairo_set_line_width(cairo, 0.9);
    grid_line(axis, vertical, 0.0);
  }
}

void PlotPanel::draw_lines_and_notes(cairo_t* cairo, Placement& placement) const {
  const Rectangle& frame = placement.frame;
  TextStyle small = plain(0.9 * kTextSize);
  small.halo = 1.6;
  for (const ReferenceLine& reference : plot_.reference_lines) {
    const std::array<double, 2> dots{1.2, 2.4};
    small.colour = series_colour(reference.colour);
    set_colour(cairo, small.colour);
    cairo_set_line_width(cairo, 1.0);
    cairo_set_dash(cairo, dots.data(), 2, 0.0);
    const double x = x_on(frame, reference.value), y = y_on(frame, reference.value);
    if (reference.vertical) {
      line(cairo, x, frame.top, x, frame.bottom);
    } else {
      line(cairo, frame.left, y, frame.right, y);
    }
    cairo_set_dash(cairo, nullptr, 0, 0.0);
    if (reference.label.empty()) continue;
    // The label at either end of its line.
    const TextBox box = measure_text(cairo, reference.label, small);
    if (reference.vertical) {
      const Rectangle place = placement.choose(
          {{x + 2.0, frame.top + 4.0}, {x + 2.0, frame.bottom - 4.0 - box.width}}, {box.height, box.width});
      draw_text(cairo, reference.label, place.left, place.top, {0.0, 1.0}, small, 0.5 * std::numbers::pi);
    } else {
      const Rectangle place = placement.choose(
          {{frame.right - 4.0 - box.width, y - box.height}, {frame.left + 4.0, y - box.height}}, box);
      draw_text(cairo, reference.label, place.left, place.top, {0.0, 0.0}, small);
    }
  }
  small.colour = kInk;
  for (const Annotation& note : plot_.annotations) {
    const double x = x_on(frame, note.x), y = y_on(frame, note.y), gap = 5.0;
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    // Around its point, where the fewest data are.
    const TextBox box = measure_text(cairo, note.text, small);
    const double middle_x = x - 0.5 * box.width, middle_y = y - 0.5 * box.height;
    const Rectangle place = placement.choose({{x + gap, middle_y},
                                              {x - gap - box.width, middle_y},
                                              {middle_x, y - gap - box.height},
                                              {middle_x, y + gap}},
                                             box);
    draw_text(cairo, note.text, place.left, place.top, {0.0, 0.0}, small);
  }
}

void PlotPanel::draw_labels(cairo_t* cairo, const Rectangle& frame) const {
  // Frame and ticks.
  set_colour(cairo, kInk);
  cairo_set_line_width(cairo, 0.9);
  cairo_rectangle(cairo, frame.left, frame.top, frame.width(), frame.height());
  cairo_stroke(cairo);
  for (const Tick& tick : x_axis_.ticks) {
    const double x = x_on(frame, tick.value);
    set_colour(cairo, kInk);
    line(cairo, x, frame.bottom, x, frame.bottom + (tick.label.empty() ? 2.0 : 4.0));
    draw_text(cairo, tick.label, x, frame.bottom + 4.5, {0.5, 0.0}, plain());
  }
  double widest = 0.0;
  for (const Tick& tick : y_axis_.ticks) {
    const double y = y_on(frame, tick.value);
    set_colour(cairo, kInk);
    line(cairo, frame.left, y, frame.left - (tick.label.empty() ? 2.0 : 4.0), y);
    draw_text(cairo, tick.label, frame.left - 6.5, y, {1.0, 0.5}, plain());
    widest = std::max(widest, measure_text(cairo, tick.label, plain()).width);
  }
  // Names of the axes, powers of ten, title.
  const double middle = 0.5 * (frame.left + frame.right);
  TextStyle bold = plain(1.1 * kTextSize);
  bold.bold = true;
  draw_text(cairo, x_label(), middle, frame.bottom + 1.9 * kTextSize, {0.5, 0.0}, plain(1.05 * kTextSize));
  draw_text(cairo, y_label(), frame.left - widest - 9.0, 0.5 * (frame.top + frame.bottom), {0.5, 1.0},
            plain(1.05 * kTextSize), -0.5 * std::numbers::pi);
  draw_text(cairo, plot_.title, middle, frame.top - 4.0, {0.5, 1.0}, bold);
}

void PlotPanel::draw_legend(cairo_t* cairo, Placement& placement) const {
  struct Row {
    const PlotCurve* curve;
    const Band* band;
    std::string label;
  };
  std::vector<Row> rows;
  for (const PlotCurve& curve : placement.curves) {
    if (!curve.label.empty()) rows.push_back({&curve, nullptr, curve.label});
  }
  for (const Band& band : plot_.bands) {
    if (!band.label.empty()) rows.push_back({nullptr, &band, band.label});
  }
  if (rows.empty()) return;
  const TextStyle style = plain(0.95 * kTextSize);
  const double sample = 24.0, row_height = 1.45 * style.size, pad = 5.0, gap = 6.0;
  TextBox size;
  for (const Row& row : rows) size.width = std::max(size.width, measure_text(cairo, row.label, style).width);
  size.width += sample + 3.0 * pad;
  size.height = row_height * static_cast<double>(rows.size()) + pad;

  const Rectangle& frame = placement.frame;
  const double left = frame.left + gap, right = frame.right - gap - size.width;
  const double top = frame.top + gap, bottom = frame.bottom - gap - size.height;
  const Rectangle box = placement.choose({{right, top}, {left, top}, {right, bottom}, {left, bottom}}, size);
  cairo_rectangle(cairo, box.left, box.top, box.width(), box.height());
  set_colour(cairo, {1.0, 1.0, 1.0, 0.86});
  cairo_fill_preserve(cairo);
  set_colour(cairo, {0.8, 0.8, 0.8, 1.0});
  cairo_set_line_width(cairo, 0.6);
  cairo_stroke(cairo);
  double y = box.top + 0.5 * (pad + row_height);
  for (const Row& row : rows) {
    const double x0 = box.left + pad, x1 = x0 + sample;
    if (row.curve != nullptr) {
      row.curve->draw_sample(cairo, x0, x1, y);
    } else {
      cairo_rectangle(cairo, x0, y - 0.35 * style.size, sample, 0.7 * style.size);
      set_colour(cairo, with_alpha(series_colour(row.band->colour), 0.35));
      cairo_fill(cairo);
    }
    draw_text(cairo, row.label, x1 + pad, y, {0.0, 0.5}, style);
    y += row_height;
  }
}

}  // namespace fuai
