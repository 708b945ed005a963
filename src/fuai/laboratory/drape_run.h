// One drape: a specimen sinks under its weight along a loading path until it rests.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/drape.md.
#pragma once

#include <cstdint>

#include "fuai/core/progress.h"
#include "fuai/laboratory/drape_shadow.h"
#include "fuai/laboratory/drape_specimen.h"
#include "fuai/solver/cloth_material.h"

namespace fuai {

/// How the weight comes onto the cloth.
enum class DrapePath {
  kRamp,     ///< gravity grows from nothing, smoothly: the quasi-static path
  kRelease,  ///< all at once
};

/// How a drape is run.
struct DrapeMethod {
  DrapePath path = DrapePath::kRamp;
  double ramp = 2.0;          ///< length of the gravity ramp [s]
  double dt = 0.008;          ///< step [s]
  int iterations = 60;        ///< conjugate gradients a linearisation
  int linearisations = 2;     ///< a step
  double loading_drag = 6.0;  ///< drag proportional to mass until all weight is on [1/s]
  double settling_drag = 15.0;  ///< and from then on [1/s]
  double most_settling = 10.0;  ///< longest time to come to rest after the loading [s]
};

/// When a drape rests: all of these.
inline constexpr double kRestWindow = 0.2;       ///< DC is watched over this time [s]
inline constexpr double kRestSpread = 0.0005;    ///< and spreads by less [-]
inline constexpr double kLeastSettling = 0.3;    ///< at least so long after the loading [s]
inline constexpr double kRestResidual = 1e-3;    ///< force out of balance, rms over the slots [node weights]

/// What came of it.
struct DrapeRun {
  ClothState state;
  DrapeShadow shadow;
  bool at_rest = false;
  double residual = 0.0;        ///< force out of balance, rms over the slots [node weights]
  double seconds = 0.0;         ///< of the cloth's time
  int steps = 0;
  int iterations = 0;           ///< conjugate gradients
};

/// Runs it. @param material its mass drag is replaced by the method's
/// @throws Error (kUsage) for options out of range, (kCheckFailed) when numbers went wrong. Thread class:
/// set-up.
DrapeRun run_drape(const DrapeGeometry& geometry, const ClothModel& model, const ClothMaterial& material,
                   const ClothState& start, const DrapeMethod& method, const Progress& progress = {});

}  // namespace fuai
