// How a drape is run: loading path, solver, steps, and when it rests.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/drape.md.
#pragma once

namespace fuai {

/// How the weight comes onto the cloth. Which folds form, and what friction keeps of them, depends on it.
enum class DrapePath {
  kRamp,     ///< gravity grows from nothing, smoothly: quasi-static
  kRelease,  ///< all at once
  kShakes,   ///< the ramp; then, at rest, the disc is moved up and down
  kSupport,  ///< the cloth lies on a plate in the plane of the disc, which is lowered
};

enum class DrapeSolver {
  kImplicit,  ///< single precision while the load grows, double to come to rest
  kExplicit,  ///< the oracle: minutes instead of seconds; does not know kSupport
};

/// How a drape is run.
struct DrapeMethod {
  DrapePath path = DrapePath::kRamp;
  DrapeSolver solver = DrapeSolver::kImplicit;
  double loading = 2.0;         ///< length of the gravity ramp, or of lowering the plate [s]
  double dt = 0.008;            ///< step of the implicit solver on the ramp and toward rest [s]
  double driven_dt = 0.002;     ///< its step while the cloth falls, is shaken or lies on the plate [s]
  int iterations = 60;          ///< conjugate gradients a linearisation, at most
  int linearisations = 2;       ///< a step, at most
  double loading_drag = 6.0;    ///< drag proportional to mass while something moves the cloth [1/s]
  double settling_drag = 15.0;  ///< and while it comes to rest [1/s]
  double most_settling = 10.0;  ///< longest time to come to rest [s]
  double linger = 0.0;          ///< goes on so long once it rests: to show that nothing moves any more [s]
  int shakes = 3;               ///< kShakes: times up and down
  double shake_height = 0.02;   ///< from lowest to highest [m]; assumed: the standard does not say
  double shake_period = 0.5;    ///< [s]; assumed
};

/// A drape rests when all of these hold.
inline constexpr double kRestWindow = 0.2;     ///< over this time [s]
inline constexpr double kRestSpread = 5e-4;    ///< DC spreads by less than this [-]
inline constexpr double kLeastSettling = 0.3;  ///< at least so long after the loading [s]
inline constexpr double kRestResidual = 1e-3;  ///< force out of balance, rms over the slots [node weights]
inline constexpr double kRestSpeed = 1e-3;     ///< speed, rms over the slots [m/s]

}  // namespace fuai
