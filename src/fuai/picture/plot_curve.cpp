// Draws the lines, arrowheads and markers of a series.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/plot_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fuai/picture/canvas.h"

namespace fuai {
namespace {

constexpr double kMarkerRadius = 2.4;              // [pt]
constexpr double kMarkerDistance = kMarkerRadius;  // closer markers on a line are thinned out [pt]
constexpr double kArrowDistance = 110.0;           // between arrowheads along a line [pt]

/// Strokes the runs of points between interruptions.
void stroke_line(cairo_t* cairo, const std::vector<Vec2>& points) {
  bool drawing = false;
  for (const Vec2& p : points) {
    if (!p.allFinite()) {
      drawing = false;
    } else if (drawing) {
      cairo_line_to(cairo, p.x(), p.y());
    } else {
      cairo_move_to(cairo, p.x(), p.y());
      drawing = true;
    }
  }
  cairo_stroke(cairo);
}

void fill_arrowhead(cairo_t* cairo, const Vec2& middle, const Vec2& ahead, double size) {
  const Vec2 aside(-ahead.y(), ahead.x());
  const Vec2 tip = middle + 0.6 * size * ahead, tail = middle - 0.6 * size * ahead;
  const Vec2 notch = middle - 0.3 * size * ahead;
  const Vec2 left = tail + 0.45 * size * aside, right = tail - 0.45 * size * aside;
  cairo_move_to(cairo, tip.x(), tip.y());
  for (const Vec2& p : {left, notch, right}) cairo_line_to(cairo, p.x(), p.y());
  cairo_close_path(cairo);
  cairo_fill(cairo);
}

/// Arrowheads along each uninterrupted run, at equal distances of about kArrowDistance, at least one a run.
void draw_arrowheads(cairo_t* cairo, const std::vector<Vec2>& points, double size) {
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin;
    std::vector<double> path;  // length from the start of the run
    while (end < points.size() && points[end].allFinite()) {
      path.push_back(path.empty() ? 0.0 : path.back() + (points[end] - points[end - 1]).norm());
      ++end;
    }
    const auto at = [&, begin](double s) -> Vec2 {
      const auto upper = std::upper_bound(path.begin() + 1, path.end() - 1, s);
      const auto i = static_cast<std::size_t>(upper - path.begin());
      const double step = path[i] - path[i - 1], w = step > 0.0 ? (s - path[i - 1]) / step : 0.0;
      return points[begin + i - 1] + w * (points[begin + i] - points[begin + i - 1]);
    };
    if (path.size() >= 2 && path.back() > 2.5 * size) {
      const int count = std::max(1, static_cast<int>(std::lround(path.back() / kArrowDistance)));
      for (int k = 0; k < count; ++k) {
        const double s = path.back() * (k + 0.5) / count;
        // The chord over the arrowhead's length is its direction.
        const Vec2 chord = at(s + 0.6 * size) - at(s - 0.6 * size);
        if (chord.norm() > 1e-6) fill_arrowhead(cairo, at(s), chord.normalized(), size);
      }
    }
    begin = end + 1;
  }
}

/// How the line or marker of a curve looks, also in the legend.
void set_stroke(cairo_t* cairo, const Series& series, const Colour& colour) {
  const std::array<double, 2> dashes{3.2 * series.line_width, 2.2 * series.line_width};
  set_colour(cairo, colour);
  cairo_set_line_width(cairo, series.line_width);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_set_dash(cairo, dashes.data(), series.style == SeriesStyle::kDashed ? 2 : 0, 0.0);
}

/// An open ring on white, so that neighbours and lines stay visible.
void draw_marker(cairo_t* cairo, const Vec2& p, const Colour& colour) {
  cairo_new_sub_path(cairo);
  cairo_arc(cairo, p.x(), p.y(), kMarkerRadius, 0.0, 2.0 * std::numbers::pi);
  set_colour(cairo, {1.0, 1.0, 1.0, 0.75});
  cairo_fill_preserve(cairo);
  set_colour(cairo, colour);
  cairo_set_line_width(cairo, 1.1);
  cairo_stroke(cairo);
}

}  // namespace

void PlotCurve::thin_markers() {
  if (series->style != SeriesStyle::kLineAndPoints) return;
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double step = (points[i] - points[i - 1]).norm();
    if (std::isfinite(step)) length += step;
  }
  if (length == 0.0) return;
  const double distance = length / static_cast<double>(points.size());
  marker_stride = std::max(1, static_cast<int>(std::ceil(kMarkerDistance / distance)));
  if (marker_stride > 1) label += " (a marker every " + std::to_string(marker_stride) + " points)";
}

void PlotCurve::draw(cairo_t* cairo) const {
  if (has_line()) {
    set_stroke(cairo, *series, colour);
    stroke_line(cairo, points);
    cairo_set_dash(cairo, nullptr, 0, 0.0);
    if (series->arrows) draw_arrowheads(cairo, points, 5.0 + 2.6 * series->line_width);
  }
  if (!has_markers()) return;
  for (std::size_t i = 0; i < points.size(); i += static_cast<std::size_t>(marker_stride)) {
    if (points[i].allFinite()) draw_marker(cairo, points[i], colour);
  }
}

void PlotCurve::draw_sample(cairo_t* cairo, double x0, double x1, double y) const {
  const Vec2 middle(0.5 * (x0 + x1), y);
  if (has_line()) {
    set_stroke(cairo, *series, colour);
    stroke_line(cairo, {Vec2(x0, y), Vec2(x1, y)});
    cairo_set_dash(cairo, nullptr, 0, 0.0);
    if (series->arrows) fill_arrowhead(cairo, middle, Vec2(1.0, 0.0), 8.0);
  }
  if (has_markers()) draw_marker(cairo, middle, colour);
}

double PlotCurve::crowd(const Rectangle& box) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (has_markers() && box.contains(points[i])) sum += 2.0 * kMarkerRadius;
    if (i == 0 || !has_line()) continue;
    const Vec2 step = points[i] - points[i - 1];
    if (!step.allFinite()) continue;
    // Sample each segment every two points of the paper or so.
    const int pieces = static_cast<int>(std::clamp(step.norm() / 2.0, 1.0, 2000.0));
    for (int k = 0; k < pieces; ++k) {
      if (box.contains(points[i - 1] + (k + 0.5) / pieces * step)) sum += step.norm() / pieces;
    }
  }
  return sum;
}

}  // namespace fuai
