// Makes, measures, checks and splits outlines.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Below this share of the squared perimeter an outline counts as a line: rounding of its own corners.
constexpr double kLeastAreaShare = 1e-12;

const Vec2& next_corner(std::span<const Vec2> polygon, std::size_t i) {
  return polygon[i + 1 == polygon.size() ? 0 : i + 1];
}

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

void check_length(double length, const char* key) {
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw Error(ErrorKind::kUsage, "a side of an outline must be positive", {"", 0, 0, key},
                "give a length in metres above zero");
  }
}

/// -1, 0, 1: c lies to the right of, on, to the left of the line from a to b.
int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double twice_area = cross(b - a, c - a);
  return (twice_area > 0.0) - (twice_area < 0.0);
}

/// Whether two closed segments have a point in common.
bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  for (int axis : {0, 1}) {
    if (std::max(a[axis], b[axis]) < std::min(c[axis], d[axis])) return false;
    if (std::max(c[axis], d[axis]) < std::min(a[axis], b[axis])) return false;
  }
  return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
}

/// Whether side i and the next one run back over each other.
bool folds_back(std::span<const Vec2> polygon, std::size_t i) {
  const Vec2& a = polygon[i];
  const Vec2& b = next_corner(polygon, i);
  const Vec2& c = polygon[(i + 2) % polygon.size()];
  return turn(a, b, c) == 0 && (b - a).dot(c - b) < 0.0;
}

bool meets_itself(std::span<const Vec2> polygon) {
  const std::size_t n = polygon.size();
  const auto low = [&](std::size_t i) { return std::min(polygon[i].x(), next_corner(polygon, i).x()); };
  const auto high = [&](std::size_t i) { return std::max(polygon[i].x(), next_corner(polygon, i).x()); };
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
  // Sides in the order of their left ends: only those that begin before side i ends can meet it.
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = order[k];
    if (folds_back(polygon, i)) return true;
    for (std::size_t m = k + 1; m < n && low(order[m]) <= high(i); ++m) {
      const std::size_t j = order[m];
      const bool neighbours = (i + 1) % n == j || (j + 1) % n == i;
      if (!neighbours &&
          segments_meet(polygon[i], next_corner(polygon, i), polygon[j], next_corner(polygon, j))) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

Polygon make_rectangle_outline(double width, double height) {
  check_length(width, "width");
  check_length(height, "height");
  return {Vec2(0.0, 0.0), Vec2(width, 0.0), Vec2(width, height), Vec2(0.0, height)};
}

Polygon make_disc_outline(double diameter, int segments) {
  check_length(diameter, "diameter");
  if (segments < 3) {
    throw Error(ErrorKind::kUsage, "a disc needs 3 segments or more", {"", 0, 0, "segments"},
                "leave out the number");
  }
  const int count = (segments + 3) / 4 * 4;
  const double step = 2.0 * std::numbers::pi / count;
  // Area of the polygon, count / 2 r^2 sin(step), equal to pi (d/2)^2.
  const double radius = 0.5 * diameter * std::sqrt(step / std::sin(step));
  Polygon outline;
  for (int i = 0; i < count; ++i) {
    outline.emplace_back(radius * std::cos(step * i), radius * std::sin(step * i));
  }
  return outline;
}

Polygon make_outline(std::span<const Vec2> corners) {
  Polygon outline;
  for (const Vec2& corner : corners) {
    if (!corner.allFinite()) {
      throw Error(ErrorKind::kBadInput,
                  "corner " + std::to_string(&corner - corners.data() + 1) + " is not finite",
                  {"", 0, 0, "outline"}, "give numbers in metres");
    }
    if (outline.empty() || corner != outline.back()) outline.push_back(corner);
  }
  while (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
  if (outline.size() < 3) {
    throw Error(ErrorKind::kBadInput, "an outline needs 3 different corners or more", {"", 0, 0, "outline"},
                "list the corners of the piece in order");
  }
  const double area = polygon_area(outline), perimeter = polygon_perimeter(outline);
  if (!(std::abs(area) > kLeastAreaShare * perimeter * perimeter)) {
    throw Error(ErrorKind::kBadInput, "the outline has no area", {"", 0, 0, "outline"},
                "list the corners in order round the piece");
  }
  if (meets_itself(outline)) {
    throw Error(ErrorKind::kBadInput, "the outline crosses or touches itself", {"", 0, 0, "outline"},
                "list the corners in order round the piece, and cut it in two where it touches");
  }
  if (area < 0.0) std::reverse(outline.begin(), outline.end());
  return outline;
}

Polygon rotate_outline(std::span<const Vec2> outline, double grain_angle) {
  const double c = std::cos(grain_angle), s = std::sin(grain_angle);
  Polygon turned;
  for (const Vec2& p : outline) turned.emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y());
  return turned;
}

double polygon_area(std::span<const Vec2> polygon) {
  double twice_area = 0.0;  // seen from the first corner, so that small polygons far from (0, 0) lose nothing
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    twice_area += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return 0.5 * twice_area;
}

Vec2 polygon_centroid(std::span<const Vec2> polygon) {
  Vec2 moment = Vec2::Zero();
  double twice_area = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - polygon[0], b = polygon[i + 1] - polygon[0];
    twice_area += cross(a, b);
    moment += cross(a, b) * (a + b) / 3.0;
  }
  return polygon[0] + moment / twice_area;
}

double polygon_perimeter(std::span<const Vec2> polygon) {
  double length = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) length += (next_corner(polygon, i) - polygon[i]).norm();
  return length;
}

bool polygon_contains(std::span<const Vec2> polygon, const Vec2& point) {
  bool inside = false;  // even-odd rule on the ray towards +x
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = next_corner(polygon, i);
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < x) inside = !inside;
  }
  return inside;
}

double polygon_signed_distance(std::span<const Vec2> polygon, const Vec2& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 side = next_corner(polygon, i) - polygon[i], to_point = point - polygon[i];
    const double share = std::clamp(to_point.dot(side) / side.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (to_point - share * side).norm());
  }
  return polygon_contains(polygon, point) ? -least : least;
}

}  // namespace fuai
