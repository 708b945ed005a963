// Bending rigidity and bending friction out of the buckling tests of the Fabric Analyzer, by inverse
// simulation.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/buckling.md.
//
// Model of a sample i of test t:
//   F_i = width f(d_i; B, HB, tilt) + offset_t + drift_t tau_i,   tau 0..1 over the test (samples in order)
// f is simulate_buckling() of make_bending_law(): moment B K + friction bounded by HB = 2HB / 2. The load
// cell's offset differs between set-ups by more than the signal and creeps from cycle to cycle, so offset and
// drift are free in each test; what identifies B and HB is the shape: the slope of the force over the
// distance, and the width and rounding of the nested loops. Both clamps point upwards by one common tilt
// (positive up: with the upward buckle of U1, against the downward one of D1); without it D1 and U1
// contradict each other. Left out of the fit: the first branch of each test, whose history is unknown, and D2
// (8 cm), which hangs as a catenary: its force is weight, not bending. D2 is predicted as a check.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fuai/fabric/fab_record.h"

namespace fuai {

/// One test beside its model.
struct BucklingTestFit {
  FabTest test = FabTest::kD1;
  bool fitted = true;   ///< false: predicted with the fitted law; only offset and drift are its own
  double offset = 0.0;  ///< reading of the empty load cell at the first sample [N]
  double drift = 0.0;   ///< change of it over the test [N]
  double rms = 0.0;     ///< without the first branch [N]
  double span = 0.0;    ///< largest minus smallest measured force, drift taken off [N]
  std::vector<double> clamp_distance;  ///< [m]
  std::vector<double> measured;        ///< force without offset and drift [N]
  std::vector<double> model;           ///< [N]
};

/// What was found for one strip direction.
struct BucklingFit {
  Direction direction = Direction::kWarp;
  double B = 0.0;                            ///< [N m]
  double B_error = 0.0;                      ///< standard error for independent residuals [N m]
  double hysteresis_2HB = 0.0;               ///< [N]
  double hysteresis_2HB_error = 0.0;         ///< [N]
  double clamp_tilt = 0.0;                   ///< of both clamps, positive upwards [rad]
  double clamp_tilt_error = 0.0;             ///< [rad]
  std::array<double, 2> B_alone{};           ///< B of D1 alone, of U1 alone, each with its own tilt [N m]
  std::array<double, 2> hysteresis_alone{};  ///< the same of 2HB [N]
  double rms = 0.0;                          ///< over the fitted tests [N]
  double rms_fraction = 0.0;                 ///< rms over the mean span of the fitted tests
  std::vector<BucklingTestFit> tests;
  std::string quality;  ///< "good", "fair: ...", "poor: ..."
};

/// Fits one direction.
/// Huber weights hold single bad samples down. Quality: good when the residual is at most 5 % of the span and
/// B of D1 alone and of U1 alone lies within 25 % of B; fair up to 10 % and 50 %; poor beyond. The standard
/// errors take the residuals as independent, which they are not: the spread of D1 and U1 says more.
/// @throws Error (kBadInput) when D1 or U1 has too few samples with d < free length, (kCheckFailed) when
/// the simulation does not converge. Thread class: set-up.
BucklingFit fit_buckling(const FabRecord& record, Direction direction);

}  // namespace fuai
