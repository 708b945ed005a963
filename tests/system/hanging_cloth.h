// Rectangles that hang from their top row, and a hand that moves about.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "fuai/sim/simulation.h"
#include "system/linear_cloth.h"

namespace fuai_test {

inline constexpr double kArealMass = 0.15;  ///< of all hanging cloths [kg/m2]

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
      : start_(start), at_(start), goal_(start), half_side_(half_side), speed_(speed), rest_(rest),
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
