// Second derivatives of the lattice's energies, one small block an element, in double.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md, "Strain measures"; docs/theory/virtual-kes.md, "Solver".
//
//   edge      exact: tangent along the yarn, tension across it
//   cell      tangent of shear along the gradient of the angle; twist exact. Left out: shear stress times the
//             second derivative of the angle
//   triple    tangents of both bendings and their coupling; the moments times the second derivatives of the
//             curvatures by differences of the gradient, so that large rotations converge as well
//   safe      tangents and tensions below zero count as zero and the differences are left out: every block is
//             then positive semidefinite
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/solver/cloth_material.h"

namespace fuai {

/// Most slots of an element: a triple with those across it, which turn its normal.
inline constexpr std::size_t kMostBlockSlots = 5;

/// Hessian of one element: rows and columns 3 i + axis of slot i.
struct HessianBlock {
  std::array<std::size_t, kMostBlockSlots> slots{};
  std::size_t count = 0;  ///< of slots
  Eigen::Matrix<double, 15, 15> values;
};

/// What the blocks are taken at.
struct HessianPoint {
  const ClothModel& model;
  const ClothMaterial& material;
  const ClothState& state;    ///< memory
  std::span<Vec3> positions;  ///< [m] (slots); moved for the differences and put back
  std::array<bool, 3> axes;   ///< along which differences are wanted
  bool safe = false;
};

/// The block of a yarn edge. @param axis 0 weft, 1 warp. @return false when there is nothing. Thread class of
/// all: any.
bool edge_block(const HessianPoint& at, std::size_t slot, int axis, HessianBlock& block);
/// Shear and twist of a cell.
bool cell_block(const HessianPoint& at, std::size_t slot, HessianBlock& block);
/// Both bendings of a slot.
bool bend_block(const HessianPoint& at, std::size_t slot, HessianBlock& block);

}  // namespace fuai
