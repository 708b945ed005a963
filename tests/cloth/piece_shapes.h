// Outlines and measures shared by the tests of cloth pieces.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/cloth/outline.h"

namespace fuai::test {

/// A sleeve: hem 22 cm wide and bowed, seams hollow by 1 cm, bell-shaped cap 14 cm high on 36 cm;
/// counter-clockwise.
inline Polygon sleeve_outline(int samples = 200) {
  const double pi = std::numbers::pi, hem = 0.11, biceps = 0.18, length = 0.4, cap = 0.14;
  Polygon outline;
  const auto curve = [&](auto&& point) {
    for (int i = 0; i < samples; ++i) outline.push_back(point(static_cast<double>(i) / samples));
  };
  const auto seam = [&](double t) { return hem + (biceps - hem) * t - 0.01 * std::sin(pi * t); };
  curve([&](double t) { return Vec2(hem * (2.0 * t - 1.0), -0.01 * std::sin(pi * t)); });
  curve([&](double t) { return Vec2(seam(t), length * t); });
  curve([&](double t) {
    const double x = biceps * (1.0 - 2.0 * t);
    return Vec2(x, length + cap * std::pow(std::cos(0.5 * pi * x / biceps), 2));
  });
  curve([&](double t) { return Vec2(-seam(1.0 - t), length * (1.0 - t)); });
  return outline;
}

/// A value within a relative tolerance; doctest's own is absolute below 1.
inline doctest::Approx relative(double value, double tolerance) {
  return doctest::Approx(value).epsilon(tolerance).scale(0.0);
}

inline double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Sum of the sides of a closed polyline [m].
inline double closed_length(std::span<const Vec3> points) {
  double length = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    length += (points[(i + 1) % points.size()] - points[i]).norm();
  return length;
}

/// Centre of mass by node areas [m].
inline Vec2 centre_of_nodes(const ClothModel& model) {
  Vec2 moment = Vec2::Zero();
  for (int slot = 0; slot < model.slot_count(); ++slot) {
    moment += model.node_area[static_cast<std::size_t>(slot)] *
              model.material(slot % model.columns, slot / model.columns);
  }
  return moment / sum(model.node_area);
}

}  // namespace fuai::test
