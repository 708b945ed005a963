// What a step takes from an oscillation is what the theory of the theta method says.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "system/hanging_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr double kTension = 0.1, kSpacing = 0.01;  // [N/m], [m]
constexpr double kSeconds = 2.0;

/// Three rows, the upper two held, the lowest on its springs: half a cell of mass, omega^2 = 2 k / (rho h^2).
double omega_square() { return 2.0 * kTension / (kArealMass * kSpacing * kSpacing); }

/// ln of the energy after over that before, of a row that was let go 1 % longer than it is.
double log_energy(double implicitness, double dt) {
  ClothModel model = hanging_model(3, 3, kSpacing);
  ClothMaterial material = linear_material({0.0, 0.0, 0.0, 0.0}, kTension, 0.0);
  SimulationOptions options;
  options.implicit.implicitness = implicitness;
  options.implicit.gravity = Vec3::Zero();
  ClothState state = upright_state(model);
  const auto low = static_cast<Index>(model.slot(1, 0));
  const auto energy = [&] {
    const double out = state.positions[low].z() + 2.0 * kSpacing, speed = state.velocities[low].z();
    return speed * speed + omega_square() * out * out;
  };
  for (int column = 0; column < 3; ++column) {
    model.fixed[static_cast<Index>(model.slot(column, 1))] = 1;
    state.positions[static_cast<Index>(model.slot(column, 0))].z() -= 0.01 * kSpacing;
  }
  const double before = energy();
  Simulation<double> simulation(model, material, options);
  simulation.restore(state);
  const int steps = static_cast<int>(std::lround(kSeconds / dt));
  for (int i = 0; i < steps; ++i) simulation.step(dt);
  simulation.snapshot(state);
  return std::log(energy() / before);
}

/// The same by theory: the squared modulus of a step's two factors, (1 + (1 - theta)^2 w^2) / (1 + theta^2
/// w^2) with w = omega dt.
double exact(double theta, double dt) {
  const double w2 = omega_square() * dt * dt, rest = 1.0 - theta;
  return kSeconds / dt * std::log((1.0 + rest * rest * w2) / (1.0 + theta * theta * w2));
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a step takes from an oscillation what its implicitness says, long steps all that Euler takes") {
    // The energy of one moment is off its mean over a period by up to w = 0.12 (dt 1 ms) of itself, of a
    // logarithm of 8 and more.
    for (const double theta : {0.55, 0.65, 0.8, 1.0}) {
      CAPTURE(theta);
      CHECK(std::abs(log_energy(theta, 1e-3) - exact(theta, 1e-3)) < 0.2);
    }
    CHECK(std::abs(log_energy(0.65, 0.25e-3) - exact(0.65, 0.25e-3)) < 0.2);
    const double long_step = 1.1 * kLongestSharpStep;
    CHECK(std::abs(log_energy(0.65, long_step) - exact(1.0, long_step)) < 0.4);  // w is larger
    CHECK(log_energy(0.65, long_step) == log_energy(1.0, long_step));
  }
}
