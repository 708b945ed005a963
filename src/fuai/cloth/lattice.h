// The square lattice of particles that stands for a woven cloth: the constant model and the changing state.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", section 2.1 (Fig. 2).
//
//   node (column, row) has index row * columns + column and rests at (column, row, 0) * spacing
//   weft threads run along x (a row of nodes), warp threads along y (a column of nodes); the face looks to +z
//   edges    8-neighbour springs, each once: weft, warp and the two diagonals of every cell
//   triples  three consecutive nodes of a thread, where bending is measured
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fuai/core/types.h"
#include "fuai/fabric/play_law.h"

namespace fuai {

/// Two neighbouring nodes joined by a spring; first < second.
struct LatticeEdge {
  int first = 0, second = 0;     ///< node indices
  Direction direction;           ///< kWarp and kWeft along a thread, kBias for a diagonal
  double rest_length = 0.0;      ///< [m]
  double tributary_factor = 1.;  ///< 1, or 1/2 for a thread edge on the border: half its cloth is missing
};

/// Three consecutive nodes of one thread; end_low < middle < end_high.
struct LatticeTriple {
  int end_low = 0, middle = 0, end_high = 0;  ///< node indices
  Direction direction;                        ///< kWarp or kWeft: the thread that is bent
  double tributary_factor = 1.;               ///< 1, or 1/2 on a border thread
};

/// What make_lattice_model() needs.
struct LatticeSpec {
  int columns = 0;               ///< nodes along the weft, 3 or more
  int rows = 0;                  ///< nodes along the warp, 3 or more
  double spacing = 0.0;          ///< l0 [m], > 0
  double areal_mass = 0.0;       ///< [kg/m2], >= 0
  std::vector<int> fixed_nodes;  ///< nodes that the solver must not move, in any order
};

/// The constant part. Build it with make_lattice_model().
struct LatticeModel {
  int columns = 0, rows = 0;
  double spacing = 0.0;                   ///< l0 [m]
  double areal_mass = 0.0;                ///< [kg/m2]
  std::vector<Vec3> rest_positions;       ///< [m] (nodes)
  std::vector<double> tributary_factors;  ///< 1 inside, 1/2 on a side, 1/4 in a corner (nodes)
  std::vector<std::uint8_t> fixed;        ///< 1 for a fixed node (nodes)
  std::vector<LatticeEdge> edges;         ///< weft, warp, then the two diagonal directions
  std::vector<LatticeTriple> triples;     ///< weft, then warp

  int node_count() const noexcept { return columns * rows; }
  int node(int column, int row) const noexcept { return row * columns + column; }
  /// Cloth that belongs to a node [m2].
  double tributary_area(int node) const noexcept {
    return tributary_factors[static_cast<std::size_t>(node)] * spacing * spacing;
  }
};

/// What a step changes. Many states may share a model.
struct LatticeState {
  std::vector<Vec3> positions;    ///< [m] (nodes)
  std::vector<PlayState> memory;  ///< friction memory in bending (triples)
};

/// Builds and validates a lattice.
/// @throws Error (kUsage) when there are fewer than 3 x 3 nodes, more than 4096 a side, the spacing is not
/// positive, the mass is negative or not finite, or a fixed node does not exist. Thread class: set-up.
LatticeModel make_lattice_model(const LatticeSpec& spec);

/// Nodes on a side of a given length, both ends counted.
/// @param key name of the side in the error
/// @throws Error (kUsage) unless the length is a positive whole multiple of the spacing, to 1e-6 of a cell
/// (lengths are typed in decimal). Thread class: set-up.
int lattice_nodes_on_side(double length, double spacing, const char* key);

/// Flat, unstressed, virgin cloth. Thread class: set-up.
LatticeState make_lattice_state(const LatticeModel& model);

/// Sums of the unit vectors of the weft edges and of the warp edges at a node, toward growing index [-].
/// Their cross product weft x warp is the normal of the sheet and looks to the face; it vanishes where the
/// cloth is folded flat.
struct LatticeTangents {
  Vec3 weft = Vec3::Zero(), warp = Vec3::Zero();
};

/// Thread class: real-time.
LatticeTangents lattice_tangents(const LatticeModel& model, std::span<const Vec3> positions,
                                 int node) noexcept;

}  // namespace fuai
