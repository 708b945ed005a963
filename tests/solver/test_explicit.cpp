// The explicit solver against closed forms, its energy, its stability bound, and itself.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/explicit.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fuai/core/error.h"
#include "fuai/solver/cloth_energy.h"
#include "support/allocation_guard.h"
#include "support/small_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr double kH = 0.01, kMass = 0.15;

/// Straight laws without friction, viscosity, drag and air: everything is conserved.
ClothMaterial conserving_material() {
  ClothMaterial material;
  material.weft_tension = material.warp_tension = straight_law(200.0, 0.0, 0.1);
  material.shear = straight_law(20.0, 0.0, 0.1);
  material.weft_bending = material.warp_bending = straight_law(1e-5, 0.0, 200.0);
  material.twist_stiffness = 2e-6;
  material.viscosity_time = material.mass_drag = material.air_density = 0.0;
  return material;
}

double whole_energy(const ClothModel& model, const ClothMaterial& material, const ClothState& state) {
  const Vec3 gravity(0.0, 0.0, -kStandardGravity);
  return cloth_kinetic_energy(model, state) + cloth_free_energy(model, material, state, gravity).total();
}

/// 6 x 5 slots, held at two corners.
ClothModel hung_sheet() {
  ClothModel model = sheet_model(6, 5, kH, kMass);
  for (Index slot : {0, 5}) model.fixed[slot] = 1;
  return model;
}

/// Largest distance of the energy from its start over a fall of 0.1 s, over the largest kinetic energy.
double energy_swing(int substeps) {
  const ClothModel model = hung_sheet();
  const ClothMaterial material = conserving_material();
  ClothState state = flat_state(model);
  SolverExplicit solver;
  ExplicitOptions options;
  options.substeps = substeps;
  solver.prepare(model, material, options);
  const double start = whole_energy(model, material, state);
  double swing = 0.0, kinetic = 0.0;
  for (int i = 0; i < 100; ++i) {
    CHECK(solver.step(state, 1e-3) == 0);
    swing = std::max(swing, std::abs(whole_energy(model, material, state) - start));
    kinetic = std::max(kinetic, cloth_kinetic_energy(model, state));
  }
  return swing / kinetic;
}

/// Largest speed after 300 substeps of this length from a small random disturbance of the flat sheet [m/s].
double speed_after(double substep) {
  const ClothModel model = hung_sheet();
  ClothMaterial material = conserving_material();
  material.viscosity_time = 5e-5;
  ClothState state = flat_state(model);
  std::mt19937 random(3);
  jitter(state.velocities, 1e-6, random);
  SolverExplicit solver;
  solver.prepare(model, material, {1, Vec3::Zero(), Vec3::Zero()});
  for (int i = 0; i < 300; ++i) solver.step(state, substep);
  double speed = 0.0;
  for (const Vec3& v : state.velocities) speed = std::max(speed, v.norm());
  return speed;
}

/// Fine enough for the steepest tension of the uneven material, friction sticking.
constexpr int kFineSubsteps = 400;
ExplicitOptions fine_options() {
  ExplicitOptions options;
  options.substeps = kFineSubsteps;
  return options;
}

/// Twenty steps with every term, held and pulled at two corners.
ClothState pulled_run(const ClothModel& model, const ClothMaterial& material) {
  ClothState state = flat_state(model);
  SolverExplicit solver;
  solver.prepare(model, material, fine_options());
  std::vector<Vec3> held{state.positions[0], state.positions[5]};
  for (int i = 0; i < 20; ++i) {
    held[1].x() += 1e-5;
    solver.step(state, 1e-3, held);
  }
  return state;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a hanging strip stretches under its own weight, and its clamp carries it") {
    ClothModel model = sheet_model(3, 21, kH, kMass);
    for (Index slot : {60, 61, 62}) model.fixed[slot] = 1;
    ClothMaterial material = conserving_material();
    material.mass_drag = 200.0;  // the slowest swing has w = (pi / 2L) sqrt(k / rho) = 290 1/s: near critical
    ClothState state = flat_state(model);
    SolverExplicit solver;
    const Vec3 gravity(0.0, -kStandardGravity, 0.0);
    solver.prepare(model, material, {20, gravity, Vec3::Zero()});
    for (int i = 0; i < 300; ++i) REQUIRE(solver.step(state, 1e-3) == 0);
    // rho g L^2 / (2 k); lattice weights sum the linear tension exactly, the rest of the motion is e^-30.
    const double length = 0.2, k = 200.0;
    const double elongation = kMass * kStandardGravity * length * length / (2.0 * k);
    const double measured = -state.positions[1].y();
    MESSAGE("elongation over analytic: " << measured / elongation);
    CHECK(measured / elongation == doctest::Approx(1.0).epsilon(1e-6));
    double free_mass = 0.0;
    for (Index slot = 0; slot < 60; ++slot) free_mass += kMass * model.node_area[slot];
    CHECK(solver.reaction().y() / (-free_mass * kStandardGravity) == doctest::Approx(1.0).epsilon(1e-6));
    CHECK(solver.reaction().x() == doctest::Approx(0.0).epsilon(1e-9));
  }

  TEST_CASE("cloth falls flat to its terminal speed, and slides edgewise with skin friction only") {
    const ClothModel model = sheet_model(4, 4, kH, kMass);
    ClothMaterial material = conserving_material();
    material.air_density = 1.2;
    for (bool edgewise : {false, true}) {
      ClothState state = flat_state(model);
      SolverExplicit solver;
      const Vec3 gravity = edgewise ? Vec3(kStandardGravity, 0.0, 0.0) : Vec3(0.0, 0.0, kStandardGravity);
      solver.prepare(model, material, {100, gravity, Vec3::Zero()});
      for (int i = 0; i < 300; ++i) REQUIRE(solver.step(state, 1e-3) == 0);
      const double C = edgewise ? material.air_tangential : material.air_normal;
      const double terminal = std::sqrt(2.0 * kMass * kStandardGravity / (material.air_density * C));
      const double speed = terminal * std::tanh(kStandardGravity * 0.3 / terminal);
      // Euler is first order: ds g / terminal = 7e-5 of the speed at most.
      CHECK(state.velocities[5].norm() / speed == doctest::Approx(1.0).epsilon(1e-4));
    }
  }

  TEST_CASE("wind blows, and drag proportional to mass slows a fall") {
    const ClothModel model = sheet_model(4, 4, kH, kMass);
    ClothMaterial material = conserving_material();
    material.air_density = 1.2;
    ClothState state = flat_state(model);
    SolverExplicit solver;
    const Vec3 wind(0.0, 0.0, 2.0);
    solver.prepare(model, material, {100, Vec3::Zero(), wind});
    for (int i = 0; i < 100; ++i) solver.step(state, 1e-3);
    // v' = (b/2) (w - v)^2 with b = rho_air C / rho: w - v = w / (1 + b w t / 2)
    const double b = 1.2 * material.air_normal / kMass;
    const double expected = 2.0 - 2.0 / (1.0 + 0.5 * b * 2.0 * 0.1);
    CHECK(state.velocities[5].z() / expected == doctest::Approx(1.0).epsilon(1e-3));  // first order, b w ds

    material.air_density = 0.0;
    material.mass_drag = 5.0;
    state = flat_state(model);
    solver.prepare(model, material);
    for (int i = 0; i < 100; ++i) solver.step(state, 1e-3);
    const double fall = kStandardGravity / 5.0 * (1.0 - std::exp(-0.5));
    CHECK(-state.velocities[5].z() / fall == doctest::Approx(1.0).epsilon(1e-4));  // first order, c ds
  }
}

TEST_SUITE("convergence") {
  TEST_CASE("without losses the energy does not drift, and its swing is first order in the substep") {
    const double coarse = energy_swing(20), fine = energy_swing(80);
    MESSAGE("energy swing over kinetic energy: 20 substeps " << coarse << ", 80 substeps " << fine);
    CHECK(fine < 0.01);
    CHECK(coarse / fine > 2.5);  // 4 for a first-order swing; sampled at whole steps only
  }
}

TEST_SUITE("property") {
  TEST_CASE("with friction, viscosity and drag the energy falls") {
    const ClothModel model = hung_sheet();
    const ClothMaterial material = uneven_material();
    ClothState state = flat_state(model);
    SolverExplicit solver;
    solver.prepare(model, material, fine_options());
    const double start = whole_energy(model, material, state);
    double last = start;
    double kinetic = 0.0, worst_rise = 0.0;
    for (int i = 0; i < 200; ++i) {
      REQUIRE(solver.step(state, 1e-3) == 0);
      const double now = whole_energy(model, material, state);
      worst_rise = std::max(worst_rise, now - last);
      last = now;
      kinetic = std::max(kinetic, cloth_kinetic_energy(model, state));
    }
    MESSAGE("over the largest kinetic energy: largest rise "
            << worst_rise / kinetic << ", loss " << (start - last) / kinetic << "; stable substep "
            << solver.stable_substep());
    CHECK(worst_rise < 1e-4 * kinetic);  // the swing of the scheme in the conserving case, at 80 substeps
    CHECK(start - last > 0.1 * kinetic);
  }

  TEST_CASE("the stability bound holds, and is not idle") {
    const ClothModel model = hung_sheet();
    ClothMaterial material = conserving_material();
    material.viscosity_time = 5e-5;
    const double bound = stable_substep(model, material);
    double edge = 0.8;  // of the bound: where the disturbance grows more than tenfold
    while (edge < 4.0 && speed_after(edge * bound) < 1e-5) edge += 0.01;
    MESSAGE("stable substep " << bound << " s; goes wild at " << edge << " of it");
    CHECK(edge > 1.0);
    CHECK(edge <
          2.0);  // row sums count tension along warp and weft together, which costs sqrt 2, and bending
    SolverExplicit solver;
    ClothState state = flat_state(model);
    solver.prepare(model, material, {1, Vec3::Zero(), Vec3::Zero()});
    CHECK(solver.stable_substep() == bound);
    CHECK(solver.step(state, 0.99 * bound) == 0);
    CHECK(solver.step(state, 1.01 * bound) == kExplicitUnstableSubstep);
  }

  TEST_CASE("fixed slots go straight to where they are told") {
    const ClothModel model = hung_sheet();
    const ClothMaterial material = uneven_material();
    ClothState state = flat_state(model);
    SolverExplicit solver;
    solver.prepare(model, material, fine_options());
    REQUIRE(solver.fixed_slots().size() == 2);
    const Vec3 move(1e-4, -2e-4, 3e-4);
    const std::vector<Vec3> held{state.positions[0] + move, state.positions[5]};
    CHECK(solver.step(state, 1e-3, held) == 0);
    CHECK(state.positions[0] == held[0]);
    CHECK(state.positions[5] == held[1]);
    CHECK((state.velocities[0] - move / 1e-3).norm() < 1e-12);
    CHECK(state.time == 1e-3);
    CHECK(solver.step(state, 1e-3) == 0);  // no positions: they stay
    CHECK(state.positions[0] == held[0]);
    CHECK(state.velocities[0] == Vec3::Zero());
  }

  TEST_CASE("a number that is not finite is refused and the last good state kept") {
    const ClothModel model = hung_sheet();
    const ClothMaterial material = uneven_material();
    ClothState state = flat_state(model);
    SolverExplicit solver;
    solver.prepare(model, material);
    state.velocities[8].x() = std::numeric_limits<double>::infinity();
    CHECK(solver.step(state, 1e-3) == kExplicitNotFinite);
    CHECK(solver.failed_steps() == 1);
    CHECK(state.time == 0.0);
    CHECK(state.positions == flat_state(model).positions);
    CHECK(solver.reaction() == Vec3::Zero());
  }

  TEST_CASE("bad set-up is refused") {
    const ClothModel model = hung_sheet();
    const ClothMaterial material = uneven_material();
    SolverExplicit solver;
    CHECK_THROWS_AS(solver.prepare(model, material, {0, Vec3::Zero(), Vec3::Zero()}), Error);
    ClothModel bare = model;
    bare.node_area[7] = 0.0;
    CHECK_THROWS_AS(solver.prepare(bare, material), Error);
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("two runs agree bit for bit") {
    const ClothModel model = hung_sheet();
    const ClothMaterial material = uneven_material();
    const ClothState first = pulled_run(model, material), second = pulled_run(model, material);
    CHECK(first.positions == second.positions);
    CHECK(first.velocities == second.velocities);
    CHECK(first.positions != flat_state(model).positions);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("a step allocates nothing") {
    const ClothModel model = hung_sheet();
    const ClothMaterial material = uneven_material();
    ClothState state = flat_state(model);
    SolverExplicit solver;
    solver.prepare(model, material, fine_options());
    const AllocationGuard guard;
    const std::uint32_t status = solver.step(state, 1e-3);
    CHECK(guard.count() == 0);
    CHECK(status == 0);
  }
}
