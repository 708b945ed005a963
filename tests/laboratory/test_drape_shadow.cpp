// Shadows of shapes whose drape coefficient and nodes are known.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "fuai/laboratory/drape_shadow.h"

using namespace fuai;

namespace {

constexpr double kPi = std::numbers::pi;

/// The specimen laid out by a map of its material coordinates.
template <class Map>
DrapeShadow shadow_of(const DrapeGeometry& geometry, const Map& map) {
  const ClothModel model = make_drape_model(geometry, 0.1, 3, {true, 0.0, 0.0});
  ClothState state = make_cloth_state(model);
  for (int slot = 0; slot < model.slot_count(); ++slot) {
    state.positions[static_cast<std::size_t>(slot)] =
        map(model.material(slot % model.columns, slot / model.columns));
  }
  return cast_shadow(geometry, model, state.positions);
}

/// Beyond the disc the radius grows by `share(azimuth)` of what it does flat.
template <class Share>
auto folded(const DrapeGeometry& geometry, const Share& share) {
  return [=](const Vec2& m) {
    const double r = m.norm(), disc = 0.5 * geometry.disc;
    if (r <= disc) return Vec3(m.x(), m.y(), 0.0);
    const double to = disc + (r - disc) * share(std::atan2(m.y(), m.x()));
    return Vec3(m.x() * to / r, m.y() * to / r, -0.5 * (r - disc));
  };
}

std::vector<double> wavy(int waves, double amplitude, double turn = 0.0) {
  std::vector<double> outline;
  for (int i = 0; i < kShadowDirections; ++i)
    outline.push_back(0.1 + amplitude * std::cos(waves * (2.0 * kPi * i / kShadowDirections - turn)));
  return outline;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a flat specimen has a drape coefficient of 100 within 0.1 and no nodes") {
    for (DrapeGeometry geometry : {kCusickGeometry, kJisGeometry, DrapeGeometry{0.05, 0.11, 0.004}}) {
      const DrapeShadow shadow = shadow_of(geometry, [](const Vec2& m) { return Vec3(m.x(), m.y(), 0.2); });
      CHECK(std::abs(shadow.coefficient - 1.0) < 0.001);
      CHECK(std::abs(shadow.edge_coefficient - 1.0) < 1e-4);  // a polygon of 720 sides: 1.3e-5 of its area
      CHECK(shadow.nodes.empty());
      CHECK(shadow.mean_amplitude() == 0.0);
    }
  }

  TEST_CASE("a shrunken specimen has the coefficient of its circle, the disc counted, within 0.1") {
    for (double share : {0.8, 0.3, 0.1}) {
      const DrapeGeometry g = kJisGeometry;
      const DrapeShadow shadow = shadow_of(g, folded(g, [=](double) { return share; }));
      const double edge = 0.5 * g.disc + share * g.overhang();
      CHECK(std::abs(shadow.coefficient - g.coefficient(kPi * edge * edge)) < 0.001);
    }
  }

  TEST_CASE("folds of known number, size and place come back") {
    for (int waves : {4, 5, 7, 10}) {
      const DrapeGeometry g = kCusickGeometry;
      const double mean = 0.6, swing = 0.25, turn = 0.3;
      const DrapeShadow shadow =
          shadow_of(g, folded(g, [=](double a) { return mean + swing * std::cos(waves * (a - turn)); }));
      // Half the integral of r^2 over the turn, r = R + L (mean + swing cos).
      const double R = 0.5 * g.disc + mean * g.overhang(), L = swing * g.overhang();
      CHECK(std::abs(shadow.coefficient - g.coefficient(kPi * (R * R + 0.5 * L * L))) < 0.001);
      CHECK(std::abs(shadow.coefficient - shadow.edge_coefficient) < 0.001);
      REQUIRE(shadow.nodes.size() == static_cast<std::size_t>(waves));
      // The smoothing over +-3 degrees takes sin(n 3 deg) / (n 3 deg) of the swing.
      const double smoothing = waves * kNodeSmoothing, left = std::sin(smoothing) / smoothing;
      for (std::size_t i = 0; i < shadow.nodes.size(); ++i) {
        const DrapeNode& node = shadow.nodes[i];
        CHECK(std::abs(node.amplitude - L * left) < 2e-4);  // the lattice of 5 mm against the map
        CHECK(std::abs(std::remainder(node.azimuth - turn, 2.0 * kPi / waves)) <
              1.5 * 2.0 * kPi / kShadowDirections);
        if (i > 0) CHECK(node.azimuth > shadow.nodes[i - 1].azimuth);
      }
    }
  }

  TEST_CASE("where the edge turns in under the cloth, the shadow is that of the bulge") {
    const DrapeGeometry g = kJisGeometry;
    // Out to half the overhang, then back to a quarter of it.
    const DrapeShadow shadow = shadow_of(g, [&](const Vec2& m) {
      const double r = m.norm(), disc = 0.5 * g.disc;
      if (r <= disc) return Vec3(m.x(), m.y(), 0.0);
      const double s = (r - disc) / g.overhang(), to = disc + g.overhang() * s * (2.0 - 1.75 * s);
      return Vec3(m.x() * to / r, m.y() * to / r, -0.5 * s * g.overhang());
    });
    const double bulge = 0.5 * g.disc + g.overhang() / 1.75;  // the largest of s (2 - 1.75 s)
    const double edge = 0.5 * g.disc + 0.25 * g.overhang();
    CHECK(std::abs(shadow.coefficient - g.coefficient(kPi * bulge * bulge)) < 0.001);
    CHECK(std::abs(shadow.edge_coefficient - g.coefficient(kPi * edge * edge)) < 0.001);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("a crest counts from a twentieth of the overhang, wherever it stands") {
    const double overhang = 0.06, threshold = kNodeProminence * overhang;
    for (int waves : {3, 5, 8}) {
      const double left = std::sin(waves * kNodeSmoothing) / (waves * kNodeSmoothing);
      // Crest to valley is twice the amplitude; 1 % either side of the threshold. The sum over the 13
      // directions of the window differs from the integral by 0.6 % at 8 waves at most.
      const double amplitude = 0.5 * threshold / left;
      for (double turn : {0.0, 0.01, 1.0}) {
        CHECK(find_nodes(wavy(waves, 1.02 * amplitude, turn), overhang).size() ==
              static_cast<std::size_t>(waves));
        CHECK(find_nodes(wavy(waves, 0.97 * amplitude, turn), overhang).empty());
      }
    }
  }

  TEST_CASE("a small bump on a large fold is no node of its own") {
    std::vector<double> outline = wavy(4, 0.015);
    for (std::size_t i = 0; i < outline.size(); ++i)
      outline[i] += 0.001 * std::cos(40.0 * 2.0 * kPi * static_cast<double>(i) / kShadowDirections);
    CHECK(find_nodes(outline, 0.06).size() == 4);
  }

  TEST_CASE("one crest alone is one node, a circle has none") {
    CHECK(find_nodes(wavy(1, 0.01), 0.06).size() == 1);
    CHECK(find_nodes(std::vector<double>(kShadowDirections, 0.1), 0.06).empty());
  }
}
