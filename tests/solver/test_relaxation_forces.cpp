// The inner loop against the energies it descends: forces, momentum, memory, membrane constants, the grasp.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "fuai/energy/stretch.h"
#include "fuai/solver/grasp_force.h"
#include "fuai/solver/relaxation.h"
#include "support/linear_laws.h"

using namespace fuai;

namespace {

constexpr double kH = 0.01;

/// A law that tells face from back, with friction that widens.
PlayLaw uneven_law() {
  std::vector<double> elastic, friction;
  for (int i = 0; i <= 100; ++i) {
    const double x = -2.5 + 0.05 * i;
    elastic.push_back(unit::kGfCmPerCm * (0.1 * x + 0.004 * x * x * x + 0.01 * std::abs(x) * x));
    friction.push_back(unit::kGfCmPerCm * (0.03 + 0.004 * x * x + 0.002 * x));
  }
  const double reach = 2.5 * unit::kPerCentimetre;
  const PlayElement elements[] = {{0.05 * unit::kPerCentimetre, 0.4},
                                  {0.2 * unit::kPerCentimetre, 0.35},
                                  {0.6 * unit::kPerCentimetre, 0.25}};
  return make_play_law(make_curve_table(-reach, reach, elastic),
                       make_curve_table(-reach, reach, friction, constant_outside()), elements);
}

/// Warp and weft differ.
FabricLaws uneven_laws() {
  FabricLaws laws = fuai_test::linear_laws(0.06, 0.02, 200.0);
  laws.bending[static_cast<std::size_t>(Direction::kWarp)] = uneven_law();
  return laws;
}

/// A crumpled 6 x 5 sheet with some past. Amplitude in spacings.
LatticeState crumpled(const LatticeModel& model, const FabricLaws& laws, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  LatticeState state = make_lattice_state(model);
  for (Vec3& x : state.positions)
    x += amplitude * kH * Vec3(uniform(random), uniform(random), uniform(random));
  for (std::size_t t = 0; t < state.memory.size(); ++t) {
    const PlayLaw& law = laws.bending[static_cast<std::size_t>(model.triples[t].direction)];
    for (int k = 0; k < 4; ++k) law.commit(150.0 * uniform(random), state.memory[t]);
  }
  return state;
}

/// Springs, incremental potential of bending, and weight [J].
double total_potential(const SolverRelaxation& solver, const LatticeState& state) {
  const LatticeModel& model = solver.model();
  const bool weigh = solver.area_weights() == AreaWeights::kEverything;
  const RelaxationResult parts = solver.measure(state);
  double energy = parts.stretch_energy + parts.weight_energy;
  for (std::size_t t = 0; t < model.triples.size(); ++t) {
    const PlayLaw& law = solver.laws().bending[static_cast<std::size_t>(model.triples[t].direction)];
    const double area = kH * kH * (weigh ? model.triples[t].tributary_factor : 1.0);
    const TripleReading reading = solver.read_triple(state, t);
    energy +=
        area * (law.incremental_potential(reading.curvature, state.memory[t]) + reading.in_plane_energy);
  }
  return energy;
}

/// Net force [gf] and net moment [gf cm] of the solver's forces.
std::pair<double, double> net(const SolverRelaxation& solver, const LatticeState& state) {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (int node = 0; node < solver.model().node_count(); ++node) {
    force += solver.force(node);
    moment += state.positions[static_cast<std::size_t>(node)].cross(solver.force(node));
  }
  return {force.norm() / unit::kGramForce, moment.norm() / (unit::kGramForce * unit::kCentimetre)};
}

}  // namespace

TEST_SUITE("derivative") {
  TEST_CASE("forces are minus the gradient of springs, incremental potential and weight") {
    const FabricLaws laws = uneven_laws();
    const LatticeModel model = make_lattice_model({6, 5, kH, 0.2, {}});
    for (AreaWeights weights : {AreaWeights::kNone, AreaWeights::kWeightOnly, AreaWeights::kEverything}) {
      SolverRelaxation solver;
      RelaxationOptions options;
      options.area_weights = weights;
      solver.prepare(model, laws, options);
      LatticeState state = crumpled(model, laws, 0.3, 17);
      solver.compute_forces(state);
      double worst = 0.0, largest = 0.0;
      for (int node = 0; node < model.node_count(); ++node) {
        for (int c = 0; c < 3; ++c) {
          double& x = state.positions[static_cast<std::size_t>(node)][c];
          const double at = x, step = 1e-7;
          x = at + step;
          const double up = total_potential(solver, state);
          x = at - step;
          const double down = total_potential(solver, state);
          x = at;
          worst = std::max(worst, std::abs((up - down) / (2 * step) + solver.force(node)[c]));
        }
        largest = std::max(largest, solver.force(node).norm());
      }
      // Step 1e-5 of the spacing: truncation 1e-10 and rounding 1e-10 of the largest force (0.1 N).
      CHECK(worst < 1e-8 * largest);
      CHECK(largest > 0.01);
    }
  }
}

TEST_SUITE("crosscheck") {
  TEST_CASE("the inner loop and the stencil functions give the same force at every node, folds included") {
    const FabricLaws laws = uneven_laws();
    const LatticeModel model = make_lattice_model({7, 6, kH, 0.2, {0, 1, 20}});
    SolverRelaxation solver;
    solver.prepare(model, laws);
    bool folds = false;
    for (unsigned seed = 1; seed < 6; ++seed) {
      const LatticeState state = crumpled(model, laws, seed < 3 ? 0.2 : 0.9, seed);
      solver.compute_forces(state);
      double worst = 0.0, largest = 0.0;
      for (int node = 0; node < model.node_count(); ++node) {
        worst = std::max(worst, (evaluate_grasp(solver, state, node).reaction - solver.force(node)).norm());
        largest = std::max(largest, solver.force(node).norm());
      }
      CHECK(worst < 1e-12 * largest);  // two orders of summation
      RelaxationStop look;
      look.max_steps = 0;
      LatticeState copy = state;
      folds = folds || (solver.run(copy, look).status & kRelaxationSharpFold) != 0;
    }
    CHECK(folds);
  }
}

TEST_SUITE("property") {
  TEST_CASE("the full gradient creates no momentum; the paper's own-sum gradient does") {
    const FabricLaws laws = fuai_test::linear_laws(0.1, 0.03, 200.0);
    const LatticeModel model = make_lattice_model({6, 5, kH, 0.2, {}});
    RelaxationOptions options;
    options.gravity = Vec3::Zero();
    SolverRelaxation corrected, printed;
    corrected.prepare(model, laws, options);
    options.mode = PaperMode::kAsPrinted;
    printed.prepare(model, laws, options);
    const LatticeState state = crumpled(model, laws, 0.3, 4);
    corrected.compute_forces(state);
    printed.compute_forces(state);
    const auto [force, moment] = net(corrected, state);
    CHECK(force < 1e-12);   // gf; forces of 10 gf cancel to rounding
    CHECK(moment < 1e-12);  // gf cm
    const auto [printed_force, printed_moment] = net(printed, state);
    CHECK(printed_force > 0.1);
    CHECK(printed_moment > 0.1);
  }

  TEST_CASE("with friction a step never raises springs + weight + free energy") {
    const FabricLaws laws = fuai_test::linear_laws(0.06, 0.02, 200.0);
    const LatticeModel model = make_lattice_model({9, 9, kH, 0.2, {0, 1, 2, 9, 10, 11, 18, 19, 20}});
    SolverRelaxation solver;
    solver.prepare(model, laws);
    LatticeState state = make_lattice_state(model);
    const auto energy = [&] {
      // The free energy counts after the memory has moved to the positions: step() does that first.
      const RelaxationResult r = solver.measure(state);
      return r.stretch_energy + r.bending_energy + r.weight_energy;
    };
    double last = energy(), worst = 0.0;
    for (int k = 0; k < 400; ++k) {
      for (int j = 0; j < 25; ++j) solver.step(state);
      const double now = energy();
      worst = std::max(worst, now - last);
      last = now;
    }
    CHECK(worst <= 1e-16);  // rounding of an energy of 1e-4 J is 1e-20; nothing else may raise it
    CHECK(last < -1e-4);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("eight-neighbour springs are a membrane with C11 : C12 : C66 = 2 : 1 : 1") {
    const FabricLaws laws = fuai_test::linear_laws(0.1, 0.0, 0.0);
    const LatticeModel model = make_lattice_model({12, 9, kH, 0.0, {}});
    SolverRelaxation solver;
    solver.prepare(model, laws);
    const double k = solver.spring_stiffness(), area = 11 * 8 * kH * kH, e = 1e-6;
    const auto density = [&](double xx, double yy, double xy) {
      LatticeState state = make_lattice_state(model);
      for (Vec3& x : state.positions) x += Vec3(xx * x.x() + xy * x.y(), yy * x.y(), 0.0);
      return solver.measure(state).stretch_energy / area / (0.5 * e * e);
    };
    const double C11 = density(e, 0, 0), C22 = density(0, e, 0), C66 = density(0, 0, e);
    const double C12 = 0.5 * (density(e, e, 0) - C11 - C22);
    // Second-order terms are e = 1e-6 of the first; lengths round at 1e-16 / 1e-6.
    CHECK(C11 / k == doctest::Approx(2.0).epsilon(1e-5));
    CHECK(C22 / k == doctest::Approx(2.0).epsilon(1e-5));
    CHECK(C12 / k == doctest::Approx(1.0).epsilon(1e-5));
    CHECK(C66 / k == doctest::Approx(1.0).epsilon(1e-5));
  }
}
