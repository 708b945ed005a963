// From the device's coordinates to the cloth's and back: scale, turn, clutch, and the gain of the force.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Workspace".
//
//   tool = cloth_centre + scale R (device - device_centre)      force on the device = gain R^T force
//
//   so a stiffness is felt gain * scale times what it is, and an energy gain / scale times.
#pragma once

#include "fuai/haptics/local_model_rt.h"

namespace fuai {

/// How device and cloth lie to each other.
struct WorkspaceMap {
  double scale = 1.0;       ///< metres of the tool to a metre of the device, > 0
  double force_gain = 1.0;  ///< newtons of the device to a newton of the cloth, > 0; shown and recorded
  Mat3 rotation = Mat3::Identity();   ///< from the device's axes to the cloth's
  Vec3 device_centre = Vec3::Zero();  ///< [m]
  Vec3 cloth_centre = Vec3::Zero();   ///< [m]

  /// Thread class of all: real-time.
  Vec3 to_tool(const Vec3& device) const noexcept {
    return cloth_centre + scale * (rotation * (device - device_centre));
  }
  Vec3 to_device(const Vec3& tool) const noexcept {
    return device_centre + rotation.transpose() * (tool - cloth_centre) / scale;
  }
  /// A direction with a length, such as a velocity.
  Vec3 way_to_tool(const Vec3& device) const noexcept { return scale * (rotation * device); }
  /// The model as the device feels it.
  LocalModel to_device(const LocalModel& model) const noexcept {
    LocalModel felt = model;
    const Mat3 back = rotation.transpose();
    felt.origin = to_device(model.origin);
    felt.origin_velocity = back * model.origin_velocity / scale;
    felt.force = force_gain * (back * model.force);
    felt.force_rate = force_gain * (back * model.force_rate);
    felt.stiffness = force_gain * scale * (back * model.stiffness * rotation);
    felt.damping = force_gain * scale * (back * model.damping * rotation);
    felt.trust_radius = model.trust_radius / scale;
    felt.stored_energy = force_gain / scale * model.stored_energy;
    return felt;
  }
  /// Moves the device's centre so that the tool stays where it is while the device has gone elsewhere: what a
  /// clutch does when it closes. @param tool where the tool stayed [m] @param device where the device is [m]
  void close_clutch(const Vec3& tool, const Vec3& device) noexcept {
    device_centre = device - rotation.transpose() * (tool - cloth_centre) / scale;
  }
};

}  // namespace fuai
