// A hand that lifts cloth, and brings it back or lets it go.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <memory>

#include "fuai/scenes/engine_scene.h"

namespace fuai {

/// The way of the one hand. Between its times it rises and comes back by smooth_rise().
struct LiftPath {
  Vec3 start = Vec3::Zero();                ///< where it grips, at time 0 [m]
  double height = 0.0;                      ///< how far it goes along the direction [m]
  Vec3 direction = Vec3::UnitZ();           ///< need not be a unit vector
  double begins = 0.0, ends = 1.0;          ///< of the way up [s]
  double back_begins = 0.0, back_ends = 0;  ///< of the way back [s]; none unless it ends after it begins
  double lets_go = std::numeric_limits<double>::infinity();  ///< [s]
  /// Of the cantilever along y whose tip is held [m]: keeping its length, the tip comes back by the integral
  /// of w'^2 / 2 = 3/5 lift^2 / length. 0: none.
  double cantilever = 0.0;
};

/// @throws Error (kUsage) unless the way up takes time. Thread class: set-up.
std::unique_ptr<const SceneMotion> make_lift_motion(const LiftPath& path);

}  // namespace fuai
