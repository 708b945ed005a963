// Evaluates the curvature of three particles. The symbols are those of curvature.h.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/energy/curvature.h"

#include <Eigen/Geometry>
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

FoldFactor evaluate_fold_factor(double sum) noexcept {
  const double theta = 2.0 * std::acos(std::min(0.5 * sum, 1.0));
  if (theta > kSwitchAngle) return {};
  const CurvatureOfAngle k = curvature_of_angle(theta, 1.0, CurvatureForm::kC1);
  // |e| = 2 cos(theta / 2), so d theta / d|e| = -1 / sin(theta / 2)
  const double by_sum = -k.slope / std::sin(0.5 * std::max(theta, kSmallestAngle));
  const double f = k.curvature / sum;
  return {f, (by_sum - f) / sum};
}

NormalCurvature evaluate_normal_curvature(const CurvatureStencil& s) noexcept {
  const Vec3 e = (s.p - s.m).normalized() + (s.r - s.m).normalized();
  const Vec3 N = s.weft_tangent.cross(s.warp_tangent);
  const double length = N.norm();
  NormalCurvature result;
  result.vector = evaluate_fold_factor(e.norm()).value / s.rest_leg * e;
  if (length > kParallelTangents) result.normal = N / length;
  result.curvature = result.vector.dot(result.normal);
  result.in_plane_square = result.vector.squaredNorm() - result.curvature * result.curvature;
  return result;
}

NormalCurvatureGradient evaluate_normal_gradient(const CurvatureStencil& s, double moment,
                                                 double in_plane_stiffness) noexcept {
  const double leg_p = (s.p - s.m).norm(), leg_r = (s.r - s.m).norm();
  const Vec3 a = (s.p - s.m) / leg_p, b = (s.r - s.m) / leg_r, e = a + b;
  const double sum = e.norm();
  const NormalCurvature k = evaluate_normal_curvature(s);
  const double length = s.weft_tangent.cross(s.warp_tangent).norm();
  const double c = length > kParallelTangents ? moment - in_plane_stiffness * k.curvature : 0.0;
  const Vec3 V = in_plane_stiffness * k.vector + c * k.normal;
  const FoldFactor f = evaluate_fold_factor(sum);
  Vec3 G = f.value / s.rest_leg * V;
  if (f.slope != 0.0) G += f.slope / s.rest_leg * e.dot(V) / sum * e;
  NormalCurvatureGradient gradient;
  gradient.p = (G - G.dot(a) * a) / leg_p;
  gradient.r = (G - G.dot(b) * b) / leg_r;
  if (length > kParallelTangents) {
    const Vec3 turn = c / length * (k.vector - k.curvature * k.normal);
    gradient.weft_tangent = s.warp_tangent.cross(turn);
    gradient.warp_tangent = turn.cross(s.weft_tangent);
  }
  return gradient;
}

}  // namespace fuai
