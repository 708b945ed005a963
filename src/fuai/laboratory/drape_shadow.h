// The shadow of a drape: its area, its outline, its nodes.
// SPDX-License-Identifier: Apache-2.0
// Source: BS 5058, JIS L 1096 (drape coefficient); docs/theory/drape.md.
//
//   DC = (shadow - disc) / (specimen - disc)      areas; the shadow counts the disc
//   the cloth's surface is taken between the slots as the smooth surface through them, its edge is the circle
#pragma once

#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "fuai/scenes/drape_specimen.h"

namespace fuai {

/// One fold seen from above.
struct DrapeNode {
  double azimuth = 0.0;    ///< of its crest, from the weft toward the warp [rad], 0 .. 2 pi
  double radius = 0.0;     ///< of its crest in the smoothed outline [m]
  double amplitude = 0.0;  ///< half the way from the mean of the two valleys beside it to the crest [m]
};

/// What the tester's paper ring shows.
struct DrapeShadow {
  double coefficient = 0.0;       ///< DC [-]
  double edge_coefficient = 0.0;  ///< DC from the signed area within the projected edge; the same where the
                                  ///< edge does not overhang itself [-]
  std::vector<double> outline;    ///< farthest cloth by azimuth, kShadowDirections equal steps from 0 [m]
  std::vector<DrapeNode> nodes;   ///< by azimuth
  std::vector<Vec3> edge;         ///< the cloth's edge, by material angle, kShadowDirections points [m]
  int side = 0;                   ///< pixels of the raster on a side; its middle is the disc's
  std::vector<std::uint8_t> raster;  ///< 1: in the shadow (side * side), rows from the largest y

  /// Mean over the nodes [m], 0 without nodes.
  double mean_amplitude() const noexcept;
};

/// Steps around the specimen.
inline constexpr int kShadowDirections = 720;
/// Side of a pixel of the raster [m].
inline constexpr double kShadowPixel = 0.0005;
/// The outline is smoothed over this angle to either side before nodes are counted [rad].
inline constexpr double kNodeSmoothing = std::numbers::pi / 60.0;
/// A node stands out by at least this part of the overhang.
inline constexpr double kNodeProminence = 0.05;

/// Casts it. @param positions [m] (slots); z is up. Thread class: set-up.
DrapeShadow cast_shadow(const DrapeGeometry& geometry, const ClothModel& model,
                        std::span<const Vec3> positions);

/// DC from the signed area within the border as it lies now: cheap, to watch a drape come to rest.
/// Thread class: any.
template <class Positions>
double border_coefficient(const DrapeGeometry& geometry, const ClothModel& model, const Positions& position);

/// Counts the nodes of an outline, equal steps of azimuth [m]. Thread class: set-up.
std::vector<DrapeNode> find_nodes(std::span<const double> outline, double overhang);

template <class Positions>
double border_coefficient(const DrapeGeometry& geometry, const ClothModel& model, const Positions& position) {
  const auto place = [&](const MaterialPoint& point) {
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < point.slots.size(); ++i)
      if (point.weights[i] != 0.0) sum += point.weights[i] * position(point.slots[i]).template head<2>();
    return sum;
  };
  double twice = 0.0;
  Vec2 last = place(model.border.back());
  for (const MaterialPoint& point : model.border) {
    const Vec2 here = place(point);
    twice += last.x() * here.y() - last.y() * here.x();
    last = here;
  }
  return geometry.coefficient(0.5 * twice);
}

}  // namespace fuai
