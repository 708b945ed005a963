// Chooses the slots of a grip and turns its frame.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/sim/grasp.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fuai {

double covered_share(const Vec2& centre, double radius, double h) noexcept {
  constexpr int kSamples = 16;
  int inside = 0;
  for (int j = 0; j < kSamples; ++j) {
    for (int i = 0; i < kSamples; ++i) {
      const Vec2 sample(((i + 0.5) / kSamples - 0.5) * h, ((j + 0.5) / kSamples - 0.5) * h);
      inside += (sample - centre).squaredNorm() <= radius * radius ? 1 : 0;
    }
  }
  return static_cast<double>(inside) / (kSamples * kSamples);
}

Mat3 best_rotation(const Mat3& M, const Mat3& otherwise) noexcept {
  const Eigen::JacobiSVD<Mat3> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // Two directions of the patch must be seen; the third follows from them.
  if (!(svd.singularValues()[1] > 1e-3 * svd.singularValues()[0])) return otherwise;
  Mat3 sign = Mat3::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * sign * svd.matrixV().transpose();
}

void Grasp::move(const Vec3& hand, const Mat3& rotation) noexcept {
  centre_ = hand - to_hand_;
  if (spec_.kind == GraspKind::kPinch) rotation_ = rotation;
}

bool Grasp::choose(const ClothModel& model) noexcept {
  count_ = 0;
  const double h = model.spacing, reach = spec_.radius + h;
  const Vec2 at = (spec_.centre - model.origin) / h;
  const auto bound = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const int first_column = bound(std::floor(at.x() - reach / h), model.columns - 1);
  const int last_column = bound(std::ceil(at.x() + reach / h), model.columns - 1);
  const int first_row = bound(std::floor(at.y() - reach / h), model.rows - 1);
  const int last_row = bound(std::ceil(at.y() + reach / h), model.rows - 1);
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity(), total = 0.0;
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const int slot = model.slot(column, row);
      const auto i = static_cast<std::size_t>(slot);
      if (model.live[i] == 0 || model.fixed[i] != 0) continue;
      const Vec2 centre = spec_.centre - model.material(column, row);
      if (centre.norm() < least) {
        least = centre.norm();
        nearest = slot;
      }
      const double cloth = covered_share(centre, spec_.radius, h) * model.node_area[i];
      if (!(cloth > 0.0) || count_ == kMostPatchSlots) continue;
      slots_[count_] = slot;
      weights_[count_++] = cloth;
      total += cloth;
    }
  }
  if (nearest < 0) return false;
  if (count_ == 0 || spec_.radius <= 0.0) {
    slots_[0] = nearest;
    weights_[0] = total = 1.0;
    count_ = 1;
  }
  for (std::size_t i = 0; i < count_; ++i) weights_[i] /= total;
  return true;
}

}  // namespace fuai
