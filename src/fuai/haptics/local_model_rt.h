// What a hand feels, as a straight line about where it was: evaluated at the device's rate while the cloth
// takes its time.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Local model"; Astley and Hayward 1998 (a slow simulation seen as a
// force and a tangent), Barbic and James 2007.
//
//   with tau = min(t - time, horizon):
//   d = x - (origin + tau origin_velocity), cut to the trust radius
//   F = force + tau force_rate - stiffness d - damping (v - origin_velocity)
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "fuai/core/types.h"

namespace fuai {

/// What passed through the port between hand and program so far; goes with the pose to the cloth and comes
/// back with the model, so that energies of the same moment are compared.
struct PortLedger {
  double work = 0.0;  ///< that the hand put in [J]
  double leak = 0.0;  ///< of it, what sampling lost; see passivity_rt.h [J]
};

/// Where the tool is: what the cloth is told about the hand.
struct ToolPose {
  double time = 0.0;             ///< [s]
  Vec3 position = Vec3::Zero();  ///< in the cloth's coordinates [m]
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  bool holds = false;            ///< the hand wants to hold cloth
  PortLedger ledger;
};

/// The cloth's answer. Positions and forces are the cloth's until a WorkspaceMap has turned them into the
/// device's.
struct LocalModel {
  std::uint64_t number = 0;             ///< counts from 1; 0: there was none yet
  double time = 0.0;                    ///< of the pose that it answers [s]
  bool grasped = false;                 ///< there is cloth in the hand
  Vec3 origin = Vec3::Zero();           ///< position of the pose [m]
  Vec3 origin_velocity = Vec3::Zero();  ///< with which the hand was expected to go on [m/s]
  Vec3 force = Vec3::Zero();            ///< on the hand at the origin [N]
  Vec3 force_rate = Vec3::Zero();       ///< while the hand goes on as expected [N/s]
  Mat3 stiffness = Mat3::Zero();        ///< symmetric, no negative eigenvalue [N/m]
  Mat3 damping = Mat3::Zero();          ///< the same [N s/m]
  double trust_radius = std::numeric_limits<double>::infinity();  ///< beyond it the spring's force stays [m]
  double horizon = 0.0;  ///< beyond this age the prediction stays [s]
  /// In the cloth at `time`: free, kinetic, weight and the hold's springs [J]; not a number when not known.
  double stored_energy = std::numeric_limits<double>::quiet_NaN();
  PortLedger ledger;  ///< of the pose
};

/// Where the model expects the hand at a time [m]. Thread class: real-time.
inline Vec3 expected_position(const LocalModel& model, double time) noexcept {
  const double tau = std::min(std::max(time - model.time, 0.0), model.horizon);
  return model.origin + tau * model.origin_velocity;
}

/// Whether a position lies where the straight line is to be trusted. Thread class: real-time.
inline bool is_trusted(const LocalModel& model, const Vec3& position, double time) noexcept {
  return (position - expected_position(model, time)).norm() <= model.trust_radius;
}

/// Force on the hand [N]. @param position [m] @param velocity [m/s] @param time [s]. Thread class: real-time.
inline Vec3 model_force(const LocalModel& model, const Vec3& position, const Vec3& velocity,
                        double time) noexcept {
  const double tau = std::min(std::max(time - model.time, 0.0), model.horizon);
  Vec3 d = position - expected_position(model, time);
  const double far = d.norm();
  if (far > model.trust_radius) d *= model.trust_radius / far;
  return model.force + tau * model.force_rate - model.stiffness * d -
         model.damping * (velocity - model.origin_velocity);
}

/// Whether every number of it is one; stored_energy and trust_radius may not be. Thread class: real-time.
bool is_finite(const LocalModel& model) noexcept;

/// The nearest symmetric matrix without negative eigenvalues and with none above `most`. A matrix that is not
/// finite becomes zero. Thread class: real-time.
Mat3 make_passive(const Mat3& matrix, double most) noexcept;

}  // namespace fuai
