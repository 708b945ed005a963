// Projects, fills and reads the shadow.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/drape_shadow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fuai/cloth/smooth_surface.h"

namespace fuai {
namespace {

using Index = std::size_t;
constexpr double kTurn = 2.0 * std::numbers::pi;
/// Rings of the polar mesh are at most so far apart [m]: two pixels.
constexpr double kRingSpacing = 2.0 * kShadowPixel;

/// The true annulus on the smooth surface, ring after ring from just inside the disc, so that no slit shows
/// between them, to the edge.
struct PolarMesh {
  int rings = 0;             // cells between the disc and the edge
  std::vector<Vec3> points;  // (rings + 1) * kShadowDirections

  const Vec3& at(int ring, int direction) const {
    return points[static_cast<Index>(ring) * kShadowDirections +
                  static_cast<Index>(direction % kShadowDirections)];
  }
};

PolarMesh make_polar_mesh(const DrapeGeometry& geometry, const SmoothSurface& surface) {
  PolarMesh mesh;
  const double width = geometry.overhang() + kRingSpacing;
  mesh.rings = static_cast<int>(std::ceil(width / kRingSpacing));
  for (int ring = 0; ring <= mesh.rings; ++ring) {
    const double radius = 0.5 * geometry.specimen - width * (mesh.rings - ring) / mesh.rings;
    for (int direction = 0; direction < kShadowDirections; ++direction) {
      const double angle = kTurn * direction / kShadowDirections;
      mesh.points.push_back(surface.at(radius * Vec2(std::cos(angle), std::sin(angle))));
    }
  }
  return mesh;
}

/// Marks the pixels whose middle the triangle covers.
class Raster {
 public:
  Raster(double reach, double pixel) : pixel_(pixel) {
    half_ = static_cast<int>(std::ceil(reach / pixel)) + 1;
    marks_.assign(static_cast<Index>(side()) * static_cast<Index>(side()), 0);
  }
  int side() const { return 2 * half_; }
  std::vector<std::uint8_t> take() { return std::move(marks_); }

  void fill_disc(double radius) {
    for (int row = 0; row < side(); ++row) {
      for (int column = 0; column < side(); ++column)
        if (Vec2(column - half_ + 0.5, half_ - row - 0.5).norm() * pixel_ <= radius) mark(column, row);
    }
  }

  void fill(const Vec3& a, const Vec3& b, const Vec3& c) {
    // Pixel coordinates: column to the right, row downward, middles at whole numbers.
    const Vec2 p[3] = {place(a), place(b), place(c)};
    const double low_row = std::min({p[0].y(), p[1].y(), p[2].y()});
    const double high_row = std::max({p[0].y(), p[1].y(), p[2].y()});
    const int first = std::max(0, static_cast<int>(std::ceil(low_row)));
    const int last = std::min(side() - 1, static_cast<int>(std::floor(high_row)));
    for (int row = first; row <= last; ++row) {
      double left = 1e300, right = -1e300;
      for (int i = 0; i < 3; ++i) {
        const Vec2 &s = p[i], &e = p[(i + 1) % 3];
        // A level side adds nothing to the ends of the other two.
        if (s.y() == e.y() || std::min(s.y(), e.y()) > row || std::max(s.y(), e.y()) < row) continue;
        const double x = s.x() + (row - s.y()) / (e.y() - s.y()) * (e.x() - s.x());
        left = std::min(left, x);
        right = std::max(right, x);
      }
      const int begin = std::max(0, static_cast<int>(std::ceil(left)));
      const int end = std::min(side() - 1, static_cast<int>(std::floor(right)));
      for (int column = begin; column <= end; ++column) mark(column, row);
    }
  }

  double area() const {
    return static_cast<double>(std::count(marks_.begin(), marks_.end(), std::uint8_t{1})) * pixel_ * pixel_;
  }

 private:
  Vec2 place(const Vec3& x) const { return {x.x() / pixel_ + half_ - 0.5, half_ - 0.5 - x.y() / pixel_}; }
  void mark(int column, int row) {
    marks_[static_cast<Index>(row) * static_cast<Index>(side()) + static_cast<Index>(column)] = 1;
  }
  double pixel_;
  int half_ = 0;
  std::vector<std::uint8_t> marks_;
};

/// Where the ray in direction `ray` meets the line through a and b [m]; the farther end where it runs along.
double reach_along(const Vec2& ray, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double across = ray.x() * along.y() - ray.y() * along.x();
  const double farthest = std::max(a.norm(), b.norm());
  if (!(std::abs(across) > 1e-15)) return farthest;
  return std::min((a.x() * b.y() - a.y() * b.x()) / across, farthest);
}

/// Farthest point of the mesh in every direction: segments along the rings, which cross all azimuths.
std::vector<double> outline_of(const DrapeGeometry& geometry, const PolarMesh& mesh) {
  std::vector<double> outline(kShadowDirections, 0.5 * geometry.disc);
  const double step = kTurn / kShadowDirections;
  for (int ring = 0; ring <= mesh.rings; ++ring) {
    for (int direction = 0; direction < kShadowDirections; ++direction) {
      const Vec2 a = mesh.at(ring, direction).head<2>(), b = mesh.at(ring, direction + 1).head<2>();
      const double start = std::atan2(a.y(), a.x());
      const double end = start + std::remainder(std::atan2(b.y(), b.x()) - start, kTurn);
      const int first = static_cast<int>(std::ceil(std::min(start, end) / step));
      const int last = static_cast<int>(std::floor(std::max(start, end) / step));
      for (int k = first; k <= last; ++k) {
        const double radius = reach_along(Vec2(std::cos(k * step), std::sin(k * step)), a, b);
        const int bin = (k % kShadowDirections + kShadowDirections) % kShadowDirections;
        outline[static_cast<Index>(bin)] = std::max(outline[static_cast<Index>(bin)], radius);
      }
    }
  }
  return outline;
}

std::vector<double> smoothed(std::span<const double> outline) {
  const auto count = static_cast<int>(outline.size());
  const int reach = static_cast<int>(std::lround(kNodeSmoothing / kTurn * count));
  std::vector<double> result(outline.size());
  for (int i = 0; i < count; ++i) {
    double sum = 0.0;
    for (int j = -reach; j <= reach; ++j) sum += outline[static_cast<Index>((i + j + count) % count)];
    result[static_cast<Index>(i)] = sum / (2 * reach + 1);
  }
  return result;
}

/// Lowest value on the way from a crest to higher ground, or all around.
double lowest_on_the_way(const std::vector<double>& r, int crest, int step) {
  const auto count = static_cast<int>(r.size());
  const double top = r[static_cast<Index>(crest)];
  double lowest = top;
  for (int k = 1; k < count; ++k) {
    const double here = r[static_cast<Index>(((crest + step * k) % count + count) % count)];
    if (here > top) break;
    lowest = std::min(lowest, here);
  }
  return lowest;
}

}  // namespace

double DrapeShadow::mean_amplitude() const noexcept {
  double sum = 0.0;
  for (const DrapeNode& node : nodes) sum += node.amplitude;
  return nodes.empty() ? 0.0 : sum / static_cast<double>(nodes.size());
}

std::vector<DrapeNode> find_nodes(std::span<const double> outline, double overhang) {
  const std::vector<double> r = smoothed(outline);
  const auto count = static_cast<int>(r.size());
  const auto at = [&](int i) { return r[static_cast<Index>((i % count + count) % count)]; };
  std::vector<int> crests;
  for (int i = 0; i < count; ++i) {
    if (!(at(i) > at(i - 1) && at(i) >= at(i + 1))) continue;
    const double valley = std::max(lowest_on_the_way(r, i, 1), lowest_on_the_way(r, i, -1));
    if (at(i) - valley >= kNodeProminence * overhang) crests.push_back(i);
  }
  const auto valley_between = [&](int from, int to) {
    double lowest = at(from);
    for (int i = from; i <= to; ++i) lowest = std::min(lowest, at(i));
    return lowest;
  };
  std::vector<DrapeNode> nodes;
  for (std::size_t k = 0; k < crests.size(); ++k) {
    const int here = crests[k];
    const int next = k + 1 < crests.size() ? crests[k + 1] : crests[0] + count;
    const int last = k > 0 ? crests[k - 1] : crests.back() - count;
    const double valley = 0.5 * (valley_between(here, next) + valley_between(last, here));
    nodes.push_back({kTurn * here / count, at(here), 0.5 * (at(here) - valley)});
  }
  return nodes;
}

DrapeShadow cast_shadow(const DrapeGeometry& geometry, const ClothModel& model,
                        std::span<const Vec3> positions) {
  const PolarMesh mesh = make_polar_mesh(geometry, SmoothSurface(model, positions));
  double reach = 0.5 * geometry.specimen;
  for (const Vec3& x : mesh.points) reach = std::max(reach, x.head<2>().norm());
  Raster raster(reach, kShadowPixel);
  raster.fill_disc(0.5 * geometry.disc);
  for (int ring = 0; ring < mesh.rings; ++ring) {
    for (int d = 0; d < kShadowDirections; ++d) {
      raster.fill(mesh.at(ring, d), mesh.at(ring + 1, d), mesh.at(ring + 1, d + 1));
      raster.fill(mesh.at(ring, d), mesh.at(ring + 1, d + 1), mesh.at(ring, d + 1));
    }
  }
  DrapeShadow shadow;
  shadow.coefficient = geometry.coefficient(raster.area());
  shadow.side = raster.side();
  shadow.raster = raster.take();
  shadow.outline = outline_of(geometry, mesh);
  shadow.nodes = find_nodes(shadow.outline, geometry.overhang());
  double twice = 0.0;
  for (int d = 0; d < kShadowDirections; ++d) {
    const Vec3 &a = mesh.at(mesh.rings, d), &b = mesh.at(mesh.rings, d + 1);
    twice += a.x() * b.y() - a.y() * b.x();
    shadow.edge.push_back(a);
  }
  shadow.edge_coefficient = geometry.coefficient(0.5 * twice);
  return shadow;
}

}  // namespace fuai
