// A linear elastic material, and how its trials are solved and compared.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "fuai/cloth/cloth_piece.h"
#include "fuai/solver/equilibrium.h"
#include "support/small_cloth.h"

namespace fuai_test {

/// The constants of an orthotropic plate [N m].
struct Plate {
  double weft = 0.0, warp = 0.0;  ///< B1, B2
  double poisson = 0.0;           ///< B12
  double twist = 0.0;             ///< Bt
};

/// No friction, losses or air; k and G [N/m].
inline fuai::ClothMaterial linear_material(const Plate& plate, double tension, double shear) {
  fuai::ClothMaterial material;
  const double sharp = 1e4;  // curvature range [1/m], beyond all trials
  material.weft_bending = straight_law(plate.weft, 0.0, sharp);
  material.warp_bending = straight_law(plate.warp, 0.0, sharp);
  material.poisson_bending = plate.poisson;
  material.twist_stiffness = plate.twist;
  material.shear = straight_law(shear, 0.0, 0.14);
  material.weft_tension = material.warp_tension = straight_law(tension, 0.0, 0.5);
  material.viscosity_time = material.mass_drag = material.air_density = 0.0;
  return material;
}

/// Small deflections under gravity `g`: one long step after another, each solved almost exactly.
inline fuai::EquilibriumOptions small_deflection(double g) {
  fuai::EquilibriumOptions options;
  options.gravity = fuai::Vec3(0.0, 0.0, -g);
  options.least_force = 0.0;
  options.first_dt = 1e3;  // as good as static at once
  options.iterations = 3000;
  options.reduction = 1e-4;
  options.largest_move = 1e9;  // no limit: the problem is linear
  options.most_steps = 60;
  return options;
}

/// Slope of log |error| over log h, h halving from one entry to the next: least squares.
inline double convergence_order(const std::vector<double>& errors) {
  const double middle = 0.5 * static_cast<double>(errors.size() - 1);
  double up = 0.0, down = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double at = static_cast<double>(i) - middle;
    up -= at * std::log2(std::abs(errors[i]));
    down += at * at;
  }
  return up / down;
}

}  // namespace fuai_test
