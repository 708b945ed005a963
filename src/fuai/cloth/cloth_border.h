// The border points of a cloth piece: corners of the outline and where yarns meet it.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/cloth-pieces.md, "Border".
#pragma once

#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/cloth/outline.h"

namespace fuai {

/// For each side of the outline its first corner, then the yarns it crosses in order.
/// @param outline lattice coordinates. @param model with its areas. Thread class: set-up.
std::vector<MaterialPoint> make_border(const Polygon& outline, const ClothModel& model);

}  // namespace fuai
