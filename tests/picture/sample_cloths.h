// Cloths in closed form for the picture tests: flat, bent to a cylinder, a saddle, over a table corner, on a
// disc.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "fuai/cloth/surface_mesh.h"

namespace fuai::test {

/// A square cloth of cells * cells cells; `shape` maps (weft, warp) coordinates, both in [0, side], to a
/// place.
inline SurfaceMesh make_sample(double side, int cells, const std::function<Vec3(double, double)>& shape) {
  const double spacing = side / cells;
  std::vector<Vec3> positions;
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column)
      positions.push_back(shape(column * spacing, row * spacing));
  }
  return make_lattice_mesh(cells + 1, cells + 1, spacing, positions);
}

/// Flat, its middle at the origin.
inline SurfaceMesh make_flat(double side, int cells, double z = 0.0) {
  return make_sample(side, cells,
                     [=](double x, double y) { return Vec3(x - 0.5 * side, y - 0.5 * side, z); });
}

/// Bent to a half cylinder about the warp, standing on its two edges.
inline SurfaceMesh make_arch(double side, int cells) {
  const double radius = side / std::numbers::pi;
  return make_sample(side, cells, [=](double x, double y) {
    const double angle = x / radius;
    return Vec3(-radius * std::cos(angle), y - 0.5 * side, radius * std::sin(angle));
  });
}

/// A saddle with ripples that grow towards one edge; z from about 0 to 0.25 side.
inline SurfaceMesh make_rippled_saddle(double side, int cells) {
  return make_sample(side, cells, [=](double x, double y) {
    const double a = x / side - 0.5, b = y / side - 0.5;
    const double ripple = 0.035 * (a + 0.5) * std::sin(5.0 * 2.0 * std::numbers::pi * b);
    return Vec3(side * a, side * b, side * (0.11 + 0.5 * (a * a - b * b) * 0.8 + ripple));
  });
}

/// Over the corner of a block whose top is z = 0 and whose corner is the origin (block at x < 0, y < 0).
/// Beyond the edges it hangs; at the corner it flares out in a cone, lengths along the radius kept.
inline SurfaceMesh make_over_corner(double side, double overhang, int cells) {
  return make_sample(side, cells, [=](double x, double y) {
    const double a = x - (side - overhang), b = y - (side - overhang), gap = 0.002;
    const auto hang = [&](double s) {
      return s < 0.01 ? Vec2(s, -s * s * 25.0) : Vec2(0.01, -0.0025 - (s - 0.01));
    };
    if (a <= 0.0 && b <= 0.0) return Vec3(a, b, gap);
    if (b <= 0.0) return Vec3(hang(a).x() + gap, b, gap + hang(a).y());
    if (a <= 0.0) return Vec3(a, hang(b).x() + gap, gap + hang(b).y());
    const double radius = std::hypot(a, b), angle = std::atan2(b, a);
    const double flare = 0.55 * std::pow(std::sin(2.0 * angle), 2);
    const double out = std::min(radius, 0.01) + flare * radius,
                 down = std::sqrt(1.0 - flare * flare) * radius;
    return Vec3(out * std::cos(angle) + gap, out * std::sin(angle) + gap,
                gap - down * radius / (radius + 0.004));
  });
}

/// A disc of cloth on a round table whose top is z = 0, hanging in `folds` folds; the lattice is square, so
/// its corners hang lowest.
inline SurfaceMesh make_on_disc(double side, double disc_radius, int folds, int cells) {
  return make_sample(side, cells, [=](double x, double y) {
    const double a = x - 0.5 * side, b = y - 0.5 * side, radius = std::hypot(a, b), angle = std::atan2(b, a);
    if (radius <= disc_radius) return Vec3(a, b, 0.001);
    const double s = radius - disc_radius, wave = std::cos(folds * angle);
    const double out = s * (0.30 + 0.28 * wave) + 0.006 * (1.0 - std::exp(-s / 0.01));
    const double r = disc_radius + out;
    return Vec3(r * std::cos(angle), r * std::sin(angle), 0.001 - s * (0.92 - 0.12 * wave));
  });
}

}  // namespace fuai::test
