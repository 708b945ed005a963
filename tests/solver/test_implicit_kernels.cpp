// The vector kernels against the reference energies, and the linearisation against both.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "fuai/solver/cloth_energy.h"
#include "fuai/solver/implicit_kernels.h"
#include "fuai/solver/implicit_storage.h"
#include "support/small_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr double kH = 0.01, kDt = 1e-3;

/// Every term of uneven_material() with laws of straight pieces, which a LawTable holds exactly.
ClothMaterial straight_material() {
  ClothMaterial m = uneven_material();
  m.weft_bending = straight_law(6e-6, 1e-4, 250.0);
  m.warp_bending = straight_law(9e-6, 2e-4, 250.0);
  m.shear = straight_law(46.0, 0.7, 0.14);
  m.weft_tension = straight_law(1500.0, 3.0, 0.05);
  m.warp_tension = straight_law(900.0, 2.0, 0.05);
  return m;
}

/// Arrays of a state at trial positions, without inertia and weight: the force is the internal one.
template <class T>
struct Kernels {
  ImplicitStorage<T> storage;
  ImplicitGrid<T> g;
  ImplicitStepConstants<T> step;
  const ImplicitKernels<T>& k = implicit_kernels<T>();

  Kernels(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
          const std::vector<Vec3>& positions)
      : storage(model, material, implicit_kernels<T>().lanes), g(storage.grid()) {
    step.dt = static_cast<T>(kDt);
    step.inverse_dt = static_cast<T>(1.0 / kDt);
    fill(model, material, state, state.positions);
    k.evaluate(g, storage.constants(), step, Evaluation::kForces, 0, g.rows);
    for (int row = 0; row < g.rows; ++row) {  // strains at x_n
      for (int c = 0; c < g.columns; ++c) {
        g.weft_strain_n[g.index(c, row)] = g.strain[3][g.index(c, row)];
        g.warp_strain_n[g.index(c, row)] = g.strain[4][g.index(c, row)];
      }
    }
    fill(model, material, state, positions);
  }
  void fill(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
            const std::vector<Vec3>& positions) {
    const auto give = [](T* const* to, const PlayLaw& law, const PlayState& from, std::ptrdiff_t p) {
      for (Index j = 0; j < law.elements().size(); ++j) to[j][p] = static_cast<T>(from.position[j]);
    };
    for (int row = 0; row < model.rows; ++row) {
      for (int c = 0; c < model.columns; ++c) {
        const auto i = static_cast<Index>(model.slot(c, row));
        const std::ptrdiff_t p = g.index(c, row);
        g.x.x[p] = static_cast<T>(positions[i].x());
        g.x.y[p] = static_cast<T>(positions[i].y());
        g.x.z[p] = static_cast<T>(positions[i].z());
        give(g.memory_weft_bending, material.weft_bending, state.weft_bending[i], p);
        give(g.memory_warp_bending, material.warp_bending, state.warp_bending[i], p);
        give(g.memory_shear, material.shear, state.shear[i], p);
        give(g.memory_weft_tension, material.weft_tension, state.weft_tension[i], p);
        give(g.memory_warp_tension, material.warp_tension, state.warp_tension[i], p);
      }
    }
  }
  Vec3 force(int column, int row) const {
    const std::ptrdiff_t p = g.index(column, row);
    return {static_cast<double>(g.force.x[p]), static_cast<double>(g.force.y[p]),
            static_cast<double>(g.force.z[p])};
  }
};

struct Scene {
  ClothModel model = sheet_model(21, 19, kH, 0.15, {2 + 21 * 3, 3 + 21 * 3, 20 + 21 * 18});
  ClothState state;
  std::vector<Vec3> trial;
  Scene(const ClothMaterial& material, double amplitude) {
    std::mt19937 random(7);
    state = flat_state(model);
    // Bent to a wavy shape, so that no term is small by symmetry.
    for (Vec3& x : state.positions) x.z() = 0.02 * std::sin(40.0 * x.x() + 25.0 * x.y());
    std::vector<Vec3> shape = state.positions;
    jitter(shape, amplitude, random);
    commit_cloth(model, material, shape, state);
    trial = state.positions;
    jitter(trial, amplitude, random);
  }
};

template <class T>
double force_difference(const ClothMaterial& material) {
  Scene scene(material, 0.02 * kH);
  std::vector<Vec3> reference(static_cast<Index>(scene.model.slot_count()));
  evaluate_cloth(scene.model, material, scene.state, scene.trial, {kDt, Vec3::Zero()}, reference);
  Kernels<T> kernels(scene.model, material, scene.state, scene.trial);
  kernels.k.evaluate(kernels.g, kernels.storage.constants(), kernels.step, Evaluation::kForces, 0,
                     kernels.g.rows);
  double largest = 0.0, difference = 0.0;
  for (int row = 0; row < scene.model.rows; ++row) {
    for (int c = 0; c < scene.model.columns; ++c) {
      const Vec3& f = reference[static_cast<Index>(scene.model.slot(c, row))];
      largest = std::max(largest, f.norm());
      difference = std::max(difference, (f - kernels.force(c, row)).norm());
    }
  }
  return difference / largest;
}

ClothMaterial without_air(ClothMaterial m) {
  m.air_normal = m.air_tangential = 0.0;
  return m;
}

}  // namespace

TEST_SUITE("crosscheck") {
  TEST_CASE("forces of the kernels are those of the reference") {
    // Straight laws: nothing but rounding. Curved laws: the straight pieces of the table.
    CHECK(force_difference<double>(without_air(straight_material())) < 1e-11);
    CHECK(force_difference<float>(without_air(straight_material())) < 2e-3);
    CHECK(force_difference<double>(without_air(uneven_material())) < 1e-4);
    MESSAGE(implicit_kernels<float>().target
            << " double straight " << force_difference<double>(without_air(straight_material()))
            << " float straight " << force_difference<float>(without_air(straight_material()))
            << " double curved " << force_difference<double>(without_air(uneven_material())));
  }
}
