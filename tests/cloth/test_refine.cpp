// A shape carried over to a finer lattice.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/refine.h"

#include <doctest/doctest.h>

#include <cmath>

#include "fuai/cloth/cloth_piece.h"
#include "fuai/core/error.h"

using namespace fuai;

namespace {

ClothModel disc(double spacing) {
  ClothPieceSpec spec;
  spec.outline = make_disc_outline(0.2);
  spec.spacing = spacing;
  spec.lattice_shift = Vec2(0.3, 0.6);
  return make_cloth_model(spec);
}

/// The sheet rolled on a cylinder of radius 6 cm, or laid out by an affine map.
Vec3 rolled(const Vec2& m) { return {0.06 * std::sin(m.x() / 0.06), m.y(), 0.06 * std::cos(m.x() / 0.06)}; }
Vec3 affine(const Vec2& m) { return {1.1 * m.x() + 0.2 * m.y(), 0.9 * m.y(), 0.3 * m.x() - 0.1}; }

/// Root mean square distance of the refined shape from the map.
template <class Map>
double error(double coarse_spacing, double fine_spacing, const Map& map) {
  const ClothModel coarse = disc(coarse_spacing), fine = disc(fine_spacing);
  ClothState state = make_cloth_state(coarse);
  for (int slot = 0; slot < coarse.slot_count(); ++slot)
    state.positions[static_cast<std::size_t>(slot)] =
        map(coarse.material(slot % coarse.columns, slot / coarse.columns));
  const ClothState refined = refine_state(coarse, state, fine);
  double square = 0.0;
  int count = 0;
  for (int slot = 0; slot < fine.slot_count(); ++slot) {
    const auto i = static_cast<std::size_t>(slot);
    if (fine.live[i] == 0) continue;
    const Vec3 exact = map(fine.material(slot % fine.columns, slot / fine.columns));
    square += (refined.positions[i] - exact).squaredNorm();
    ++count;
  }
  return std::sqrt(square / count);
}

}  // namespace

TEST_SUITE("convergence") {
  TEST_CASE("an affine shape stays what it is, beyond the outermost slots too") {
    // Rounding of coordinates of a decimetre.
    CHECK(error(0.02, 0.007, affine) < 1e-15);
  }
  TEST_CASE("a bent shape is met with order 2 at the border and better inside") {
    const double coarse = error(0.02, 0.002, rolled), fine = error(0.01, 0.002, rolled);
    MESSAGE("error from 20 mm " << coarse << " m, from 10 mm " << fine << " m");
    // The straight continuation beyond the border leaves out h^2 / R = 6.7 mm at most, in one slot in fifty.
    CHECK(coarse < 6.7e-3 / 50.0);
    CHECK(std::log2(coarse / fine) > 1.8);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("the memory comes from the nearest slot, and a foreign state is refused") {
    const ClothModel coarse = disc(0.02), fine = disc(0.01);
    ClothState state = make_cloth_state(coarse);
    for (std::size_t i = 0; i < state.shear.size(); ++i)
      state.shear[i].position[0] = static_cast<double>(i + 1);
    const ClothState refined = refine_state(coarse, state, fine);
    // The slot of the fine lattice next to slot (5, 5) of the coarse one: within 0.71 of its own spacing.
    const Vec2 place = (coarse.material(5, 5) - fine.origin) / fine.spacing;
    const int nearest =
        fine.slot(static_cast<int>(std::lround(place.x())), static_cast<int>(std::lround(place.y())));
    CHECK(refined.shear[static_cast<std::size_t>(nearest)].position[0] == coarse.slot(5, 5) + 1);
    CHECK_THROWS_AS(refine_state(coarse, make_cloth_state(fine), fine), Error);
  }
}
