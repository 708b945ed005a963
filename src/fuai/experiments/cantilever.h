// The cantilever test: a strip held level at one end hangs under its own weight, at rest.
// SPDX-License-Identifier: Apache-2.0
// Source: ASTM D1388 option A and ISO 9073-7 (the test); docs/theory/engine.md (the cloth); elastica.h (its
// evaluation).
//
//   outline  [-2h, length] x [0, width], clamped up to 0, which is a line of the lattice
//   gravity grows in load_steps equal steps; the friction memory moves after each
#pragma once

#include <string>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/core/progress.h"
#include "fuai/fabric/laws.h"
#include "fuai/solver/equilibrium.h"

namespace fuai {

/// The strip and how it is solved for.
struct CantileverOptions {
  Direction direction = Direction::kWarp;  ///< of the yarns that run along the strip; not the bias
  double length = 0.1;                     ///< free length [m]
  double width = 0.02;                     ///< [m]; the bending length hardly depends on it
  double spacing = 0.0;                    ///< h [m]; 0: length / kCantileverSegments, at most half the width
  bool elastic = false;                    ///< without friction: the elastic curves of the laws alone
  /// Steps of gravity. At a length of 10 cm 20 are within 0.11 % of the reach of 80 for the limpest bundled
  /// fabric (cotton knit, warp) and 0.02 % of that of 40 for wool; without friction the path makes no
  /// difference.
  int load_steps = 20;
  double tolerance = 1e-5;  ///< force out of balance, root of the sum of squares, as a part of the weight;
                            ///< 1e-4 leaves 1 % of the reach of limp fabrics open
};

/// Yarn crossings over the free length unless the caller says otherwise; errors fall with its square.
inline constexpr int kCantileverSegments = 40;
/// Fewest and most of them.
inline constexpr int kLeastCantileverSegments = 4, kMostCantileverSegments = 1000;

/// What the test shows.
struct CantileverResult {
  double reach = 0.0;           ///< level distance of the tip from the clamp [m]
  double droop = 0.0;           ///< fall of the tip [m]
  double tip_angle = 0.0;       ///< below level [rad]
  double chord_angle = 0.0;     ///< of the line from clamp to tip, below level [rad]
  double bending_length = 0.0;  ///< c = (B/w)^(1/3) from the chord angle by the exact elastica [m]; NaN when
                                ///< the strip does not hang below the clamp
  double bending_length_peirce = 0.0;  ///< the same by Peirce's closed formula [m]
  double bending_rigidity = 0.0;       ///< w c^3 [N m]
  double spacing = 0.0;                ///< that was used [m]
  EquilibriumReport equilibrium;
  ClothModel model;
  ClothState state;                      ///< at rest; z is up, the strip leaves the clamp along x or y
  std::vector<std::string> assumptions;  ///< plain sentences
};

/// The laws without friction: their elastic curves alone. Thread class: set-up.
FabricLaws without_friction(const FabricLaws& laws);

/// Hangs the strip.
/// @throws Error (kUsage) for the bias direction, sizes that are not positive and finite, fewer than
/// kLeastCantileverSegments or more than kMostCantileverSegments spacings along the strip, or fewer than two
/// across. Thread class: set-up.
CantileverResult run_cantilever(const FabricLaws& laws, const CantileverOptions& options,
                                const Progress& progress = {});

}  // namespace fuai
