// Builds the cloth of the benches and the taut patch.
// SPDX-License-Identifier: Apache-2.0
#include "taut_patch.h"

#include <array>
#include <cmath>
#include <utility>

#include "fuai/cloth/cloth_piece.h"
#include "fuai/core/hash.h"
#include "fuai/fabric/curve_table.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/scenes/engine_scenes.h"

namespace fuai_bench {
namespace {

using namespace fuai;

constexpr double kToe = 980.0, kGrowth = 1.764e5, kStraightFrom = 0.05;              // [N/m], [N/m], [-]
constexpr double kShearStiffness = 56.0, kShearStick = 84.0, kShearFriction = 0.74;  // [N/m]
constexpr double kBendingStiffness = 1e-5, kBendingStick = 1.6e-5, kBendingFriction = 2.45e-4;  // [N m], [N]

constexpr double kIgnored = 0.1;  ///< the grasp sets off [s]

/// F = k x with one play element that sticks with `stick` and slips at `friction`.
PlayLaw straight_law(double k, double stick, double friction, double range) {
  const std::array<double, 3> elastic{-k * range, 0.0, k * range}, width{friction, friction, friction};
  const std::array<PlayElement, 1> play{{{friction / stick, 1.0}}};
  return make_play_law(make_curve_table(-range, range, elastic),
                       make_curve_table(-range, range, width, constant_outside()), play);
}

PlayLaw tension_law() {
  constexpr int kCells = 200;
  std::vector<double> stress;
  for (int i = 0; i <= kCells; ++i) {
    const double e = kStraightFrom * (2.0 * i / kCells - 1.0), stretch = std::max(e, 0.0);
    stress.push_back(kToe * e + kGrowth * stretch * stretch);
  }
  Extrapolation outside;
  outside.slope_low = kToe;
  outside.slope_high = kToe + 2.0 * kGrowth * kStraightFrom;
  outside.slopes_given = true;
  // A law needs a play element: this one has no strength.
  const std::array<double, 2> no_friction{0.0, 0.0};
  const std::array<PlayElement, 1> play{{{kStraightFrom, 1.0}}};
  return make_play_law(make_curve_table(-kStraightFrom, kStraightFrom, stress, outside),
                       make_curve_table(-kStraightFrom, kStraightFrom, no_friction, constant_outside()),
                       play);
}

}  // namespace

ClothMaterial bench_material() {
  ClothMaterial m;
  m.weft_tension = m.warp_tension = tension_law();
  m.shear = straight_law(kShearStiffness, kShearStick, kShearFriction, kes_shear_range());
  m.weft_bending = m.warp_bending =
      straight_law(kBendingStiffness, kBendingStick, kBendingFriction, kKesBendingRange);
  m.viscosity_time = 5e-5;
  m.mass_drag = 1.5;
  m.air_density = 0.0;
  return m;
}

ClothModel bench_square(int side, const std::vector<int>& held) {
  const double length = (side - 1) * kSpacing;
  ClothPieceSpec spec;
  spec.outline = {{0.0, 0.0}, {length, 0.0}, {length, length}, {0.0, length}};
  spec.spacing = kSpacing;
  spec.areal_mass = kArealMass;
  ClothModel model = make_cloth_model(spec);
  for (int slot : held) model.fixed[static_cast<std::size_t>(slot)] = 1;
  return model;
}

ClothModel two_corner_square(int side) { return bench_square(side, {side * (side - 1), side * side - 1}); }

Vec3 TautPatch::target(double time) const {
  return start.positions[static_cast<std::size_t>(grasp)] +
         (motion->hand(0, time).position - motion->hand(0, 0.0).position);
}

std::string hash_of(const std::vector<Vec3>& positions) {
  StateHash hash;
  for (const Vec3& x : positions) hash.add(x.data(), 3 * sizeof(double));
  return hash.hex();
}

TautPatch make_taut_patch(int side, double spacing) {
  FabricLaws laws;  // the scene's own material is not used
  laws.areal_mass = kArealMass;
  EngineScene scene = fuai::make_taut_patch(laws, {side, spacing});
  TautPatch patch;
  patch.material = bench_material();
  patch.grasp = side / 2;
  patch.model = std::move(scene.model);
  patch.start = std::move(scene.start);
  patch.motion = std::move(scene.motion);
  // Long steps damp the swing away.
  ImplicitOptions options;
  options.iterations = 100;
  options.linearisations = 8;
  options.relinearise = 1e-3;
  const auto settle = [&](int steps, double dt) {
    SolverImplicit<double> solver(patch.model, patch.material, options);
    solver.restore(patch.start);
    for (int i = 0; i < steps; ++i) solver.step(dt);
    solver.save(patch.start);
    for (auto* field : {&patch.start.velocities, &patch.start.accelerations})
      for (Vec3& v : *field) v.setZero();
  };
  settle(200, 0.01);
  patch.model.fixed[static_cast<std::size_t>(patch.grasp)] = 1;
  patch.start.time = 0.0;
  return patch;
}

PatchOracle::PatchOracle(const TautPatch& patch, int substeps) : patch_(patch), state_(patch.start) {
  options_.substeps = substeps;
  solver_.prepare(patch.model, patch.material, options_);
  for (int slot : solver_.fixed_slots()) {
    if (slot == patch.grasp) grasp_ = held_.size();
    held_.push_back(state_.positions[static_cast<std::size_t>(slot)]);
  }
}

Vec3 PatchOracle::tick(int number) {
  held_[grasp_] = patch_.target(number * kTick);
  solver_.step(state_, kTick, held_);
  const auto slot = static_cast<std::size_t>(patch_.grasp);
  return solver_.internal_forces()[slot] +
         patch_.model.areal_mass * patch_.model.node_area[slot] * options_.gravity;
}

int stable_substeps(const TautPatch& patch) {
  return static_cast<int>(std::ceil(kTick / stable_substep(patch.model, patch.material)));
}

double force_error(const std::vector<Vec3>& forces, const std::vector<Vec3>& reference) {
  double difference = 0.0, size = 0.0;
  for (auto i = static_cast<std::size_t>(kIgnored / kTick); i < reference.size(); ++i) {
    difference += (forces[i] - reference[i]).squaredNorm();
    size += reference[i].squaredNorm();
  }
  return std::sqrt(difference / size);
}

}  // namespace fuai_bench
