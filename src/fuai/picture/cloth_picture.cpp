// Bounds of a picture and its camera.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/cloth_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fuai/core/assertion.h"

namespace fuai {

Bounds bounds_of(const ClothPicture& picture, bool with_arrows) {
  Bounds bounds;
  for (const ClothItem& cloth : picture.cloths) {
    for (const Vec3& p : cloth.mesh.positions) bounds.include(p);
  }
  for (const BoxItem& box : picture.boxes) {
    bounds.include(box.low);
    bounds.include(box.high);
  }
  for (const CylinderItem& c : picture.cylinders) {
    bounds.include(c.top + Vec3(c.radius, c.radius, 0.0));
    bounds.include(c.top - Vec3(c.radius, c.radius, c.height));
  }
  if (with_arrows) {
    for (const ArrowItem& arrow : picture.arrows) {
      bounds.include(arrow.origin);
      bounds.include(arrow.origin + arrow.vector);
    }
  }
  return bounds;
}

Mat3 camera_axes(const Camera& camera) {
  const Vec3 backward = (camera.eye - camera.target).normalized();
  Vec3 right = camera.up.cross(backward);
  // Looking along `up`: any direction across will do.
  if (right.norm() < 1e-9) right = (std::abs(backward.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY());
  right = (right - right.dot(backward) * backward).normalized();
  Mat3 axes;
  axes << right, backward.cross(right), backward;
  return axes;
}

Camera frame_camera(const Bounds& bounds, double azimuth, double elevation, double aspect,
                    double right_strip) {
  FUAI_ASSERT(!bounds.empty() && aspect > 0.0 && right_strip >= 0.0 && right_strip < 1.0);
  constexpr double kMargin = 1.16;  // leaves 7 % of the picture free on each side
  Camera camera;
  camera.target = bounds.centre();
  const Vec3 direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                       std::sin(elevation));
  // Seen from straight above, the picture's upward direction is away from where the camera would stand.
  camera.up = std::abs(std::cos(elevation)) > 1e-6 ? Vec3(Vec3::UnitZ())
                                                   : Vec3(-std::cos(azimuth), -std::sin(azimuth), 0.0);
  camera.eye = camera.target + direction;
  camera.shift_right = -right_strip;

  const Mat3 axes = camera_axes(camera);
  const double tan_y = std::tan(0.5 * camera.field_of_view);
  const double tan_x = tan_y * aspect * (1.0 - right_strip);
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1) ? bounds.low.x() : bounds.high.x(),
                 (corner & 2) ? bounds.low.y() : bounds.high.y(),
                 (corner & 4) ? bounds.low.z() : bounds.high.z());
    const Vec3 q = axes.transpose() * (p - camera.target);
    // |x| <= (distance - z) tan(half the opening), with the margin on x and y.
    const double needed = std::max(std::abs(q.x()) / tan_x, std::abs(q.y()) / tan_y);
    distance = std::max(distance, q.z() + kMargin * needed);
  }
  camera.eye = camera.target + std::max(distance, 1e-3) * direction;
  return camera;
}

Vec3 project_to_pixel(const Camera& camera, int width, int height, const Vec3& point) {
  const Vec3 q = camera_axes(camera).transpose() * (point - camera.eye);
  const double depth = -q.z();
  const double half_height = camera.parallel_height > 0.0 ? 0.5 * camera.parallel_height
                                                          : depth * std::tan(0.5 * camera.field_of_view);
  const double half_width = half_height * width / height;
  const double x = q.x() / half_width + camera.shift_right;
  return {0.5 * width * (1.0 + x), 0.5 * height * (1.0 - q.y() / half_height), depth};
}

}  // namespace fuai
