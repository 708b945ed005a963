// A camera that orbits a point: turned, moved and zoomed by the mouse, never upside down.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/core/types.h"
#include "fuai/picture/cloth_picture.h"

namespace fuai {

/// A line of sight.
struct Ray {
  Vec3 origin = Vec3::Zero();      ///< [m]
  Vec3 direction = Vec3::UnitX();  ///< unit vector away from the eye
};

/// The camera of the window. Thread class: any.
class OrbitCamera {
 public:
  /// Sees the whole of `bounds`. @param azimuth, elevation as frame_camera() takes them [rad]
  /// @param right_strip part of the width that panels cover at the right
  void frame(const Bounds& bounds, double azimuth, double elevation, double aspect, double right_strip = 0.0);

  /// Turns by a movement of the mouse; a drag across the height turns by half a turn. The elevation stays a
  /// little short of straight up and down. @param move [pixel], y downward @param height of the view [pixel]
  void orbit(const Vec2& move, double height) noexcept;
  /// Moves sideways, so that what lies at the target's depth stays under the cursor.
  void pan(const Vec2& move, double height) noexcept;
  /// Goes nearer (notches > 0) or farther; what the cursor is at stays under it, at the target's depth.
  /// @param place of the cursor: -1 to 1 from left to right and from bottom to top @param aspect of the view
  void zoom(double notches, const Vec2& place, double aspect) noexcept;
  /// Goes so many times nearer to the target, within the limits of zoom(). @param times above 0
  void approach(double times) noexcept;
  /// Looks at another point from the same direction and distance. @param point [m]
  void look_at(const Vec3& point) noexcept { target_ = point; }

  /// For the painter.
  Camera camera() const;
  /// Line of sight through a place of the view. @param place -1 to 1 from left to right and from bottom to
  /// top
  Ray ray(const Vec2& place, double aspect) const;
  /// Away from the eye.
  Vec3 forward() const noexcept;
  const Vec3& target() const noexcept { return target_; }
  double distance() const noexcept { return distance_; }
  double azimuth() const noexcept { return azimuth_; }
  double elevation() const noexcept { return elevation_; }

 private:
  Vec3 offset(const Vec2& place, double aspect) const;

  Vec3 target_ = Vec3::Zero();
  double azimuth_ = -0.5, elevation_ = 0.3, distance_ = 1.0, field_of_view_ = 0.5, shift_right_ = 0.0;
};

/// Where a line of sight meets the plane through a point that faces the eye; the point itself when it does
/// not.
/// @param normal of the plane. Thread class: any.
Vec3 meet_plane(const Ray& ray, const Vec3& point, const Vec3& normal) noexcept;

}  // namespace fuai
