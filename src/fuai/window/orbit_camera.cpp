// Turns, moves and zooms.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fuai {
namespace {

/// Short of straight up: beyond, left and right would change places.
constexpr double kMostElevation = 0.49 * std::numbers::pi;
/// A notch of the wheel, as part of the distance.
constexpr double kNotch = 0.88;
constexpr double kNearest = 0.01, kFarthest = 20.0;  // [m]

}  // namespace

void OrbitCamera::frame(const Bounds& bounds, double azimuth, double elevation, double aspect,
                        double right_strip) {
  azimuth_ = azimuth;
  elevation_ = std::clamp(elevation, -kMostElevation, kMostElevation);
  const Camera framed = frame_camera(bounds, azimuth_, elevation_, aspect, right_strip);
  target_ = framed.target;
  distance_ = (framed.eye - framed.target).norm();
  field_of_view_ = framed.field_of_view;
  shift_right_ = framed.shift_right;
}

void OrbitCamera::orbit(const Vec2& move, double height) noexcept {
  const double angle = std::numbers::pi / std::max(height, 1.0);
  azimuth_ = std::remainder(azimuth_ - angle * move.x(), 2.0 * std::numbers::pi);
  elevation_ = std::clamp(elevation_ + angle * move.y(), -kMostElevation, kMostElevation);
}

void OrbitCamera::pan(const Vec2& move, double height) noexcept {
  const double metres = 2.0 * distance_ * std::tan(0.5 * field_of_view_) / std::max(height, 1.0);
  const Mat3 axes = camera_axes(camera());
  target_ += metres * (move.y() * axes.col(1) - move.x() * axes.col(0));
}

void OrbitCamera::zoom(double notches, const Vec2& place, double aspect) noexcept {
  const Vec3 before = offset(place, aspect);
  distance_ = std::clamp(distance_ * std::pow(kNotch, notches), kNearest, kFarthest);
  target_ += before - offset(place, aspect);
}

void OrbitCamera::approach(double times) noexcept {
  distance_ = std::clamp(distance_ / times, kNearest, kFarthest);
}

Camera OrbitCamera::camera() const {
  Camera camera;
  camera.target = target_;
  camera.eye = target_ - distance_ * forward();
  camera.field_of_view = field_of_view_;
  camera.shift_right = shift_right_;
  return camera;
}

Vec3 OrbitCamera::forward() const noexcept {
  return -Vec3(std::cos(elevation_) * std::cos(azimuth_), std::cos(elevation_) * std::sin(azimuth_),
               std::sin(elevation_));
}

/// From the target to what is seen at a place, at the target's depth.
Vec3 OrbitCamera::offset(const Vec2& place, double aspect) const {
  const Mat3 axes = camera_axes(camera());
  const double half = distance_ * std::tan(0.5 * field_of_view_);
  return half * (aspect * (place.x() - shift_right_) * axes.col(0) + place.y() * axes.col(1));
}

Ray OrbitCamera::ray(const Vec2& place, double aspect) const {
  const Vec3 eye = target_ - distance_ * forward();
  return {eye, (target_ + offset(place, aspect) - eye).normalized()};
}

Vec3 meet_plane(const Ray& ray, const Vec3& point, const Vec3& normal) noexcept {
  const double fall = ray.direction.dot(normal);
  const double way = (point - ray.origin).dot(normal) / fall;
  return std::isfinite(way) && way > 0.0 ? Vec3(ray.origin + way * ray.direction) : point;
}

}  // namespace fuai
