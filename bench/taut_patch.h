// The cloth and the taut patch that the speed and the accuracy of the engine are measured on.
// SPDX-License-Identifier: Apache-2.0
// Source: the laws and numbers of a 0.15 kg/m2 suiting with LT 0.7, EMT 5 % at 500 gf/cm, G 1 gf/(cm deg),
// 2HG 1.5 gf/cm, B 1e-5 N m, 2HB 0.05 gf cm/cm.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/scenes/engine_scene.h"
#include "fuai/solver/cloth_material.h"
#include "fuai/solver/explicit.h"
#include "fuai/solver/implicit.h"

namespace fuai_bench {

inline constexpr double kSpacing = 0.01;    ///< [m]
inline constexpr double kArealMass = 0.15;  ///< [kg/m2]
inline constexpr double kTick = 1e-3;       ///< [s]

/// Tension k0 e + k1 max(e, 0)^2, straight beyond 5 %; shear and bending straight with friction of one play
/// element; viscosity and mass-proportional drag; no twist, no air. Thread class: set-up.
fuai::ClothMaterial bench_material();

/// A square of side x side nodes with single nodes held. @param held slots. Thread class: set-up.
fuai::ClothModel bench_square(int side, const std::vector<int>& held);

/// Held at the two corners of the top row. Thread class: set-up.
fuai::ClothModel two_corner_square(int side);

/// Their hash in hexadecimal digits. Thread class: any.
std::string hash_of(const std::vector<fuai::Vec3>& positions);

/// The scene taut_patch of the catalogue in the cloth of the benches, at rest at first: its sheet, clamp and
/// pull, but one node, the middle of the bottom row, moved instead of a fingertip, so that the force has no
/// spring in it.
struct TautPatch {
  fuai::ClothModel model;
  fuai::ClothMaterial material;
  int grasp = 0;           ///< slot
  fuai::ClothState start;  ///< hanging at rest, the grasp held where it hangs
  std::unique_ptr<const fuai::SceneMotion> motion;

  /// Where the grasp is at a time after the start [m].
  fuai::Vec3 target(double time) const;
};

/// Lets the cloth come to rest with the converged implicit step. @param spacing [m]. Thread class: set-up.
TautPatch make_taut_patch(int side, double spacing = kSpacing);

/// The explicit oracle on a patch, which must outlive it. Thread class: set-up.
class PatchOracle {
 public:
  PatchOracle(const TautPatch& patch, int substeps);
  /// Does tick `number`, the first of which is 1; the force of the cloth on the grasp at its end [N].
  fuai::Vec3 tick(int number);

 private:
  const TautPatch& patch_;
  fuai::ExplicitOptions options_;
  fuai::SolverExplicit solver_;
  fuai::ClothState state_;
  std::vector<fuai::Vec3> held_;
  std::size_t grasp_ = 0;
};
/// Substeps of a tick that are just stable.
int stable_substeps(const TautPatch& patch);

/// The implicit step on a patch, which must outlive it. Thread class: set-up.
template <class T>
class PatchStep {
 public:
  PatchStep(const TautPatch& patch, const fuai::ImplicitOptions& options)
      : patch_(patch), solver_(patch.model, patch.material, options) {
    solver_.restore(patch.start);
  }
  /// As the oracle's. @param report of the step, unless null
  fuai::Vec3 tick(int number, fuai::StepReport* report = nullptr) {
    solver_.place(patch_.grasp, patch_.target(number * kTick));
    const fuai::StepReport done = solver_.step(kTick);
    if (report != nullptr) *report = done;
    return solver_.force_on_fixed(patch_.grasp);
  }

 private:
  const TautPatch& patch_;
  fuai::SolverImplicit<T> solver_;
};

/// Root of the mean square of |F - F_ref| over that of |F_ref|, from 0.1 s on, when the grasp has set off;
/// not finite when the forces are not. Thread class: any.
double force_error(const std::vector<fuai::Vec3>& forces, const std::vector<fuai::Vec3>& reference);

}  // namespace fuai_bench
