// The laws of one fabric: what its measurements say when the cloth is bent, sheared and pulled.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fuai/fabric/fabric.h"
#include "fuai/fabric/play_law.h"
#include "fuai/fabric/shear_test.h"

namespace fuai {

/// How well a law repeats the curve it was made from, or where its numbers were taken from.
struct LawReport {
  std::string law;     ///< "bending.warp"
  std::string origin;  ///< "measured loop", "scalars B and 2HB", "assumed"
  double rms_residual_fraction =
      0.0;  ///< rms distance of the branches from the law, in fractions of the peak
  std::vector<std::string> assumptions;  ///< each a plain sentence
};

/// Everything a solver needs of a fabric; all SI.
struct FabricLaws {
  double areal_mass = 0.0;  ///< [kg/m2]
  double thickness = 0.0;   ///< [m]
  std::array<PlayLaw, kDirectionCount>
      bending;                     ///< warp, weft, bias: moment per width [N] of curvature [1/m]
  PlayLaw shear;                   ///< shear stress [N/m] of shear angle [rad], without a tension's share
  ShearTest shear_test;            ///< how the shear numbers were measured: what to_shear_force() needs to
                                   ///< compare the law with them
  std::array<PlayLaw, 2> tensile;  ///< warp, weft: force per width [N/m] of strain [-]
  std::vector<LawReport> reports;  ///< one a law, in the order above
};

/// Makes the laws of a fabric. What is missing is assumed by the rules of docs/theory/assumptions.md and
/// reported.
/// @throws Error (kBadInput) when a curve cannot be a fabric's (negative stiffness, crossed branches beyond
/// noise) or there is no bending measurement at all. Thread class: set-up.
FabricLaws make_fabric_laws(const Fabric& fabric);

/// What was assumed for all laws, each with the law's name before it. Thread class: set-up.
std::vector<std::string> assumptions_of(const FabricLaws& laws);

/// The one bending rigidity of a law where plate theory needs a number [N m]: the slope of its elastic curve
/// at 1 1/cm, the curvature at which KES reads B. Thread class: any.
double bending_rigidity(const PlayLaw& law) noexcept;

/// Hash over every number that acts: masses, tables, plays. The same fabric file gives the same hash.
/// Thread class: set-up.
std::uint64_t laws_hash(const FabricLaws& laws);

}  // namespace fuai
