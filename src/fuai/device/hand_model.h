// Simulated hands: how heavy, damped and stiff they hold a device, and where they want to go.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/haptics.md, "Hands": models of van Beek et al. 2015 and Yokokohji and Yoshikawa 1994, a range
// of Hajian and Howe 1997.
//
//   force of the hand on the device   k (x_target - x) + b (x_target' - x'), its mass moves with the device
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "fuai/core/types.h"

namespace fuai {

/// A hand's impedance.
struct HandModel {
  std::string_view name;
  double mass = 0.0;       ///< [kg]
  double damping = 0.0;    ///< [N s/m]
  double stiffness = 0.0;  ///< [N/m]
};

/// The hands that everything is tried with, from none (the worst case for stability) to heavy.
/// Thread class: any.
std::span<const HandModel> hand_models() noexcept;
/// @throws Error (kUsage) with all names for a hand that does not exist. Thread class: set-up.
const HandModel& find_hand_model(std::string_view name);

/// Where a hand wants to be.
struct HandTarget {
  Vec3 position = Vec3::Zero();  ///< [m]
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
};

/// A pure function of time. Thread class: real-time.
class HandMotion {
 public:
  virtual ~HandMotion() = default;
  /// @param time [s]
  virtual HandTarget at(double time) const noexcept = 0;
};

/// When a motion takes place [s].
struct HandTimes {
  double begins = 0.0, ends = 1.0;
};

/// Stays. Thread class: set-up.
std::unique_ptr<const HandMotion> make_still_motion(const Vec3& position);
/// Goes by `way` and comes back, each way one of least jerk and half of the time; the path is closed.
std::unique_ptr<const HandMotion> make_reach_motion(const Vec3& start, const Vec3& way, HandTimes times);
/// Swings between start and start + way, its rate rising in proportion to time from `slow` to `fast` [Hz];
/// sets off and ends at rest at the start.
std::unique_ptr<const HandMotion> make_chirp_motion(const Vec3& start, const Vec3& way, HandTimes times,
                                                    double slow, double fast);
/// At start + way until `times.begins`, then at once at the start: a spring let go.
std::unique_ptr<const HandMotion> make_release_motion(const Vec3& start, const Vec3& way, double time);
/// A recorded path, straight between its points. @param points [m], not empty @param step of time [s]
std::unique_ptr<const HandMotion> make_path_motion(std::vector<Vec3> points, double step);

}  // namespace fuai
