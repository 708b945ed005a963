// The virtual coupling: a spring between device and tool that is just soft enough for the device.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Coupling"; Colgate, Stanley and Brown 1995; Adams and Hannaford 1999.
//
//   device --- compliance c --- tool --- model K
//
//   The tool has no mass: it is where both springs pull alike, p = x + c F. In series K becomes K / (1 + c
//   K). c = 0 while K is within what the device renders; beyond, 1/most - 1/K, so the stiffest direction
//   comes out at just `most`. The cloth is told p.
#pragma once

#include "fuai/haptics/local_model_rt.h"

namespace fuai {

/// A model seen through the coupling.
struct CoupledModel {
  LocalModel model;         ///< as felt at the device
  double compliance = 0.0;  ///< c [m/N]
};

/// @param model in the device's coordinates @param most stiffness that the device renders [N/m], > 0
/// Thread class: real-time.
CoupledModel couple(const LocalModel& model, double most) noexcept;

}  // namespace fuai
