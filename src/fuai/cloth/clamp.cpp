// Distances to the edges of clamp regions.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/clamp.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fuai/core/error.h"

namespace fuai {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A point nearer to an edge than this is on it [m]: far below a yarn, far above rounding.
constexpr double kOnEdge = 1e-9;

/// Direction cosines below this are taken as parallel to an edge.
constexpr double kParallel = 1e-12;

struct SignedDistance {
  Vec2 point;
  double operator()(const DiscRegion& disc) const { return (point - disc.centre).norm() - disc.radius; }
  double operator()(const HalfPlaneRegion& half) const { return half.normal.dot(point) - half.offset; }
  double operator()(const PolygonRegion& polygon) const {
    return polygon_signed_distance(polygon.corners, point);
  }
};

struct ExitDistance {
  Vec2 point, direction;

  double operator()(const DiscRegion& disc) const {
    const Vec2 d = point - disc.centre;
    const double half = d.dot(direction), inside = disc.radius * disc.radius - d.squaredNorm();
    const double discriminant = half * half + inside;
    const double exit = discriminant >= 0.0 ? -half + std::sqrt(discriminant) : -kNever;
    return inside < 0.0 && exit > 0.0 ? -kNever : exit;  // outside and moving towards the disc
  }

  double operator()(const HalfPlaneRegion& half) const {
    const double distance = half.offset - half.normal.dot(point), speed = half.normal.dot(direction);
    if (speed > kParallel) return distance / speed;
    return distance < 0.0 ? -kNever : kNever;
  }

  double operator()(const PolygonRegion& polygon) const {
    const bool inside = polygon_contains(polygon.corners, point);
    const Vec2 across(-direction.y(), direction.x());
    double ahead = kNever, behind = -kNever;
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      const Vec2 a = polygon.corners[i] - point;
      const Vec2 b = polygon.corners[(i + 1) % polygon.corners.size()] - point;
      const double a_across = a.dot(across), b_across = b.dot(across);
      if ((a_across > 0.0) == (b_across > 0.0)) continue;
      const double share = a_across / (a_across - b_across);
      const double t = (1.0 - share) * a.dot(direction) + share * b.dot(direction);
      if (std::abs(t) < kOnEdge) return 0.0;
      (t > 0.0 ? ahead : behind) = t > 0.0 ? std::min(ahead, t) : std::max(behind, t);
    }
    return inside ? ahead : behind;
  }
};

struct Check {
  void operator()(const DiscRegion& disc) const {
    if (!disc.centre.allFinite() || !(disc.radius > 0.0) || !std::isfinite(disc.radius)) {
      throw Error(ErrorKind::kUsage, "the radius of a clamp must be positive", {"", 0, 0, "clamps"},
                  "give a centre and a radius in metres");
    }
  }
  void operator()(const HalfPlaneRegion& half) const {
    if (!std::isfinite(half.offset) || !(std::abs(half.normal.norm() - 1.0) < 1e-6)) {
      throw Error(ErrorKind::kUsage, "the normal of a clamp must be a unit vector", {"", 0, 0, "clamps"},
                  "divide the normal by its length");
    }
  }
  void operator()(const PolygonRegion& polygon) const { make_outline(polygon.corners); }
};

}  // namespace

PolygonRegion make_rectangle_region(const Vec2& low, const Vec2& high) {
  return {{low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())}};
}

void check_region(const Region& region) { std::visit(Check{}, region); }

double region_signed_distance(const Region& region, const Vec2& point) {
  return std::visit(SignedDistance{point}, region);
}

double region_exit_distance(const Region& region, const Vec2& point, const Vec2& direction) {
  return std::visit(ExitDistance{point, direction}, region);
}

}  // namespace fuai
