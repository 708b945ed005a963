// Step sizes: the stability bounds and what happens beyond them; refusals, determinism, real time.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/solver/relaxation.h"
#include "support/allocation_guard.h"
#include "support/linear_laws.h"

using namespace fuai;

namespace {

constexpr double kH = 0.01;

/// Largest distance from rest after some steps from a small random start, over the largest at the start.
double growth(const FabricLaws& laws, const RelaxationSteps& steps, bool out_of_plane, int count) {
  const LatticeModel model = make_lattice_model({18, 18, kH, 0.0, {}});
  RelaxationOptions options;
  options.steps = steps;
  options.allow_unstable = true;
  options.gravity = Vec3::Zero();
  options.area_weights = AreaWeights::kNone;
  SolverRelaxation solver;
  solver.prepare(model, laws, options);
  LatticeState state = make_lattice_state(model);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1e-9, 1e-9);
  for (Vec3& x : state.positions) {
    if (out_of_plane) {
      x.z() += uniform(random);
    } else {
      x += Vec3(uniform(random), uniform(random), 0.0);
    }
  }
  const auto force = [&] {
    solver.compute_forces(state);
    double largest = 0.0;
    for (int n = 0; n < model.node_count(); ++n) largest = std::max(largest, solver.force(n).norm());
    return largest;
  };
  const double before = force();
  for (int k = 0; k < count; ++k) solver.step(state);
  return force() / before;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("springs alone: gamma1 0.124 and, on a finite sheet, 0.126 decay; 0.130 explodes") {
    const FabricLaws limp = fuai_test::linear_laws(0.0, 0.0, 0.0);
    // Plane waves bound gamma1 by 1/8; a finite free sheet lacks the fastest one.
    CHECK(growth(limp, {0.124, 1.0}, false, 2000) < 0.5);
    CHECK(growth(limp, {0.126, 1.0}, false, 2000) < 0.5);
    CHECK(growth(limp, {0.130, 1.0}, false, 2000) > 1e3);
  }

  TEST_CASE("bending alone: gamma2 at 0.98 of l0^2 / (16 B) decays, at 1.02 it grows") {
    for (double B : {0.02, 0.10, 0.20}) {
      const FabricLaws laws = fuai_test::linear_laws(B, 0.0, 0.0);
      const double bound = kH * kH / (16.0 * B * unit::kGfCm2PerCm);
      CHECK(growth(laws, {0.0, 0.98 * bound}, true, 2000) < 0.5);
      CHECK(growth(laws, {0.0, 1.02 * bound}, true, 2000) > 1e3);
    }
  }

  TEST_CASE("as printed, a wave of six spacings grows by 0.1000 a step") {
    // gamma2 B / l0^2 4 cos q (1 - cos q) = 0.1 at q = pi/3 for B = 0.1 gf cm2/cm, gamma2 = 1 cm/gf.
    const FabricLaws laws = fuai_test::linear_laws(0.1, 0.0, 0.0);
    const int columns = 121, steps = 20;
    const LatticeModel model = make_lattice_model({columns, 3, kH, 0.0, {}});
    RelaxationOptions options;
    options.mode = PaperMode::kAsPrinted;
    options.area_weights = AreaWeights::kNone;  // whole border threads move like the inner ones
    options.gravity = Vec3::Zero();
    options.allow_unstable = true;
    options.steps = RelaxationSteps{0.0, unit::kCentimetre / unit::kGramForce};
    const auto grow = [&](double q) {
      SolverRelaxation solver;
      solver.prepare(model, laws, options);
      LatticeState state = make_lattice_state(model);
      for (int n = 0; n < model.node_count(); ++n) {
        state.positions[static_cast<std::size_t>(n)].z() = 1e-9 * std::cos(q * (n % columns - columns / 2));
      }
      for (int k = 0; k < steps; ++k) solver.step(state);
      // The border is two nodes a step away from the middle.
      const double middle = state.positions[static_cast<std::size_t>(model.node(columns / 2, 1))].z();
      return std::pow(std::abs(middle) / 1e-9, 1.0 / steps) - 1.0;
    };
    for (int spacings : {5, 6, 8, 12}) {
      const double q = 2.0 * std::numbers::pi / spacings;
      // Waves of 1e-7 rad are linear to 1e-14; rounding of unit vectors, 1e-16 / 1e-7, grows along.
      CHECK(grow(q) == doctest::Approx(0.4 * std::cos(q) * (1.0 - std::cos(q))).epsilon(1e-5));
    }
    CHECK(grow(std::numbers::pi / 3.0) == doctest::Approx(0.1).epsilon(1e-5));
    // The corrected gradient damps the same wave: 1 - 0.1 (2 - 2 cos q)^2 = 0.9 a step.
    options.mode = PaperMode::kCorrected;
    CHECK(grow(std::numbers::pi / 3.0) == doctest::Approx(-0.1).epsilon(1e-5));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("steps sit at the stated fraction of the joint bound and keep the stiffness asked for") {
    const FabricLaws laws = fuai_test::linear_laws(0.12, 0.04, 200.0);
    const LatticeModel model = make_lattice_model({18, 18, kH, 0.2, {}});
    for (PaperMode mode : {PaperMode::kAsPrinted, PaperMode::kCorrected}) {
      RelaxationOptions options;
      options.mode = mode;
      SolverRelaxation solver;
      solver.prepare(model, laws, options);
      const double B = bending_stiffness_bound(laws.bending[0], kH, mode);
      CHECK(relaxation_stability_number(solver.steps(), B, kH) == doctest::Approx(1.8).epsilon(1e-12));
      CHECK(solver.spring_stiffness() == doctest::Approx(10.0 * unit::kGfPerCm).epsilon(1e-12));
      // All plays sticking: B + HB (1/0.05 + 1/0.15 + 1/0.4) / 3; as printed the slope of the branch is B.
      const double expected =
          mode == PaperMode::kAsPrinted ? 0.12 : 0.12 + 0.04 * (20.0 + 20.0 / 3.0 + 2.5) / 3.0;
      CHECK(B / unit::kGfCm2PerCm == doctest::Approx(expected).epsilon(1e-9));
    }
  }

  TEST_CASE("unstable and senseless options are refused") {
    const FabricLaws laws = fuai_test::linear_laws(0.1, 0.0, 200.0);
    const LatticeModel model = make_lattice_model({5, 5, kH, 0.2, {}});
    SolverRelaxation solver;
    const auto refuses = [&](auto change) {
      RelaxationOptions options;
      change(options);
      CHECK_THROWS_AS(solver.prepare(model, laws, options), Error);
    };
    refuses([](RelaxationOptions& o) { o.steps = RelaxationSteps{0.13, 1e-6}; });
    refuses([](RelaxationOptions& o) {
      o.steps = RelaxationSteps{0.0, 1.01 * kH * kH / (16.0 * 0.1 * unit::kGfCm2PerCm)};
    });
    refuses([](RelaxationOptions& o) { o.steps = RelaxationSteps{-0.1, 1.0}; });
    refuses([](RelaxationOptions& o) { o.steps = RelaxationSteps{0.1, 0.0}; });
    refuses([](RelaxationOptions& o) {
      o.steps = RelaxationSteps{std::numeric_limits<double>::infinity(), 1.0};
    });
    refuses([](RelaxationOptions& o) { o.spring_stiffness = 0.0; });
    refuses([](RelaxationOptions& o) { o.spring_stiffness = std::numeric_limits<double>::quiet_NaN(); });
    refuses([](RelaxationOptions& o) { o.step_fraction = 1.0; });
    RelaxationOptions bold;
    bold.steps = RelaxationSteps{0.13, 1e-6};
    bold.allow_unstable = true;
    CHECK_NOTHROW(solver.prepare(model, laws, bold));
  }

  TEST_CASE("an explosion is reported, not hidden") {
    const FabricLaws laws = fuai_test::linear_laws(0.1, 0.0, 200.0);
    const LatticeModel model = make_lattice_model({8, 8, kH, 0.2, {0, 1, 8, 9}});
    RelaxationOptions options;
    options.steps = RelaxationSteps{0.5, 1e5};
    options.allow_unstable = true;
    SolverRelaxation solver;
    solver.prepare(model, laws, options);
    LatticeState state = make_lattice_state(model);
    const RelaxationResult result = solver.run(state);
    CHECK_FALSE(result.converged);
    CHECK((result.status & kRelaxationNotFinite) != 0);
    CHECK((result.status & kRelaxationStepLimit) == 0);
  }

  TEST_CASE("flat cloth without weight is at rest, and progress is told") {
    const FabricLaws laws = fuai_test::linear_laws(0.1, 0.03, 200.0);
    const LatticeModel model = make_lattice_model({5, 5, kH, 0.2, {}});
    RelaxationOptions options;
    options.gravity = Vec3::Zero();
    SolverRelaxation solver;
    solver.prepare(model, laws, options);
    LatticeState state = make_lattice_state(model);
    int told = 0;
    const RelaxationResult result = solver.run(state, {}, [&](std::string_view, double) { ++told; });
    CHECK(result.converged);
    CHECK(result.steps == 0);
    CHECK(result.residual < 1e-12);  // rounding of the diagonal's rest length
    CHECK(told == 1);
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("two runs, and single steps, give the same bits") {
    const FabricLaws laws = fuai_test::linear_laws(0.06, 0.02, 200.0);
    const LatticeModel model = make_lattice_model({10, 8, kH, 0.2, {0, 1, 10, 11}});
    RelaxationStop stop;
    stop.max_steps = 500;
    std::vector<std::uint64_t> hashes;
    for (int repeat = 0; repeat < 3; ++repeat) {
      SolverRelaxation solver;
      solver.prepare(model, laws);
      LatticeState state = make_lattice_state(model);
      if (repeat < 2) {
        hashes.push_back(solver.run(state, stop).position_hash);
      } else {
        for (int k = 0; k < 500; ++k) solver.step(state);
        hashes.push_back(solver.measure(state).position_hash);
      }
    }
    CHECK(hashes[0] == hashes[1]);
    CHECK(hashes[0] == hashes[2]);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("a step allocates nothing") {
    const FabricLaws laws = fuai_test::linear_laws(0.06, 0.02, 200.0);
    const LatticeModel model = make_lattice_model({10, 8, kH, 0.2, {0, 1, 10, 11}});
    for (PaperMode mode : {PaperMode::kAsPrinted, PaperMode::kCorrected}) {
      RelaxationOptions options;
      options.mode = mode;
      SolverRelaxation solver;
      solver.prepare(model, laws, options);
      LatticeState state = make_lattice_state(model);
      const fuai_test::AllocationGuard guard;
      for (int k = 0; k < 1000; ++k) solver.step(state);
      CHECK(guard.count() == 0);
      CHECK(solver.residual() > 0.0);
      CHECK(noexcept(solver.step(state)));
    }
  }
}
