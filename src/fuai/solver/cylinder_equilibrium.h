// Static shapes of strips that bend as a cylinder: every yarn across the strip stays straight and level.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md for the forces; Newton's method with a mass-damped step.
//
// The descent of equilibrium.h solves along yarns with their next neighbours only, so the bending of a long
// strip, which couples the next but one, takes it thousands of steps. Here the profile (along, up) of the
// strip is solved for directly: the derivative of the lattice's own forces by differences, five stations
// apart at a time, and a banded Cholesky. The residual that is reported is that of all slots in all three
// directions, so it also tells whether the strip really is a cylinder.
#pragma once

#include "fuai/solver/equilibrium.h"

namespace fuai {

/// Moves a strip to equilibrium; gravity along z grows in options.load_steps and the friction memory moves
/// after each. Of the options, tolerance, least_force, most_steps, load_steps, first_dt, largest_move and
/// gravity are used. `iterations` of the report counts evaluations of the forces.
/// @param along yarns that run along the strip: kWeft (x) or kWarp (y); all yarns across it are as long as
/// the strip is wide @param state a cylinder: all slots of a station at one place but for their own direction
/// @throws Error (kUsage) for options out of range or the bias direction. Thread class: set-up.
EquilibriumReport find_cylinder_equilibrium(const ClothModel& model, const ClothMaterial& material,
                                            Direction along, ClothState& state,
                                            const EquilibriumOptions& options = {},
                                            const Progress& progress = {});

}  // namespace fuai
