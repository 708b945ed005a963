// The material of a drape: the fabric's laws, softened where the lattice would lock, and with what was only
// assumed put to the ends of its range.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/drape.md, "Locking" and "Bands".
#pragma once

#include <array>

#include "fuai/fabric/laws.h"
#include "fuai/solver/cloth_material.h"
#include "fuai/units/constants.h"

namespace fuai {

/// Which assumption is put to which end.
enum class DrapeVariant {
  kNone,        ///< the laws as they are
  kNoTwist,     ///< twist stiffness 0
  kMostTwist,   ///< kMostTwistShare sqrt(B warp B weft)
  kLeastShear,  ///< G = kLeastShearG
  kMostShear,   ///< G = kMostShearG
};

/// Ends of what was not measured: twist share of sqrt(B warp B weft) from 0 to this, and G [N/(m rad)].
inline constexpr double kMostTwistShare = 0.5;
inline constexpr double kLeastShearG = 0.3 * unit::kGfPerCmDeg;
inline constexpr double kMostShearG = 2.0 * unit::kGfPerCmDeg;

/// Locking shows where k h^4 / (B c^2) exceeds this, c = (B / w)^(1/3) the bending length.
/// @source docs/theory/drape.md: seen on two fabrics
inline constexpr double kMostLocking = 1000.0;
/// But a yarn is never made softer than this [N/m].
inline constexpr double kLeastTension = 200.0;
/// The stiffness k of a yarn is the largest within this strain: what a drape reaches.
inline constexpr double kDrapeStrain = 0.005;

/// How a yarn direction fares with the locking rule.
struct YarnLocking {
  double stiffness = 0.0;  ///< k as measured [N/m]
  double limit = 0.0;      ///< the largest that does not lock at this spacing [N/m]
  double factor = 1.0;     ///< by which the tensile law was scaled, 1 or less
};

/// The material and what was done to it.
struct DrapeMaterial {
  ClothMaterial material;
  std::array<YarnLocking, 2> locking;  ///< warp, weft
  bool capped() const noexcept { return locking[0].factor < 1.0 || locking[1].factor < 1.0; }
};

/// @param spacing of the lattice [m]  @param elastic leaves friction out. Thread class: set-up.
DrapeMaterial make_drape_material(const FabricLaws& laws, double spacing, bool elastic,
                                  DrapeVariant variant = DrapeVariant::kNone);

/// Whether no test of the bias, or of shear, stands behind the laws. Thread class: any.
bool twist_is_assumed(const FabricLaws& laws);
bool shear_is_assumed(const FabricLaws& laws);

}  // namespace fuai
