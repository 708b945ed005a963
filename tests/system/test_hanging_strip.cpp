// A strip hung by its end stretches by its spring constant, whatever the step.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/core/constants.h"
#include "system/hanging_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr int kRows = 64;
constexpr double kTension = 1000.0, kSpacing = 0.01;  // [N/m], [m]

/// Mean elongation of the strip over w L^2 / (2 k) after half a second.
double elongation(double dt) {
  const ClothModel model = hanging_model(3, kRows, kSpacing);
  ClothMaterial material = linear_material({1e-5, 1e-5, 0.0, 2.5e-6}, kTension, 50.0);
  // The slowest wave along the strip has 200 rad/s: this drag damps it in a few hundredths of a second.
  material.mass_drag = 300.0;
  SimulationOptions options;
  options.implicit.iterations = 8;
  Simulation<float> simulation(model, material, options);
  simulation.restore(upright_state(model));
  const int steps = static_cast<int>(std::lround(0.5 / dt));
  for (int i = 0; i < steps; ++i) simulation.step(dt);
  const double length = (kRows - 1) * kSpacing;
  double low = 0.0;
  for (int column = 0; column < 3; ++column) low -= simulation.position(model.slot(column, 0)).z() / 3.0;
  const double exact = kArealMass * kStandardGravity * length * length / (2.0 * kTension);
  MESSAGE("hanging strip, dt ", 1e3 * dt, " ms: elongation over exact ", (low - length) / exact);
  return (low - length) / exact;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a hanging strip of 64 rows stretches by w L^2 / (2 k) within 1 % at any step") {
    // In single precision the end is known to 3e-8 m, 1e-4 of the elongation of 0.29 mm.
    const double fine = elongation(0.25e-3), usual = elongation(1e-3), coarse = elongation(4e-3);
    for (double ratio : {fine, usual, coarse}) CHECK(std::abs(ratio - 1.0) < 0.01);
    CHECK(std::abs(fine - usual) < 0.01);
    CHECK(std::abs(coarse - usual) < 0.01);
  }
}
