// Forces that a hand feels: against the mesh, against the converged step, in single and double precision.
// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "fuai/scenes/engine_scenes.h"
#include "support/linear_laws.h"
#include "system/hanging_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

/// Every step solved to the end.
ImplicitOptions converged() {
  ImplicitOptions options;
  options.iterations = 300;
  options.linearisations = 40;
  options.relinearise = 1e-8;
  options.reduction = 1e-3;
  options.tolerance = 1e-9;
  return options;
}

/// A square of 16 cm, its far edge clamped, no gravity, pulled 4 mm away from the clamp by a hold 2 cm from
/// the near edge. @return the force [N]
double pull(double spacing, double radius) {
  const int side = static_cast<int>(std::lround(0.16 / spacing)) + 1;
  const ClothModel model = hanging_model(side, side, spacing);
  SimulationOptions options;
  options.implicit = converged();
  options.implicit.gravity = Vec3::Zero();
  const ClothMaterial material = suiting();
  Simulation<double> simulation(model, material, options);
  simulation.restore(make_cloth_state(model));
  GraspSpec spec;
  spec.centre = Vec2(0.08, 0.02);
  spec.radius = radius;
  spec.most_force = 1e3;
  const Vec3 start(0.08, 0.02, 0.0);
  const int hold = simulation.grasp(spec, start);
  // Slow steps: each a static solve but for the friction, which follows the path.
  constexpr int kSteps = 20;
  double residual = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    simulation.move_grasp(hold, start - Vec3(0.0, 0.004 * i / kSteps, 0.0));
    residual = simulation.step(1.0).residual;
  }
  for (int i = 0; i < 5; ++i) residual = simulation.step(1.0).residual;
  const double force = simulation.grasp_reading(hold).force.norm();
  MESSAGE(std::string(radius > 0.0 ? "patch" : "single slot"), ", ", 1e3 * spacing, " mm: ", force,
          " N, residual ", residual, " N");
  return force;
}

/// The bending scene: 17 x 17 at 1 cm, two rows clamped, no gravity, the middle of the free edge lifted by 4
/// cm in a second and brought back. @return forces on the hand [N], one a tick
template <class T>
std::vector<Vec3> bending_forces(const ClothMaterial& material, const ImplicitOptions& implicit) {
  EngineScene scene = make_bending(linear_laws(0.1, 0.02, 150.0));
  scene.material = material;
  scene.options.implicit = implicit;
  scene.options.implicit.gravity = Vec3::Zero();
  SceneRunner<T> runner(scene);
  std::vector<Vec3> forces;
  for (int i = 0; i < 2000; ++i) {
    runner.step(1e-3);
    forces.push_back(runner.hand_reading(0).force);
  }
  return forces;
}

double rms(const std::vector<Vec3>& forces, const std::vector<Vec3>& less = {}) {
  double sum = 0.0;
  for (std::size_t i = 0; i < forces.size(); ++i)
    sum += (less.empty() ? forces[i] : Vec3(forces[i] - less[i])).squaredNorm();
  return std::sqrt(sum / static_cast<double>(forces.size()));
}

}  // namespace

TEST_SUITE("convergence") {
  TEST_CASE("the force of a patch has a limit on finer cloth, that of a single slot has none") {
    const double coarse = pull(0.01, 0.009), middle = pull(0.005, 0.009), fine = pull(0.0025, 0.009);
    MESSAGE("patch, 10 to 5 mm: ", 100.0 * (middle / coarse - 1.0),
            " %, 5 to 2.5 mm: ", 100.0 * (fine / middle - 1.0), " %");
    CHECK(std::abs(fine / middle - 1.0) < 0.02);
    const double one_coarse = pull(0.01, 0.0), one_middle = pull(0.005, 0.0), one_fine = pull(0.0025, 0.0);
    MESSAGE("single slot, 10 to 5 mm: ", 100.0 * (one_middle / one_coarse - 1.0),
            " %, 5 to 2.5 mm: ", 100.0 * (one_fine / one_middle - 1.0), " %");
    CHECK(one_fine < 0.95 * one_middle);
    CHECK(one_middle < 0.95 * one_coarse);
  }
}

TEST_SUITE("crosscheck") {
  TEST_CASE(
      "the force of bending: eight iterations within 1 % and float within 0.1 % of the converged step") {
    ImplicitOptions usual, most = converged();
    usual.iterations = 8;
    most.tolerance = 0.0;
    most.linearisations = 6;
    most.noise_floor = 0.0;
    for (const bool uneven : {false, true}) {
      CAPTURE(uneven);
      const ClothMaterial material = uneven ? uneven_material() : suiting();
      const std::vector<Vec3> reference = bending_forces<double>(material, converged());
      const double size = rms(reference);
      const double fast = rms(bending_forces<double>(material, usual), reference) / size;
      const double fast_float = rms(bending_forces<float>(material, usual), reference) / size;
      const double most_float = rms(bending_forces<float>(material, most), reference) / size;
      MESSAGE("bending, ", std::string(uneven ? "every term" : "suiting"), ": ", 1e3 * size,
              " mN rms; 8 iterations in double ", 100.0 * fast, " %, in float ", 100.0 * fast_float,
              " %; converged float ", 100.0 * most_float, " %");
      CHECK(fast < 0.01);
      CHECK(fast_float < 0.01);
      CHECK(most_float < 0.001);
    }
  }
}
