// What the engine needs to know of a fabric, in the order of its energies: five laws and seven numbers.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md; the numbers that no test shows: docs/theory/assumptions.md.
#pragma once

#include <string>
#include <vector>

#include "fuai/fabric/assumptions.h"
#include "fuai/fabric/laws.h"

namespace fuai {

/// Constant while a solver runs. Weft laws act along the rows of the lattice, warp laws along the columns.
struct ClothMaterial {
  PlayLaw weft_bending, warp_bending;  ///< moment per width [N] of curvature [1/m], positive toward the face
  PlayLaw shear;                       ///< force per width [N/m] of shear angle [rad]
  PlayLaw weft_tension, warp_tension;  ///< force per width [N/m] of strain [-]
  double twist_stiffness = 0.0;        ///< Bt [N m], >= 0
  double poisson_bending = 0.0;        ///< B12 [N m]
  double viscosity_time = assumed::kTensileViscosityTime;  ///< tau [s]: eta = tau F_t'(0+)
  double mass_drag = assumed::kMassDrag;                   ///< c [1/s]
  double air_normal = assumed::kAirNormalDrag;             ///< C_n [-]
  double air_tangential = assumed::kAirTangentialDrag;     ///< C_t [-]
  double air_density = assumed::kAirDensity;               ///< [kg/m3]
  std::vector<std::string> notes;                          ///< what was assumed or mended, plain sentences
};

/// B12 = 0 and Bt = (4 B45 - B1 - B2) / 4 from bending_rigidity(), or 0 with a note where that is negative.
/// Thread class: set-up.
/// @source docs/theory/assumptions.md
ClothMaterial make_cloth_material(const FabricLaws& laws);

/// A tensile law whose compression begins as stiff as its tension and softens to the law's own slope below
/// zero where the stress reaches -buckling_stress [N/m], instead of at once: cloth carries compression until
/// it buckles, and a law with a corner at zero strain makes an implicit step hunt to and fro across it.
/// Unchanged when the law already says what happens below zero. Thread class: set-up.
PlayLaw with_buckling_onset(const PlayLaw& tension, double buckling_stress);

/// Stiffness of a yarn direction at zero strain, without friction [N/m]. Thread class: any.
double tension_toe(const PlayLaw& tension) noexcept;

/// eta = tau F_t'(0+) [N s/m]: the slope of the elastic mean curve (without friction) at zero strain, on the
/// stretched side; never negative. Thread class: any.
double tension_viscosity(const PlayLaw& tension, double viscosity_time) noexcept;

/// B12^2 / B [N m], B the slope of the other direction's law at rest: what a free edge takes off the bending
/// stiffness along it, because the curvature across relaxes there. Thread class: any.
double free_edge_softening(const ClothMaterial& material, const PlayLaw& other) noexcept;

}  // namespace fuai
