// Cloth that is left alone never gains energy.
// SPDX-License-Identifier: Apache-2.0
#include "system/hanging_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

/// A sheet, level at first, is released. The largest rise of its energy in one step, over the energy that it
/// loses on the way.
double largest_rise(const ClothMaterial& material, double dt, int steps) {
  const ClothModel model = hanging_model(13, 17, 0.01);
  SimulationOptions options;
  options.implicit.iterations = 400;
  options.implicit.linearisations = 60;
  options.implicit.relinearise = 1e-9;
  options.implicit.reduction = 1e-3;
  options.implicit.tolerance = 1e-9;  // [N]; the sheet weighs 0.03 N
  Simulation<double> simulation(model, material, options);
  ClothState state = make_cloth_state(model);
  std::mt19937 random(3);
  jitter(state.positions, 1e-6, random);  // so that it may buckle
  simulation.restore(state);
  const double first = simulation.read().total_energy();
  double before = first, rise = -1e300;
  int restless = 0;
  for (int i = 0; i < steps; ++i) {
    const StepReport report = simulation.step(dt);
    restless += report.residual > 1e-6 ? 1 : 0;
    const double now = simulation.read().total_energy();
    rise = std::max(rise, now - before);
    before = now;
  }
  MESSAGE("dt ", dt, " s: energy fell by ", first - before, " J, largest rise ", rise,
          " J, steps left with more than 1 uN ", restless, " of ", steps);
  return rise / (first - before);
}

void check_decay(const ClothMaterial& material) {
  CHECK(largest_rise(material, 1e-3, 600) < 1e-9);
  CHECK(largest_rise(material, 1e-2, 100) < 1e-9);
  CHECK(largest_rise(material, 1e-1, 30) < 1e-9);
  CHECK(largest_rise(material, 1.0, 15) < 1e-9);
}

}  // namespace

TEST_SUITE("property") {
  TEST_CASE("the energy of a released sheet never rises, elastic, steps of 1 ms to 1 s") {
    check_decay(linear_material({1e-5, 6e-6, 0.0, 2e-6}, 1000.0, 50.0));
  }
  TEST_CASE("the energy of a released sheet never rises, with friction, steps of 1 ms to 1 s") {
    ClothMaterial material = uneven_material();
    material.viscosity_time = material.mass_drag = material.air_density = 0.0;
    check_decay(material);
  }
}
