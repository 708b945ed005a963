// A piece of cloth as yarns on a square lattice, cut by its outline: the constant model and the changing
// state.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/cloth-pieces.md, docs/theory/engine.md.
//
//   slot (column, row) has index row * columns + column and rests at origin + spacing * (column, row)
//   weft yarns run along x (a row of slots), warp yarns along y (a column); the face of the flat cloth looks
//   to +z a slot is live when it carries cloth; the outermost live slots may lie just outside the outline, so
//   that every yarn reaches past it, and the areas below count only the cloth that is there
//
//        r+1  o-----o-----o       "cell r,c" has its low corner in slot (c, r)
//             |cell |     |       "weft edge r,c" joins (c, r) and (c+1, r)
//        r    o-----o-----o       "warp edge r,c" joins (c, r) and (c, r+1)
//             c    c+1            "bend r,c" is the pair of yarn triples with their middle in (c, r)
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fuai/core/types.h"
#include "fuai/fabric/play_law.h"

namespace fuai {

/// A point of the piece that is not a slot: a weighted mean of live slots, so that a straight yarn keeps it
/// in its place. Border points (a yarn meets the outline) use two slots, corners of the outline up to four.
struct MaterialPoint {
  Vec2 material = Vec2::Zero();     ///< weft and warp coordinate [m]
  std::array<int, 4> slots{};       ///< slot indices; unused ones repeat the first with weight 0
  std::array<double, 4> weights{};  ///< sum to 1
};

/// The constant part. Build it with make_cloth_model(). All per-slot arrays have columns * rows entries.
struct ClothModel {
  int columns = 0, rows = 0;
  double spacing = 0.0;             ///< h [m]
  Vec2 origin = Vec2::Zero();       ///< material coordinates of slot (0, 0) [m]
  double areal_mass = 0.0;          ///< [kg/m2]
  std::vector<std::uint8_t> live;   ///< 1: the slot carries cloth
  std::vector<std::uint8_t> fixed;  ///< 1: held by a clamp or pin; its position is prescribed
  std::vector<double> node_area;    ///< cloth that moves with the slot [m2]; sums to the area of the outline
  std::vector<double> cell_area;    ///< cloth inside the cell [m2]; the same sum
  std::vector<double>
      twist_area;  ///< the same for its twist, more where a clamp holds part of the cell: stiffness
                   ///< is that of the cloth that is free, see docs/theory/cloth-pieces.md [m2]
  std::vector<double> weft_edge_area, warp_edge_area;  ///< cloth stretched with the edge [m2]; the same sums
  std::vector<double> weft_bend_area, warp_bend_area;  ///< cloth bent with the triple [m2]; 0: no triple
  std::vector<double> weft_bend_length,
      warp_bend_length;               ///< curvature = angle / this [m]: the spacing, unless
                                      ///< the edge of a clamp is near
  std::vector<Vec2> outline;          ///< polygon, counter-clockwise, material coordinates [m]
  std::vector<MaterialPoint> border;  ///< along the outline in its order: yarn crossings and corners

  int slot_count() const noexcept { return columns * rows; }
  int slot(int column, int row) const noexcept { return row * columns + column; }
  Vec2 material(int column, int row) const noexcept { return origin + spacing * Vec2(column, row); }
};

/// What a step changes. Many states may share a model.
struct ClothState {
  std::vector<Vec3> positions;   ///< [m] (slots); of dead slots: where they rest flat
  std::vector<Vec3> velocities;  ///< [m/s] (slots)
  /// [m/s2] (slots): what a step of second order remembers of the one before; empty: nothing.
  std::vector<Vec3> accelerations;
  /// Friction memory (slots each): of the weft and warp triples, of the cells, of the weft and warp edges.
  std::vector<PlayState> weft_bending, warp_bending, shear, weft_tension, warp_tension;
  /// What a solver carries from one step to the next beyond the above, so that a restored state goes on bit
  /// for bit; empty: nothing.
  std::vector<double> carried;
  double time = 0.0;  ///< [s]
};

/// Flat at z = 0, at rest, virgin. Thread class: set-up.
ClothState make_cloth_state(const ClothModel& model);

}  // namespace fuai
