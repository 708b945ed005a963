// Checks and repairs of the local model.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/local_model_rt.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace fuai {

bool is_finite(const LocalModel& model) noexcept {
  return std::isfinite(model.time) && std::isfinite(model.horizon) && model.origin.allFinite() &&
         model.origin_velocity.allFinite() && model.force.allFinite() && model.force_rate.allFinite() &&
         model.stiffness.allFinite() && model.damping.allFinite() && !std::isnan(model.trust_radius) &&
         std::isfinite(model.ledger.work) && std::isfinite(model.ledger.leak);
}

Mat3 make_passive(const Mat3& matrix, double most) noexcept {
  if (!matrix.allFinite()) return Mat3::Zero();
  const Mat3 symmetric = 0.5 * (matrix + matrix.transpose());
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(symmetric);
  const Vec3 values = eigen.eigenvalues().cwiseMax(0.0).cwiseMin(most);
  return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace fuai
