// Rectangles that hang from their top row, and a hand that moves about.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "fuai/sim/simulation.h"
#include "system/linear_cloth.h"

namespace fuai_test {

inline constexpr double kArealMass = 0.15;  ///< of all hanging cloths [kg/m2]

/// F = k x with one play element that sticks with `stick` and slips at `friction`.
inline fuai::PlayLaw one_play_law(double k, double stick, double friction, double range) {
  const std::vector<double> elastic{-k * range, 0.0, k * range}, width(3, friction);
  const std::vector<fuai::PlayElement> play{{friction / stick, 1.0}};
  return fuai::make_play_law(fuai::make_curve_table(-range, range, elastic),
                             fuai::make_curve_table(-range, range, width, fuai::constant_outside()), play);
}

/// The suiting of the solver study, which the figures of the taut patch and of bending were stated for: LT
/// 0.7, EMT 5 % at 500 gf/cm, G 1 gf/(cm deg), 2HG 1.5 gf/cm, B 1e-5 N m, 2HB 0.05 gf cm/cm; no twist, no
/// air.
inline fuai::ClothMaterial suiting() {
  fuai::ClothMaterial m;
  m.weft_tension = m.warp_tension = fuai::make_tensile_law(0.7, 1.0, 0.05, 500.0 * fuai::unit::kGfPerCm);
  m.shear = one_play_law(56.0, 84.0, 0.74, fuai::kes_shear_range());
  m.weft_bending = m.warp_bending = one_play_law(1e-5, 1.6e-5, 2.45e-4, fuai::kKesBendingRange);
  m.air_density = 0.0;
  return m;
}

/// columns x rows slots, the top row (the last) fixed.
inline fuai::ClothModel hanging_model(int columns, int rows, double spacing) {
  fuai::ClothPieceSpec spec;
  spec.outline = fuai::make_rectangle_outline((columns - 1) * spacing, (rows - 1) * spacing);
  spec.spacing = spacing;
  spec.areal_mass = kArealMass;
  fuai::ClothModel model = fuai::make_cloth_model(spec);
  for (int column = 0; column < columns; ++column)
    model.fixed[static_cast<Index>(model.slot(column, rows - 1))] = 1;
  return model;
}

/// Upright in the plane y = 0, the top at z = 0, without tension.
inline fuai::ClothState upright_state(const fuai::ClothModel& model) {
  fuai::ClothState state = fuai::make_cloth_state(model);
  const double top = (model.rows - 1) * model.spacing;
  for (fuai::Vec3& x : state.positions) x = fuai::Vec3(x.x(), 0.0, x.y() - top);
  return state;
}

/// Straight lines at a given speed to random points of a cube about its start, with a rest at each.
class ZigZag {
 public:
  ZigZag(const fuai::Vec3& start, double half_side, double speed, double rest, unsigned seed)
      : start_(start),
        at_(start),
        goal_(start),
        half_side_(half_side),
        speed_(speed),
        rest_(rest),
        random_(seed) {}

  const fuai::Vec3& move(double dt) {
    const fuai::Vec3 way = goal_ - at_;
    if (way.norm() > speed_ * dt) return at_ += speed_ * dt * way.normalized();
    at_ = goal_;
    waited_ += dt;
    if (waited_ >= rest_) {
      std::uniform_real_distribution<double> side(-half_side_, half_side_);
      const double x = side(random_), y = side(random_), z = side(random_);
      goal_ = start_ + fuai::Vec3(x, y, z);
      waited_ = 0.0;
    }
    return at_;
  }

 private:
  fuai::Vec3 start_, at_, goal_;
  double half_side_, speed_, rest_, waited_ = 0.0;
  std::mt19937 random_;
};

}  // namespace fuai_test
