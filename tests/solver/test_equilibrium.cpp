// The static solve: that it rests, where, and that nesting finds the same folds.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/equilibrium.h"

#include <doctest/doctest.h>

#include <cmath>

#include "fuai/cloth/cloth_piece.h"
#include "fuai/core/error.h"
#include "fuai/solver/cloth_energy.h"
#include "support/small_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

/// The paper's drape: 17 cm, a 4 cm block held. Stiff enough to have one branch (the drape of softer cloth
/// depends on the path).
ClothModel corner_drape(double spacing) {
  ClothPieceSpec spec;
  spec.outline = make_rectangle_outline(0.17, 0.17);
  spec.spacing = spacing;
  spec.areal_mass = 0.15;
  spec.clamps = {Clamp{make_rectangle_region({-0.01, -0.01}, {0.04, 0.04})}};
  return make_cloth_model(spec);
}

ClothMaterial drape_material() {
  ClothMaterial material;
  material.weft_bending = material.warp_bending = straight_law(2e-5, 0.0, 250.0);
  material.twist_stiffness = 5e-6;
  material.shear = straight_law(56.0, 0.0, 0.14);
  material.weft_tension = material.warp_tension = straight_law(980.0, 0.0, 0.05);
  return material;
}

/// Out-of-balance force of the reference energies at a state, over the weight.
double reference_residual(const ClothModel& model, const ClothMaterial& material, const ClothState& state) {
  const Vec3 gravity(0.0, 0.0, -kStandardGravity);
  std::vector<Vec3> forces(state.positions.size());
  evaluate_cloth(model, material, state, state.positions, {0.0, gravity}, forces);
  double square = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (model.live[i] == 0 || model.fixed[i] != 0) continue;
    const double mass = model.areal_mass * model.node_area[i];
    square += (forces[i] + mass * gravity).squaredNorm();
    weight += mass * kStandardGravity;
  }
  return std::sqrt(square) / weight;
}

}  // namespace

TEST_SUITE("crosscheck") {
  TEST_CASE("the corner drape rests, also by the reference energies") {
    const ClothModel model = corner_drape(0.01);
    const ClothMaterial material = drape_material();
    ClothState state = make_cloth_state(model);
    const EquilibriumReport report = find_equilibrium(model, material, state);
    MESSAGE("steps " << report.steps << ", iterations " << report.iterations << ", residual "
                     << report.residual);
    CHECK(report.converged);
    CHECK(report.residual <= 1e-4);
    // The tables of straight laws are exact: only rounding lies between the two.
    CHECK(reference_residual(model, material, state) == doctest::Approx(report.residual).epsilon(1e-3));
    for (const Vec3& v : state.velocities) CHECK(v.norm() == 0.0);
  }
  TEST_CASE("the fallback preconditioner finds the same shape") {
    const ClothModel model = corner_drape(0.01);
    const ClothMaterial material = drape_material();
    ClothState lines = make_cloth_state(model);
    EquilibriumOptions options;
    options.tolerance = 1e-6;
    CHECK(find_equilibrium(model, material, lines, options).converged);
    // From flat it would find other folds; pushed a little off, it must come back to these.
    ClothState blocks = lines;
    options.preconditioner = Preconditioner::kBlocks;
    options.perturbation = 5e-4;
    CHECK(find_equilibrium(model, material, blocks, options).converged);
    // A residual of 1e-6 of the weight moves the corner of this cloth by well under 0.1 mm.
    CHECK((lines.positions.back() - blocks.positions.back()).norm() < 1e-4);
  }
}

TEST_SUITE("crosscheck+slow") {
  TEST_CASE("from coarse to fine, 69 x 69 lands on the branch of 35 x 35") {
    const ClothModel levels[] = {corner_drape(0.01), corner_drape(0.005), corner_drape(0.0025)};
    const ClothMaterial material = drape_material();
    ClothState middle = make_cloth_state(levels[1]), fine = make_cloth_state(levels[2]);
    CHECK(find_equilibrium_nested({levels, 2}, material, middle).converged);
    const EquilibriumReport report = find_equilibrium_nested(levels, material, fine);
    CHECK(report.converged);
    const Vec3 a = middle.positions.back(), b = fine.positions.back();
    MESSAGE("corner at 5 mm " << a.transpose() << ", at 2.5 mm " << b.transpose() << ", iterations "
                              << report.iterations);
    // Branches of this drape lie some 20 to 70 mm apart (docs/theory/equilibrium.md); one branch moves by its
    // mesh error, measured 4 mm.
    CHECK((a - b).norm() < 0.01);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("seeds: the same seed gives the same bits, another one another start") {
    const ClothModel model = corner_drape(0.01);
    EquilibriumOptions options;
    options.perturbation = 1e-4;
    options.most_steps = 3;
    Vec3 corner[3];
    const std::uint64_t seeds[3] = {5, 5, 6};
    for (int i = 0; i < 3; ++i) {
      ClothState state = make_cloth_state(model);
      options.seed = seeds[i];
      CHECK_FALSE(find_equilibrium(model, drape_material(), state, options).converged);
      corner[i] = state.positions.back();
    }
    CHECK(corner[0] == corner[1]);
    CHECK(corner[0] != corner[2]);
  }
  TEST_CASE("options that make no sense are refused") {
    const ClothModel model = corner_drape(0.01);
    ClothState state = make_cloth_state(model);
    EquilibriumOptions options;
    options.load_steps = 0;
    CHECK_THROWS_AS(find_equilibrium(model, drape_material(), state, options), Error);
    CHECK_THROWS_AS(find_equilibrium_nested({}, drape_material(), state), Error);
  }
}
