// The static solver: its Hessian against differences of the reference forces, clamps that are told, pulled
// and turned against closed forms.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/static.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "fuai/cloth/cloth_piece.h"
#include "fuai/core/constants.h"
#include "fuai/core/error.h"
#include "fuai/solver/cloth_energy.h"
#include "fuai/solver/static_hessian.h"
#include "support/small_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr double kH = 0.01, kLength = 0.06, kWidth = 0.04;

/// Warp strip of kLength between two clamps of two spacings each.
ClothModel strip() {
  ClothPieceSpec spec;
  spec.outline = {{0, -2 * kH}, {kWidth, -2 * kH}, {kWidth, kLength + 2 * kH}, {0, kLength + 2 * kH}};
  spec.spacing = kH;
  spec.areal_mass = 0.15;
  spec.clamps = {{HalfPlaneRegion{{0, 1}, 0.0}, true}, {HalfPlaneRegion{{0, -1}, -kLength}, true}};
  return make_cloth_model(spec);
}

std::vector<int> held_slots(const ClothModel& model, bool high) {
  std::vector<int> slots;
  for (int slot = 0; slot < model.slot_count(); ++slot) {
    if (model.fixed[static_cast<Index>(slot)] != 0 && (slot / model.columns > model.rows / 2) == high)
      slots.push_back(slot);
  }
  return slots;
}

constexpr double kK = 900.0, kB = 1e-5;  // [N/m], [N m]

ClothMaterial linear_material() {
  ClothMaterial m;
  m.weft_tension = m.warp_tension = straight_law(kK, 0.0, 0.5);
  m.shear = straight_law(40.0, 0.0, 0.5);
  m.weft_bending = m.warp_bending = straight_law(kB, 0.0, 500.0);
  return m;
}

/// The dense Hessian out of the blocks.
Eigen::MatrixXd assembled(const ClothModel& model, const ClothMaterial& material, ClothState& state) {
  const auto n = static_cast<Eigen::Index>(3 * state.positions.size());
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(n, n);
  const ClothState memory = state;
  const HessianPoint at{model, material, memory, state.positions, {true, true, true}, false};
  HessianBlock block;
  const auto add = [&] {
    for (Index a = 0; a < 3 * block.count; ++a) {
      for (Index b = 0; b < 3 * block.count; ++b) {
        hessian(static_cast<Eigen::Index>(3 * block.slots[a / 3] + a % 3),
                static_cast<Eigen::Index>(3 * block.slots[b / 3] + b % 3)) +=
            block.values(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      }
    }
  };
  for (Index slot = 0; slot < state.positions.size(); ++slot) {
    if (edge_block(at, slot, 0, block)) add();
    if (edge_block(at, slot, 1, block)) add();
    if (cell_block(at, slot, block)) add();
    if (bend_block(at, slot, block)) add();
  }
  return hessian;
}

}  // namespace

TEST_SUITE("derivative") {
  TEST_CASE("the blocks sum to the derivative of the reference forces") {
    const ClothModel model = sheet_model(5, 6, kH, 0.15, {2 + 5 * 3});
    ClothMaterial material = uneven_material();
    material.shear = {};  // its stress is left out of the blocks on purpose; the next case has its tangent
    std::mt19937 random(3);
    ClothState state = flat_state(model);
    jitter(state.positions, 0.1 * kH, random);
    const Eigen::MatrixXd hessian = assembled(model, material, state);
    const double step = 1e-5 * kH;
    double worst = 0.0;
    std::vector<Vec3> ahead(state.positions.size()), behind(ahead);
    for (Index j = 0; j < 3 * state.positions.size(); ++j) {
      std::vector<Vec3> x = state.positions;
      const auto axis = static_cast<Eigen::Index>(j % 3);
      x[j / 3][axis] += step;
      evaluate_cloth(model, material, state, x, {}, ahead);
      x[j / 3][axis] -= 2.0 * step;
      evaluate_cloth(model, material, state, x, {}, behind);
      for (Index i = 0; i < 3 * state.positions.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i % 3);
        const double k = -(ahead[i / 3][row] - behind[i / 3][row]) / (2.0 * step);
        worst = std::max(worst,
                         std::abs(hessian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) - k));
      }
    }
    // Differences over 1e-7 m of tables with cells of 1e-4 of strain, and of gradients of 1e-6 spacings.
    CHECK(worst < 1e-5 * hessian.cwiseAbs().maxCoeff());
  }

  TEST_CASE("in a state without shear stress the shear block is the derivative too") {
    const ClothModel model = sheet_model(3, 3, kH, 0.15);
    ClothMaterial material;
    material.shear = straight_law(40.0, 0.3, 0.5);
    ClothState state = flat_state(model);
    const Eigen::MatrixXd hessian = assembled(model, material, state);
    const double step = 1e-5 * kH;
    std::vector<Vec3> x = state.positions, forces(x.size());
    x[4].x() += step;
    evaluate_cloth(model, material, state, x, {}, forces);
    for (Index i = 0; i < x.size(); ++i) {
      // The angle is odd in the shift, the rest of the difference is of the order of the shift over h: 1e-5.
      CHECK(-forces[i].y() / step ==
            doctest::Approx(hessian(static_cast<Eigen::Index>(3 * i + 1), 12)).epsilon(1e-4));
    }
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("a clamp that is pulled goes where the law says") {
    const ClothModel model = strip();
    SolverStatic solver(model, linear_material(), make_cloth_state(model),
                        {{true, true, false}, Vec3::Zero()});
    const std::size_t clamp = solver.add_clamp(held_slots(model, true), {0.5 * kWidth, kLength, 0});
    const double force = 5.0 * kWidth;
    solver.set_freedom(clamp, Vec3::UnitY(), force);
    const StaticReport report = solver.settle();
    CHECK(report.converged);
    // Nine digits are what is asked of the solver.
    CHECK(solver.read(clamp).shift.y() == doctest::Approx(kLength * 5.0 / kK).epsilon(1e-8));
    CHECK(solver.read(clamp).force.y() == doctest::Approx(-force).epsilon(1e-8));
  }

  TEST_CASE("a clamp that is turned and free of force bends a strip into an arc of B K") {
    const ClothModel model = strip();
    const double curvature = 20.0, angle = curvature * kLength;
    SolverStatic solver(model, linear_material(), make_cloth_state(model),
                        {{false, true, true}, Vec3::Zero()});
    const std::size_t clamp = solver.add_clamp(held_slots(model, true), {0.5 * kWidth, kLength, 0});
    solver.set_freedom(clamp, Vec3::UnitY(), 0.0);
    solver.set_freedom(clamp, Vec3::UnitZ(), 0.0);
    for (int i = 1; i <= 8; ++i) {
      solver.place(clamp, Eigen::AngleAxisd(angle * i / 8, Vec3::UnitX()).toRotationMatrix(), Vec3::Zero());
      CHECK(solver.settle().converged);
      solver.commit();
    }
    const ClampReading r = solver.read(clamp);
    // 1e-6: the rational arc tangent of the curvature at 0.2 rad a segment (docs/theory/engine.md).
    CHECK(-r.moment.x() / kWidth == doctest::Approx(kB * curvature).epsilon(1e-6));
    // The chain of edges, turned in each triple by what it bends.
    const int column = model.columns / 2;
    double turn = 0.0;
    Vec2 end = Vec2::Zero();
    for (int row = 2; row + 3 < model.rows; ++row) {
      turn += curvature * model.warp_bend_length[static_cast<Index>(model.slot(column, row))];
      end += kH * Vec2(std::cos(turn), std::sin(turn));
    }
    CHECK(kLength + r.shift.y() == doctest::Approx(end.x()).epsilon(1e-5));
    CHECK(r.shift.z() == doctest::Approx(end.y()).epsilon(1e-5));
    // It is the arc to second order.
    const double arc = std::hypot(std::sin(angle), 1.0 - std::cos(angle)) / curvature;
    CHECK(end.norm() == doctest::Approx(arc).epsilon(0.05 * std::pow(kH * curvature, 2)));
    CHECK(r.force.norm() < 1e-9);  // StaticOptions::least_force
  }

  TEST_CASE("weight is carried by both clamps") {
    const ClothModel model = strip();
    SolverStatic solver(model, linear_material(), make_cloth_state(model),
                        {{true, true, true}, {0, 0, -kStandardGravity}});
    const std::size_t low = solver.add_clamp(held_slots(model, false), Vec3::Zero());
    const std::size_t high = solver.add_clamp(held_slots(model, true), Vec3::Zero());
    CHECK(solver.settle().converged);
    double weight = 0.0;
    for (Index slot = 0; slot < model.node_area.size(); ++slot) {
      if (model.fixed[slot] == 0) weight += 0.15 * model.node_area[slot] * kStandardGravity;
    }
    // 1e-6: the tolerance of 1e-9 is of the clamps' forces, most of which pull along the strip.
    CHECK(solver.read(low).force.z() == doctest::Approx(-0.5 * weight).epsilon(1e-6));
    CHECK(solver.read(high).force.z() == doctest::Approx(-0.5 * weight).epsilon(1e-6));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("what is tried and taken back leaves no trace") {
    const ClothModel model = strip();
    ClothMaterial material = linear_material();
    material.warp_tension = straight_law(kK, 2.0, 0.5);
    const auto run = [&](bool try_more) {
      SolverStatic solver(model, material, make_cloth_state(model), {{true, true, false}, Vec3::Zero()});
      const std::size_t clamp = solver.add_clamp(held_slots(model, true), {0, kLength, 0});
      solver.place(clamp, Mat3::Identity(), {0, 0.001, 0});
      CHECK(solver.settle().converged);
      solver.commit();
      if (try_more) {
        solver.place(clamp, Mat3::Identity(), {0, 0.004, 0});
        CHECK(solver.settle().converged);
        solver.roll_back();
      }
      solver.place(clamp, Mat3::Identity(), {0, 0.0005, 0});
      CHECK(solver.settle().converged);
      return solver.read(clamp).force.y();
    };
    CHECK(run(true) == doctest::Approx(run(false)).epsilon(1e-12));
  }

  TEST_CASE("a clamp cannot take hold of a free slot") {
    const ClothModel model = strip();
    SolverStatic solver(model, linear_material(), make_cloth_state(model), {});
    const std::vector<int> free_slot{model.slot(1, model.rows / 2)};
    CHECK_THROWS_AS(solver.add_clamp(free_slot, Vec3::Zero()), Error);
    StaticOptions wrong;
    wrong.most_iterations = 0;
    CHECK_THROWS_AS(SolverStatic(model, linear_material(), make_cloth_state(model), wrong), Error);
  }
}
