// Builds the model of a piece of cloth from its outline.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/cloth-pieces.md; docs/decisions/0008-extrapolation-nodes.md.
//
//   outline  ->  cells cut exactly  ->  cells with less than a tenth inside give their cloth to a neighbour
//   cells    ->  slots at their corners are live, also those just outside the outline
//   cells    ->  areas of slots and edges with the centre of mass of each cell, triples
//   clamps   ->  fixed slots, and triples cut by the edge of a clamp
//   outline  ->  border points, each a weighted mean of slots
#pragma once

#include <span>
#include <vector>

#include "fuai/cloth/clamp.h"
#include "fuai/cloth/cloth_model.h"
#include "fuai/cloth/outline.h"

namespace fuai {

/// What make_cloth_model() needs.
struct ClothPieceSpec {
  Polygon outline;          ///< simple polygon, either way round, pattern coordinates [m]
  double spacing = 0.0;     ///< h [m], > 0
  double areal_mass = 0.0;  ///< [kg/m2], >= 0
  Vec2 lattice_shift =
      Vec2::Zero();           ///< of the lattice against the low corner of the outline's box [spacings]
  std::vector<Clamp> clamps;  ///< each must hold a slot
  std::vector<Vec2> pins;     ///< the slot nearest to each is fixed, the yarns turn freely [m]
};

/// A cell with less than this share inside the outline is dropped and its cloth given to a neighbour [-].
/// Smaller: outer slots with next to no mass; larger: a rougher border. From the drape study, with 0.1.
inline constexpr double kLeastCellShare = 0.1;

/// Limits of the factor by which a triple at the edge of a clamp is stiffer, and of 1 / f on the twist of a
/// cell of which the part f is free [-]. The upper one is what a straight edge across the yarns needs; with 4
/// the annulus of docs/theory/cloth-pieces.md comes out up to 5.5 % too soft at 10 mm.
inline constexpr double kLeastClampFactor = 0.7;
inline constexpr double kMostClampFactor = 24.0;

/// Most slots on a side of a lattice.
inline constexpr int kMostSlotsASide = 4096;

/// Builds and validates the model. The sums of node, cell, weft edge and warp edge areas equal the area of
/// model.outline to rounding.
/// @throws Error (kBadInput) for an outline that make_outline() refuses; (kUsage) when the spacing is not
/// positive, so small that a side needs more than kMostSlotsASide slots, or so large that no slot has a
/// triple both ways or the piece falls apart; when the mass is negative or not finite, the shift not finite,
/// or a clamp or pin holds no cloth. Each says how to mend it. Thread class: set-up.
ClothModel make_cloth_model(const ClothPieceSpec& spec);

}  // namespace fuai
