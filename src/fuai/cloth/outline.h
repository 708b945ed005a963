// Outlines of cloth pieces: simple polygons in pattern coordinates, made, measured, turned, checked and
// split.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/cloth-pieces.md.
#pragma once

#include <span>
#include <vector>

#include "fuai/core/types.h"

namespace fuai {

/// Corners in order, the last joined to the first.
using Polygon = std::vector<Vec2>;

/// A rectangle from (0, 0) to (width, height), counter-clockwise; width runs along the weft [m].
/// @throws Error (kUsage) unless both are positive and finite. Thread class: set-up.
Polygon make_rectangle_outline(double width, double height);

/// A disc about (0, 0) as a regular polygon with the area of the disc (its corners lie a little outside the
/// circle); perimeter and corners are off by (pi / segments)^2 / 6 and (pi / segments)^2 / 3 relative.
/// @param diameter [m]
/// @param segments sides, rounded up to a multiple of 4
/// @throws Error (kUsage) when the diameter is not positive and finite or segments < 3. Thread class: set-up.
Polygon make_disc_outline(double diameter, int segments = 720);

/// Any polygon, made fit for a piece of cloth: counter-clockwise, repeated corners dropped.
/// @throws Error (kBadInput) when a coordinate is not finite, fewer than 3 corners are left, the outline
/// meets itself, or it has no area. Thread class: set-up.
Polygon make_outline(std::span<const Vec2> corners);

/// The outline turned about (0, 0) counter-clockwise, so that its grain line makes grain_angle [rad] with the
/// yarns. The lattice is never turned. Thread class: set-up.
Polygon rotate_outline(std::span<const Vec2> outline, double grain_angle);

/// Area [m2], negative when the corners run clockwise. Thread class: any.
double polygon_area(std::span<const Vec2> polygon);

/// First moment of area over area: the centre of mass [m]. The area must not vanish. Thread class: any.
Vec2 polygon_centroid(std::span<const Vec2> polygon);

/// Length of all sides [m]. Thread class: any.
double polygon_perimeter(std::span<const Vec2> polygon);

/// Whether the point lies inside; undecided on the sides. Thread class: any.
bool polygon_contains(std::span<const Vec2> polygon, const Vec2& point);

/// Distance to the nearest side [m], negative inside. Thread class: any.
double polygon_signed_distance(std::span<const Vec2> polygon, const Vec2& point);

/// What lies on either side of a line x = at (axis 0) or y = at (axis 1).
struct SplitPolygon {
  std::vector<Polygon> low, high;  ///< simple polygons, counter-clockwise; none without extent
};

/// Cuts a simple counter-clockwise polygon by an axis-parallel line. Both sides share the very same crossing
/// points, which have the coordinate `at` exactly, so that areas add up to rounding and corners can be welded
/// by comparing bits. Thread class: set-up.
SplitPolygon split_polygon(const Polygon& polygon, int axis, double at);

}  // namespace fuai
