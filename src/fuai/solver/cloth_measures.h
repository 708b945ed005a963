// The strain measures of the lattice and their gradients, in double, one element at a time: the plain reading
// of the theory page that every faster kernel is held against.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md, "Strain measures".
//
// A collapsed element (an edge, tangent or normal without length) has no measure: `valid` is false, and it
// adds neither force nor energy, and keeps its memory.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "fuai/cloth/cloth_model.h"
#include "fuai/core/types.h"

namespace fuai {

/// Tension. d strain / d x1 = direction / h = - d strain / d x0.
struct EdgeMeasure {
  double strain = 0.0;            ///< |x1 - x0| / h - 1
  Vec3 direction = Vec3::Zero();  ///< unit vector from x0 to x1
  bool valid = false;
};

/// Shear and twist of a cell.
struct CellMeasure {
  double angle = 0.0;           ///< gamma [rad], positive where warp and weft come closer
  Vec3 by_weft = Vec3::Zero();  ///< d gamma / d a, a the weft tangent
  Vec3 by_warp = Vec3::Zero();  ///< d gamma / d b, b the warp tangent
  bool valid = false;
};

/// The slots about one slot, and what bends there; index 0 weft, 1 warp.
struct BendMeasure {
  std::array<std::array<std::size_t, 2>, 2> ends{};  ///< low and high end of the tangent; the slot itself
                                                     ///< where a neighbour is missing
  std::array<Vec3, 2> tangent;                       ///< T = x+ - x- [m]
  std::array<Vec3, 2> second;                        ///< D = x+ - 2 x0 + x- [m]; zero without a triple
  std::array<bool, 2> bends{};                       ///< there is a triple
  std::array<double, 2> length{};                    ///< |T| [m]
  Vec3 normal = Vec3::Zero();                        ///< n
  double normal_length = 0.0;                        ///< |N| [m2]
  std::array<double, 2> slope{};                     ///< t = n . D / |T|
  std::array<double, 2> curvature{};                 ///< kappa [1/m], positive toward the face
  std::array<double, 2> by_slope{};                  ///< d kappa / d t [1/m]
  bool valid = false;
};

/// What c = sum_i weight_i kappa_i pulls on: gradients with respect to T and D of weft and warp [1/m2 times
/// weight].
struct BendGradient {
  std::array<Vec3, 2> by_tangent;
  std::array<Vec3, 2> by_second;
};

/// Thread class of all: real-time.
EdgeMeasure measure_edge(const Vec3& x0, const Vec3& x1, double spacing) noexcept;

/// @param slot low corner of the cell; all four corners are live.
CellMeasure measure_cell(const ClothModel& model, std::span<const Vec3> positions, std::size_t slot) noexcept;

/// D12 = x11 - x10 - x01 + x00 [m].
Vec3 twist_vector(const ClothModel& model, std::span<const Vec3> positions, std::size_t slot) noexcept;

/// @param slot a live slot.
BendMeasure measure_bend(const ClothModel& model, std::span<const Vec3> positions, std::size_t slot) noexcept;

/// Gradient of weights[0] kappa_weft + weights[1] kappa_warp through T and D, the turning of the normal
/// included.
BendGradient bend_gradient(const BendMeasure& bend, const std::array<double, 2>& weights) noexcept;

}  // namespace fuai
