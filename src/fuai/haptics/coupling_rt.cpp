// The virtual coupling in closed form.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/coupling_rt.h"

#include <Eigen/Eigenvalues>

namespace fuai {

CoupledModel couple(const LocalModel& model, double most) noexcept {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(model.stiffness);
  const double stiffest = eigen.eigenvalues()[2];
  if (!(stiffest > most)) return {model, 0.0};
  const double c = 1.0 / most - 1.0 / stiffest;
  // M = (1 + c K)^-1: what is left of the force when the tool gives way.
  const Vec3 left = (1.0 + c * eigen.eigenvalues().array()).inverse();
  const Mat3 M = eigen.eigenvectors() * left.asDiagonal() * eigen.eigenvectors().transpose();
  CoupledModel coupled{model, c};
  // At the model's origin the tool is c F ahead of the device, so the device's origin lies c F back and the
  // force there is the model's own.
  coupled.model.origin = model.origin - c * model.force;
  coupled.model.force_rate = M * model.force_rate;
  coupled.model.stiffness = M * model.stiffness;
  coupled.model.stiffness = 0.5 * (coupled.model.stiffness + coupled.model.stiffness.transpose()).eval();
  coupled.model.damping = M * model.damping * M;
  coupled.model.stored_energy = model.stored_energy + 0.5 * c * model.force.squaredNorm();
  return coupled;
}

}  // namespace fuai
