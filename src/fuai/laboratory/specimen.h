// A rectangle of cloth between two clamps, as the strip testers hold it, at rest.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/virtual-kes.md, "Specimen".
//
//              width
//          +-----------+        moving clamp: turns, shifts, or pulls with a given force
//          |           |   ^ along: the yarns that are tested
//   length |   cloth   |   |
//          |           |   +--> across
//          +-----------+        fixed clamp
//
//   Both clamps hold two spacings of cloth and end exactly on a line of the lattice.
#pragma once

#include <functional>

#include "fuai/cloth/cloth_model.h"
#include "fuai/fabric/laws.h"
#include "fuai/solver/static.h"

namespace fuai {

/// What is cut and how it may move.
struct SpecimenSpec {
  Direction along = Direction::kWarp;  ///< yarns from clamp to clamp: warp or weft
  double length = 0.05;                ///< between the clamps [m]
  double width = 0.2;                  ///< [m]
  double spacing = 0.005;              ///< h [m]; must divide the length into at least two parts
  bool bends = false;           ///< false: stays in its plane; true: moves along and out of the plane instead
  Vec3 gravity = Vec3::Zero();  ///< [m/s2]
};

/// The specimen in its instrument.
class Specimen {
 public:
  /// @throws Error (kUsage) for the bias direction or sizes that make no specimen. Thread class: set-up.
  Specimen(const FabricLaws& laws, const SpecimenSpec& spec);

  const SpecimenSpec& spec() const noexcept { return spec_; }
  const Vec3& along() const noexcept { return along_; }
  const Vec3& across() const noexcept { return across_; }
  /// Axis about which a positive turn of the moving clamp bends the cloth toward its face.
  Vec3 bend_axis() const { return Vec3(along_.y(), -along_.x(), 0.0); }

  /// Lets the moving clamp go along a direction until the cloth pulls on it with `force` [N].
  void pull(const Vec3& direction, double force) { solver_.set_freedom(moving_, direction, force); }
  /// Ends all pulls: the moving clamp stays where they brought it.
  void hold() { solver_.hold(moving_); }
  void set_gravity(const Vec3& gravity) { solver_.set_gravity(gravity); }
  /// Turns and shifts the moving clamp and lets the cloth come to rest; nothing is committed.
  StaticReport settle(const Mat3& rotation, const Vec3& shift);
  /// The same for a specimen that bends and whose moving clamp is free along it and out of its plane: the
  /// clamp is turned by `change` [rad] more than at the last commit; every segment of the yarns starts turned
  /// by its share.
  StaticReport settle_turned(const Mat3& rotation, double change);
  /// The next settle() starts from the slots raised to this height [m] over their flat places. @param height
  /// of the share of the way from the fixed clamp to the moving one
  void raise(const std::function<double(double)>& height);
  void commit() { solver_.commit(); }
  void roll_back() { solver_.roll_back(); }

  /// Force, moment and place of the moving clamp: what the cloth puts on it.
  ClampReading moving() const { return solver_.read(moving_); }
  ClampReading fixed() const { return solver_.read(fixed_); }

  const ClothModel& model() const noexcept { return solver_.model(); }
  const ClothState& state() const noexcept { return solver_.state(); }
  int iterations() const noexcept { return solver_.iterations(); }

 private:
  SpecimenSpec spec_;
  Vec3 along_, across_;
  SolverStatic solver_;
  std::size_t fixed_ = 0, moving_ = 0;
};

}  // namespace fuai
