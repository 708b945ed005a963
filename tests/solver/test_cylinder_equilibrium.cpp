// The static solve of strips that bend as a cylinder: closed forms, the descent, and what its residual tells.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/cylinder_equilibrium.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "fuai/core/error.h"
#include "fuai/solver/cloth_energy.h"
#include "support/elastica_table.h"
#include "system/linear_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr double kLength = 0.2, kRigidity = 1e-5;  // [m], [N m]

/// A strip of this many segments and two across, two more in the clamp, along weft or warp.
ClothModel strip(int segments, Direction along, double areal_mass) {
  const double h = kLength / segments, held = 2.0 * h, length = kLength + held;
  const bool weft = along == Direction::kWeft;
  ClothPieceSpec spec;
  spec.outline = weft ? make_rectangle_outline(length, 2.0 * h) : make_rectangle_outline(2.0 * h, length);
  spec.spacing = h;
  spec.areal_mass = areal_mass;
  spec.clamps = {Clamp{HalfPlaneRegion{weft ? Vec2::UnitX() : Vec2::UnitY(), held}, true}};
  return make_cloth_model(spec);
}

/// Areal mass that gives the load lambda = w L^3 / B.
double mass_of(double load) { return load * kRigidity / (std::pow(kLength, 3) * kStandardGravity); }

ClothMaterial strip_material(double friction = 0.0, double tension = 1e4) {
  ClothMaterial material = linear_material({kRigidity, kRigidity, 0.0, 2.5e-6}, tension, 50.0);
  if (friction > 0.0) {
    material.weft_bending = material.warp_bending = straight_law(kRigidity, friction, 250.0);
  }
  return material;
}

/// Where the tip is against the clamp: along the strip, and down, over L.
Vec2 tip(const ClothModel& model, Direction along, const ClothState& state) {
  const bool weft = along == Direction::kWeft;
  const int slot = weft ? model.slot(model.columns - 1, 1) : model.slot(1, model.rows - 1);
  const Vec3& x = state.positions[static_cast<Index>(slot)];
  return {((weft ? x.x() : x.y()) - 2.0 * model.spacing) / kLength, -x.z() / kLength};
}

/// Force out of balance of all free slots in all directions, root of the sum of squares [N].
double out_of_balance(const ClothModel& model, const ClothMaterial& material, const ClothState& state) {
  const Vec3 gravity(0.0, 0.0, -kStandardGravity);
  std::vector<Vec3> forces(state.positions.size());
  evaluate_cloth(model, material, state, state.positions, {0.0, gravity}, forces);
  double square = 0.0;
  for (Index i = 0; i < forces.size(); ++i)
    if (model.live[i] != 0 && model.fixed[i] == 0)
      square += (forces[i] + model.areal_mass * model.node_area[i] * gravity).squaredNorm();
  return std::sqrt(square);
}

double free_weight(const ClothModel& model) {
  double weight = 0.0;
  for (Index i = 0; i < model.fixed.size(); ++i)
    if (model.fixed[i] == 0) weight += model.areal_mass * model.node_area[i] * kStandardGravity;
  return weight;
}

double droop_of(double friction, int load_steps) {
  const ClothModel model = strip(20, Direction::kWeft, mass_of(8.0));
  ClothState state = make_cloth_state(model);
  EquilibriumOptions options;
  options.load_steps = load_steps;
  const EquilibriumReport report =
      find_cylinder_equilibrium(model, strip_material(friction), Direction::kWeft, state, options);
  CHECK(report.converged);
  return tip(model, Direction::kWeft, state).y();
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("the heavy elastica within 0.1 % at 40 segments, along weft and warp") {
    for (const HeavyRow& exact : kHeavyRows) {
      CAPTURE(exact.load);
      if (exact.load > 64.0) continue;  // beyond the engine's demanded loads
      for (Direction along : {Direction::kWeft, Direction::kWarp}) {
        const ClothModel model = strip(40, along, mass_of(exact.load));
        ClothState state = make_cloth_state(model);
        EquilibriumOptions options;
        options.tolerance = 1e-6;
        // Threads that the strip's weight stretches by 5e-6 at most; much stiffer ones round to more than its
        // tolerance.
        const double tension = 2e5 * exact.load * kRigidity / (kLength * kLength);
        const EquilibriumReport report =
            find_cylinder_equilibrium(model, strip_material(0.0, tension), along, state, options);
        CHECK(report.converged);
        CHECK(report.residual <= 1e-6);
        const Vec2 off = tip(model, along, state) - Vec2(exact.reach, exact.droop);
        if (along == Direction::kWarp)
          MESSAGE("load ", exact.load, ": tip off by ", 100.0 * off.norm(), " % of the length, steps ",
                  report.steps, ", evaluations ", report.iterations);
        // The engine's bound on cantilevers; the clamp's order of 2 leaves less.
        CHECK(off.norm() < 1e-3);
      }
    }
  }

  TEST_CASE("small loads: droop w L^4 / (8 B), at second order in the spacing") {
    std::vector<double> errors;
    for (int segments : {10, 20, 40}) {
      const ClothModel model = strip(segments, Direction::kWarp, mass_of(0.01));
      ClothState state = make_cloth_state(model);
      EquilibriumOptions options;
      options.tolerance = 1e-8;
      // So light a strip needs softer threads, or rounding of their tension outweighs it; it stretches by
      // 1e-6.
      const ClothMaterial material = strip_material(0.0, 10.0);
      CHECK(find_cylinder_equilibrium(model, material, Direction::kWarp, state, options).converged);
      errors.push_back(tip(model, Direction::kWarp, state).y() / (0.01 / 8.0) - 1.0);
    }
    // The closed form is that of the limit of no load: at 0.01 it is 3e-6 off. What is left of the lattice's
    // error changes its sign on the way; a curve of order 2 lies above it.
    MESSAGE("errors ", errors[0], ", ", errors[1], ", ", errors[2]);
    for (std::size_t i = 0; i < errors.size(); ++i)
      CHECK(std::abs(errors[i]) < 1e-4 * std::pow(4.0, 2.0 - static_cast<double>(i)));
  }
}

TEST_SUITE("crosscheck") {
  TEST_CASE("Newton's method and the descent find the same strip") {
    const ClothModel model = strip(12, Direction::kWeft, mass_of(8.0));
    const ClothMaterial material = strip_material();
    ClothState newton = make_cloth_state(model), descent = newton;
    EquilibriumOptions options;
    options.tolerance = 1e-7;
    CHECK(find_cylinder_equilibrium(model, material, Direction::kWeft, newton, options).converged);
    options.iterations = 3000;
    options.reduction = 1e-3;
    CHECK(find_equilibrium(model, material, descent, options).converged);
    double apart = 0.0;
    for (Index i = 0; i < newton.positions.size(); ++i)
      apart = std::max(apart, (newton.positions[i] - descent.positions[i]).norm());
    MESSAGE("largest distance ", 1e6 * apart, " um");
    // 1e-7 of the weight at the tip bends it by 1e-7 lambda L / 3: 5e-8 m.
    CHECK(apart < 1e-6);
  }

  TEST_CASE("the residual is that of all slots, in all directions, over the weight") {
    const ClothModel model = strip(20, Direction::kWarp, mass_of(8.0));
    const ClothMaterial material = strip_material(1e-4);
    ClothState state = make_cloth_state(model);
    EquilibriumReport report = find_cylinder_equilibrium(model, material, Direction::kWarp, state);
    CHECK(report.converged);
    // The memory has moved to the shape, which does not change the force there.
    CHECK(out_of_balance(model, material, state) / free_weight(model) ==
          doctest::Approx(report.residual).epsilon(1e-6));
    for (const Vec3& v : state.velocities) CHECK(v == Vec3::Zero());
    // A slot pushed aside is no part of a cylinder: the profile cannot bring it back, and the report says so.
    state.positions[static_cast<Index>(model.slot(1, model.rows / 2))].x() += 1e-4;
    report = find_cylinder_equilibrium(model, material, Direction::kWarp, state);
    CHECK_FALSE(report.converged);
    CHECK(report.residual > 1e-2);
    CHECK(out_of_balance(model, material, state) / free_weight(model) ==
          doctest::Approx(report.residual).epsilon(1e-6));
  }
}

TEST_SUITE("property") {
  TEST_CASE("friction holds the strip up, and its path is the loading") {
    const double elastic = droop_of(0.0, 1), rough = droop_of(2e-4, 10), rougher = droop_of(4e-4, 10);
    MESSAGE("droop over length ", elastic, " without friction, ", rough, ", ", rougher, " with");
    CHECK(rough < 0.99 * elastic);
    CHECK(rougher < 0.99 * rough);
    // Without friction the path makes no difference: both are solved to 1e-4 of the weight.
    CHECK(droop_of(0.0, 7) == doctest::Approx(elastic).epsilon(1e-3));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("without gravity a flat strip is at rest at once") {
    const ClothModel model = strip(10, Direction::kWeft, 0.15);
    ClothState state = make_cloth_state(model);
    EquilibriumOptions options;
    options.gravity = Vec3::Zero();
    double seen = 0.0;
    const EquilibriumReport report =
        find_cylinder_equilibrium(model, strip_material(), Direction::kWeft, state, options,
                                  [&](std::string_view, double share) { seen = share; });
    CHECK(report.converged);
    CHECK(report.steps == 0);
    CHECK(seen == 1.0);
    CHECK(tip(model, Direction::kWeft, state).y() == 0.0);
  }

  TEST_CASE("options that make no sense are refused") {
    const ClothModel model = strip(10, Direction::kWeft, 0.15);
    const ClothMaterial material = strip_material();
    ClothState state = make_cloth_state(model);
    const auto refused = [&](Direction along, auto change) {
      EquilibriumOptions options;
      change(options);
      CHECK_THROWS_AS(find_cylinder_equilibrium(model, material, along, state, options), Error);
    };
    refused(Direction::kBias, [](EquilibriumOptions&) {});
    refused(Direction::kWeft, [](EquilibriumOptions& o) { o.tolerance = 0.0; });
    refused(Direction::kWeft, [](EquilibriumOptions& o) { o.most_steps = 0; });
    refused(Direction::kWeft, [](EquilibriumOptions& o) { o.load_steps = 0; });
    refused(Direction::kWeft, [](EquilibriumOptions& o) { o.first_dt = -1.0; });
    refused(Direction::kWeft,
            [](EquilibriumOptions& o) { o.largest_move = std::numeric_limits<double>::quiet_NaN(); });
  }
}
