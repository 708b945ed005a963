// One drape: a specimen sinks under its weight along a loading path until it rests.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/drape.md.
#pragma once

#include "fuai/core/progress.h"
#include "fuai/laboratory/drape_method.h"
#include "fuai/laboratory/drape_shadow.h"
#include "fuai/scenes/drape_specimen.h"
#include "fuai/solver/cloth_material.h"

namespace fuai {

/// What came of it.
struct DrapeRun {
  ClothState state;
  DrapeShadow shadow;
  bool at_rest = false;   ///< all of drape_method.h's conditions hold
  double residual = 0.0;  ///< force out of balance, rms over the slots [node weights]
  double seconds = 0.0;   ///< of the cloth's time until it rested
  int steps = 0;
  int iterations = 0;  ///< conjugate gradients
};

/// Runs it.
/// @param material its mass drag is replaced by the method's
/// @throws Error (kUsage) for a method out of range, (kCheckFailed) when numbers went wrong.
/// Thread class: set-up.
DrapeRun run_drape(const DrapeGeometry& geometry, const ClothModel& model, const ClothMaterial& material,
                   const ClothState& start, const DrapeMethod& method, const Progress& progress = {});

}  // namespace fuai
