// Evaluates the curvature of three particles. The symbols are those of curvature.h.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/energy/curvature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fuai {
namespace {
constexpr double kSwitchAngle = std::numbers::pi / 4.0;
}  // namespace

CurvatureOfAngle curvature_of_angle(double theta, double leg, CurvatureForm form) noexcept {
  if (theta > kSwitchAngle) return {2.0 / leg * std::cos(0.5 * theta), -std::sin(0.5 * theta) / leg};
  const double alpha = 2.0 / leg * std::cos(kSwitchAngle / 2.0);
  const double beta = std::sin(kSwitchAngle / 2.0) / leg;
  const double t = std::max(theta, kSmallestAngle);
  if (form == CurvatureForm::kPrinted) {
    return {-kSwitchAngle * beta / t + alpha + kSwitchAngle * beta, kSwitchAngle * beta / (t * t)};
  }
  const double A = kSwitchAngle * kSwitchAngle * beta;
  return {A / t + alpha - kSwitchAngle * beta, -A / (t * t)};
}

double curvature_literal_cosine(double theta, double leg) noexcept { return 2.0 / leg * std::cos(theta); }

TripleCurvature evaluate_curvature(const Vec3& p, const Vec3& m, const Vec3& r, double rest_leg,
                                   const Vec3& normal, CurvatureForm form) noexcept {
  const double leg_p = (p - m).norm(), leg_r = (r - m).norm();
  const Vec3 a = (p - m) / leg_p, b = (r - m) / leg_r;
  Vec3 e = a + b;
  const double sum = e.norm();
  const double sign = e.dot(normal) < 0.0 ? -1.0 : 1.0;
  TripleCurvature result;
  double stretch = 1.0;  // dK/dtheta over that of the circle
  if (sum > kFlatSum) {
    e *= sign / sum;
    result.curvature = sign * sum / rest_leg;
    // Sharp folds leave the circle: theta = 2 acos(|a + b| / 2).
    const double theta = 2.0 * std::acos(std::min(0.5 * sum, 1.0));
    if (theta <= kSwitchAngle) {
      const CurvatureOfAngle k = curvature_of_angle(theta, rest_leg, form);
      result.curvature = sign * k.curvature;
      stretch = -k.slope * rest_leg / std::sin(0.5 * std::max(theta, kSmallestAngle));
    }
  } else {
    const double length = normal.norm();
    e = length > 0.0 ? Vec3(normal / length) : Vec3(Vec3::Zero());
  }
  result.gradient_p = stretch / (rest_leg * leg_p) * (e - e.dot(a) * a);
  result.gradient_r = stretch / (rest_leg * leg_r) * (e - e.dot(b) * b);
  return result;
}

}  // namespace fuai
