// The triples of a cloth piece: which there are, how much cloth each bends, and how clamp edges cut them.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/cloth-pieces.md, "Bending" and "Clamps".
#pragma once

#include <span>

#include "fuai/cloth/clamp.h"
#include "fuai/cloth/cloth_model.h"
#include "fuai/cloth/outline.h"

namespace fuai {

/// Bend areas and lengths without clamps, from node and edge areas.
/// @param outline lattice coordinates. @return whether some slot has a triple both ways. Thread class:
/// set-up.
bool fill_bending(const Polygon& outline, ClothModel& model);

/// Whether a clamp fixes a slot: within the region, or less than half a spacing outside for a sub-cell clamp.
/// Thread class: set-up.
bool clamp_holds(const Clamp& clamp, const ClothModel& model, int slot);

/// Length and area of the triples in fixed slots whose yarn leaves a sub-cell clamp on one side, and of the
/// two next to them, so that they sum curvature from the edge on to third order. Thread class: set-up.
void cut_bending_at_clamps(std::span<const Clamp> clamps, ClothModel& model);

/// Twist areas: those of the cells, over the free share of cells that a sub-cell clamp holds in part.
/// Thread class: set-up.
void fill_twist(std::span<const Clamp> clamps, ClothModel& model);

}  // namespace fuai
