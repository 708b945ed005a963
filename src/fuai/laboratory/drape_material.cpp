// Softens, varies and collects the material.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/drape_material.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "fuai/core/constants.h"
#include "fuai/experiments/cantilever.h"
#include "fuai/fabric/assumptions.h"
#include "fuai/fabric/scalar_laws.h"

namespace fuai {
namespace {

double largest_stiffness(const PlayLaw& tension) {
  constexpr int kSamples = 50;
  double largest = 0.0;
  for (int i = 1; i <= kSamples; ++i)
    largest = std::max(largest, tension.stick_tangent(kDrapeStrain * i / kSamples));
  return largest;
}

YarnLocking locking_of(const PlayLaw& tension, const PlayLaw& bending, double areal_mass, double spacing) {
  YarnLocking locking;
  const double B = bending_rigidity(bending), w = areal_mass * kStandardGravity;
  const double c = std::cbrt(B / w);
  locking.stiffness = largest_stiffness(tension);
  locking.limit = std::max(kLeastTension, kMostLocking * B * c * c / std::pow(spacing, 4));
  if (locking.stiffness > locking.limit) locking.factor = locking.limit / locking.stiffness;
  return locking;
}

FabricLaws with_shear(const FabricLaws& laws, double G) {
  FabricLaws result = laws;
  const double hysteresis = assumed::kShearHysteresisAngle * G;
  result.shear = make_shear_law(G, hysteresis, hysteresis, laws.shear_test);
  return result;
}

double geometric_mean_rigidity(const FabricLaws& laws) {
  return std::sqrt(bending_rigidity(laws.bending[0]) * bending_rigidity(laws.bending[1]));
}

bool is_assumed(const FabricLaws& laws, std::string_view name) {
  return std::ranges::any_of(laws.reports,
                             [&](const LawReport& r) { return r.law == name && r.origin == "assumed"; });
}

}  // namespace

DrapeMaterial make_drape_material(const FabricLaws& laws, double spacing, bool elastic,
                                  DrapeVariant variant) {
  FabricLaws varied = laws;
  if (variant == DrapeVariant::kLeastShear) varied = with_shear(laws, kLeastShearG);
  if (variant == DrapeVariant::kMostShear) varied = with_shear(laws, kMostShearG);
  if (elastic) varied = without_friction(varied);
  DrapeMaterial made;
  for (std::size_t i = 0; i < 2; ++i) {
    made.locking[i] = locking_of(varied.tensile[i], varied.bending[i], laws.areal_mass, spacing);
    // Elastic curve and friction alike, so that the loop keeps its shape.
    varied.tensile[i] = scaled(varied.tensile[i], made.locking[i].factor, made.locking[i].factor);
  }
  made.material = make_cloth_material(varied);
  if (variant == DrapeVariant::kNoTwist) made.material.twist_stiffness = 0.0;
  if (variant == DrapeVariant::kMostTwist)
    made.material.twist_stiffness = kMostTwistShare * geometric_mean_rigidity(laws);
  return made;
}

bool twist_is_assumed(const FabricLaws& laws) { return is_assumed(laws, "bending.bias"); }
bool shear_is_assumed(const FabricLaws& laws) { return is_assumed(laws, "shear"); }

}  // namespace fuai
