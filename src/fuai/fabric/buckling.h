// A strip between two clamps that come together: the axial force of an inextensible, heavy strip with bending
// friction, along a path of clamp distances.
// SPDX-License-Identifier: Apache-2.0
// Source: Euler's elastica; discrete strip of docs/theory/buckling.md.
//
// Both clamps hold the strip at the same angle (theta = clamp_angle, ideally 0), so the shape is symmetric
// about its middle and only the half from a clamp to the middle is computed: N segments of length h with
// angles theta_i, N - 1 hinges between them and one half hinge at either end (the clamp, and the middle where
// theta = 0).
//   kappa_i = (theta_{i+1} - theta_i) / h,    ends: (theta_1 - clamp_angle) / (h/2), -theta_N / (h/2)
//   Pi(theta) = sum_hinges h_i W_n(kappa_i) -+ sum_i w h y_i       (downwards -, upwards +)
//   X(theta)  = h sum cos(theta_i) = d/2
//   grad Pi = H grad X:  the multiplier H is the horizontal force per width, tension positive.
// W_n is the play law's incremental potential, so every step of the path is a constrained minimisation.
#pragma once

#include <span>
#include <vector>

#include "fuai/fabric/play_law.h"

namespace fuai {

/// The strip and how it hangs.
struct BucklingStrip {
  double free_length = 0.0;    ///< length of cloth between the clamps [m]
  double areal_mass = 0.0;     ///< [kg/m2]; 0 = weightless
  bool upwards = false;        ///< the strip buckles against gravity
  int half_segments = 20;      ///< N
  double largest_step = 0.02;  ///< longest step of the path between two clamp distances [free lengths]
  double clamp_angle = 0.0;  ///< at which both clamps hold the strip, positive in the sense of buckling [rad]
};

/// What the path returned, one entry a clamp distance.
struct BucklingPath {
  std::vector<double> force;          ///< horizontal force per width, tension positive [N/m]
  std::vector<double> deflection;     ///< height of the middle over the clamps, in the sense of buckling [m]
  std::vector<double> end_curvature;  ///< curvature at the clamps [1/m]
  double worst_residual = 0.0;        ///< largest |grad Pi - H grad X| over the largest hinge moment
};

/// Follows the clamp distances quasi-statically from the flat virgin strip.
/// @param strip the strip
/// @param law moment per width [N] of curvature [1/m]
/// @param distances clamp distances [m] in the order visited, each within (0, free_length)
/// @throws Error (kBadInput) for a distance or strip that makes no sense, (kCheckFailed) with the residual
/// when a step does not converge. Thread class: set-up.
BucklingPath simulate_buckling(const BucklingStrip& strip, const PlayLaw& law,
                               std::span<const double> distances);

}  // namespace fuai
