// Where a piece of cloth is held: regions of the flat cloth and how their edges cut yarns.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/cloth-pieces.md, "Clamps".
#pragma once

#include <variant>

#include "fuai/cloth/outline.h"

namespace fuai {

/// All points within radius of the centre [m].
struct DiscRegion {
  Vec2 centre = Vec2::Zero();
  double radius = 0.0;
};

/// All points with normal . point <= offset [m]; the normal is a unit vector and points out of the region.
struct HalfPlaneRegion {
  Vec2 normal = Vec2::UnitX();
  double offset = 0.0;
};

/// The inside of a simple polygon [m].
struct PolygonRegion {
  Polygon corners;
};

using Region = std::variant<DiscRegion, HalfPlaneRegion, PolygonRegion>;

/// The rectangle between two corners, material coordinates [m]. Thread class: set-up.
PolygonRegion make_rectangle_region(const Vec2& low, const Vec2& high);

/// Cloth held flat in a region of its material coordinates. It holds the tangent of a yarn that leaves the
/// region only if it holds at least two slots of that yarn, that is, if it reaches one spacing or more into
/// the cloth.
struct Clamp {
  Region region;
  /// True: the clamp ends at the edge of the region, between slots (the last slot it fixes lies within half a
  /// spacing of the edge, and the yarn bends from the edge on). False: it ends at the last slot inside.
  bool sub_cell = true;
};

/// @throws Error (kUsage) for a radius or normal that makes no sense, (kBadInput) for a bad polygon (see
/// make_outline()). Thread class: set-up.
void check_region(const Region& region);

/// Distance to the edge of the region [m], negative inside. Thread class: any.
double region_signed_distance(const Region& region, const Vec2& point);

/// Distance from the point along a unit direction to where a yarn running that way leaves the region [m];
/// negative when the point lies beyond. Minus infinity when the line misses the region behind the point, plus
/// infinity when it never leaves. Thread class: any.
double region_exit_distance(const Region& region, const Vec2& point, const Vec2& direction);

}  // namespace fuai
