// The loop tests: a strip whose ends are brought together in a clamp hangs from it, and its height tells its
// bending length.
// SPDX-License-Identifier: Apache-2.0
// Source: F. T. Peirce, J. Text. Inst. 21 (1930) T377; ISO and ASTM have the heart loop for limp and curling
// fabrics; evaluation: elastica_loop.h.
//
//   1. the moving clamp is turned, free of force: the strip bends to an arc     pear half a turn, ring one,
//   heart
//   2. it is brought to the fixed clamp                                         one and a half
//   3. weight grows in load_steps; the friction memory moves after every step of 1 to 3
//   The strip may pass through itself on the way and where the legs of a heart meet.
#pragma once

#include <string>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/core/progress.h"
#include "fuai/experiments/elastica_loop.h"
#include "fuai/fabric/laws.h"

namespace fuai {

/// Spacings along the strip unless the caller says otherwise; errors fall with the square.
inline constexpr int kLoopSegments = 80;

/// The strip and how it is solved for.
struct HangingLoopOptions {
  LoopKind kind = LoopKind::kHeart;
  Direction direction = Direction::kWarp;  ///< of the yarns along the strip; not the bias
  double length = 0.1;                     ///< of the strip between the clamps [m]
  int segments = kLoopSegments;            ///< spacings along it, at least 16
  bool elastic = false;                    ///< without friction: the elastic curves of the laws alone
  int load_steps = 20;                     ///< of the weight
};

/// What the test shows.
struct HangingLoopResult {
  double height = 0.0;            ///< from the lowest point up to the clamp [m]
  double bending_length = 0.0;    ///< c by the exact loop [m]; NaN when no weight gives this height
  double bending_rigidity = 0.0;  ///< w c^3 [N m]
  double spacing = 0.0;           ///< [m]
  int iterations = 0;             ///< Newton's
  ClothModel model;
  ClothState state;                      ///< at rest, in the strip's own frame
  Vec3 down = Vec3::Zero();              ///< unit vector of gravity in that frame
  std::vector<std::string> assumptions;  ///< plain sentences
};

/// Forms the loop and hangs it.
/// @throws Error (kUsage) for the bias direction and sizes that make no strip, (kCheckFailed) when it does
/// not come to rest. Thread class: set-up.
HangingLoopResult run_hanging_loop(const FabricLaws& laws, const HangingLoopOptions& options,
                                   const Progress& progress = {});

}  // namespace fuai
