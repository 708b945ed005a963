// Fills the blocks.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/static_hessian.h"

#include <algorithm>

#include "fuai/solver/cloth_measures.h"

namespace fuai {
namespace {

/// Differences of a gradient are taken over this part of a spacing: they are then good to some six digits.
constexpr double kDifference = 1e-6;

using Gradient = Eigen::Matrix<double, 15, 1>;

Eigen::Index row(std::size_t slot_in_block) { return static_cast<Eigen::Index>(3 * slot_in_block); }

/// The triple's slots: middle, then the ends of weft and warp; missing ends are left out.
void collect(const BendMeasure& bend, std::size_t slot, HessianBlock& block) {
  block.slots[0] = slot;
  block.count = 1;
  for (const auto& ends : bend.ends) {
    for (std::size_t end : ends) {
      if (end != slot) block.slots[block.count++] = end;
    }
  }
}

/// Gradient of weights[0] kappa_weft + weights[1] kappa_warp over the slots of the block.
Gradient gradient_of(const BendMeasure& bend, const std::array<double, 2>& weights, std::size_t slot,
                     const HessianBlock& block) {
  Gradient g = Gradient::Zero();
  const BendGradient parts = bend_gradient(bend, weights);
  const auto add = [&](std::size_t which, const Vec3& v) {
    for (std::size_t i = 0; i < block.count; ++i) {
      if (block.slots[i] == which) g.segment<3>(row(i)) += v;
    }
  };
  for (std::size_t i = 0; i < 2; ++i) {
    add(bend.ends[i][0], parts.by_second[i] - parts.by_tangent[i]);
    add(bend.ends[i][1], parts.by_second[i] + parts.by_tangent[i]);
    add(slot, -2.0 * parts.by_second[i]);
  }
  return g;
}

}  // namespace

bool edge_block(const HessianPoint& at, std::size_t slot, int axis, HessianBlock& block) {
  const ClothModel& m = at.model;
  const double area = (axis == 0 ? m.weft_edge_area : m.warp_edge_area)[slot];
  if (!(area > 0.0)) return false;
  const std::size_t next = slot + (axis == 0 ? 1 : static_cast<std::size_t>(m.columns));
  const double h = m.spacing;
  const EdgeMeasure edge = measure_edge(at.positions[slot], at.positions[next], h);
  if (!edge.valid) return false;
  const PlayLaw& law = axis == 0 ? at.material.weft_tension : at.material.warp_tension;
  const PlayState& memory = (axis == 0 ? at.state.weft_tension : at.state.warp_tension)[slot];
  const Response r = law.evaluate(edge.strain, memory);
  double along = area / (h * h) * r.tangent, across = area / (h * h) * r.stress / (1.0 + edge.strain);
  if (at.safe) along = std::max(along, 0.0), across = std::max(across, 0.0);
  const Mat3 uu = edge.direction * edge.direction.transpose();
  const Mat3 k = along * uu + across * (Mat3::Identity() - uu);
  block.slots[0] = slot, block.slots[1] = next, block.count = 2;
  block.values.block<3, 3>(0, 0) = block.values.block<3, 3>(3, 3) = k;
  block.values.block<3, 3>(0, 3) = block.values.block<3, 3>(3, 0) = -k;
  return true;
}

bool cell_block(const HessianPoint& at, std::size_t slot, HessianBlock& block) {
  const ClothModel& m = at.model;
  if (!(m.cell_area[slot] > 0.0)) return false;
  const CellMeasure cell = measure_cell(m, at.positions, slot);
  if (!cell.valid) return false;
  const auto up = static_cast<std::size_t>(m.columns);
  block.slots = {slot, slot + 1, slot + up, slot + up + 1};
  block.count = 4;
  double tangent = at.material.shear.evaluate(cell.angle, at.state.shear[slot]).tangent;
  if (at.safe) tangent = std::max(tangent, 0.0);
  const double scale = 0.5 / m.spacing, h2 = m.spacing * m.spacing;
  const Vec3 along = scale * (cell.by_weft + cell.by_warp), across = scale * (cell.by_weft - cell.by_warp);
  Eigen::Matrix<double, 12, 1> g;
  g << -along, across, -across, along;
  block.values.topLeftCorner<12, 12>() = m.cell_area[slot] * tangent * g * g.transpose();
  const double twist = 4.0 * m.twist_area[slot] * at.material.twist_stiffness / (h2 * h2);
  constexpr std::array<double, 4> kSign{1.0, -1.0, -1.0, 1.0};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j)
      block.values.block<3, 3>(row(i), row(j)).diagonal().array() += twist * kSign[i] * kSign[j];
  }
  return true;
}

bool bend_block(const HessianPoint& at, std::size_t slot, HessianBlock& block) {
  const ClothModel& m = at.model;
  const std::array<double, 2> area{m.weft_bend_area[slot], m.warp_bend_area[slot]};
  if (!(area[0] > 0.0) && !(area[1] > 0.0)) return false;
  const BendMeasure bend = measure_bend(m, at.positions, slot);
  if (!bend.valid) return false;
  // Flat cloth that stays in its plane does not bend.
  if (!at.axes[2] && bend.slope[0] == 0.0 && bend.slope[1] == 0.0) return false;
  collect(bend, slot, block);
  const std::array<const PlayLaw*, 2> laws{&at.material.weft_bending, &at.material.warp_bending};
  const std::array<const PlayState*, 2> memory{&at.state.weft_bending[slot], &at.state.warp_bending[slot]};
  const double coupling = std::min(area[0], area[1]) * at.material.poisson_bending;
  std::array<double, 2> moment{}, tangent{};
  for (std::size_t i = 0; i < 2; ++i) {
    if (!bend.bends[i]) continue;
    const Response r = laws[i]->evaluate(bend.curvature[i], *memory[i]);
    const double soft = area[1 - i] == 0.0 ? area[i] * free_edge_softening(at.material, *laws[1 - i]) : 0.0;
    moment[i] = area[i] * r.stress + coupling * bend.curvature[1 - i] - soft * bend.curvature[i];
    tangent[i] = area[i] * r.tangent - soft;
    if (at.safe) tangent[i] = std::max(tangent[i], 0.0);
  }
  const auto n = static_cast<Eigen::Index>(3 * block.count);
  const Gradient weft = gradient_of(bend, {1.0, 0.0}, slot, block),
                 warp = gradient_of(bend, {0.0, 1.0}, slot, block);
  block.values.setZero();
  block.values += tangent[0] * weft * weft.transpose() + tangent[1] * warp * warp.transpose();
  if (coupling != 0.0 && !at.safe)
    block.values += coupling * (weft * warp.transpose() + warp * weft.transpose());
  if (at.safe || (moment[0] == 0.0 && moment[1] == 0.0)) return true;
  // Moments times second derivatives, by differences of the gradient of weighted curvatures.
  const double step = kDifference * m.spacing;
  const Gradient here = gradient_of(bend, moment, slot, block);
  Eigen::Matrix<double, 15, 15> second = Eigen::Matrix<double, 15, 15>::Zero();
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!at.axes[static_cast<std::size_t>(k % 3)]) continue;
    double& x = at.positions[block.slots[static_cast<std::size_t>(k / 3)]][k % 3];
    const double kept = x;
    x = kept + step;
    second.col(k) = (gradient_of(measure_bend(m, at.positions, slot), moment, slot, block) - here) / step;
    x = kept;
  }
  block.values += 0.5 * (second + second.transpose());
  return true;
}

}  // namespace fuai
