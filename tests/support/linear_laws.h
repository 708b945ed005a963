// Fabric laws from the two numbers B and HB, for tests: a straight elastic line and constant friction.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/fabric/laws.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/units/constants.h"

namespace fuai_test {

/// M = B K with friction HB, no jamming; none for B = 0. B [gf cm2/cm], HB [gf cm/cm]. The plays weigh alike,
/// as in the runs that the reference numbers of the drapes and bent strips come from.
inline fuai::PlayLaw linear_bending_law(double B_gf_cm2_per_cm, double HB_gf_cm_per_cm) {
  using namespace fuai;
  if (B_gf_cm2_per_cm == 0.0) return {};
  auto plays = kBendingPlays;
  for (PlayElement& play : plays) play.weight = 1.0 / 3.0;
  return make_bending_law(B_gf_cm2_per_cm * unit::kGfCm2PerCm, 2.0 * HB_gf_cm_per_cm * unit::kGfCmPerCm,
                          kNoJamming, plays);
}

/// The same law in warp and weft. mass [g/m2].
inline fuai::FabricLaws linear_laws(double B_gf_cm2_per_cm, double HB_gf_cm_per_cm, double mass_g_per_m2) {
  fuai::FabricLaws laws;
  laws.areal_mass = mass_g_per_m2 * fuai::unit::kGPerM2;
  for (auto& law : laws.bending) law = linear_bending_law(B_gf_cm2_per_cm, HB_gf_cm_per_cm);
  return laws;
}

/// A middling cloth with every law: 160 g/m2.
inline fuai::FabricLaws middling_laws() {
  using namespace fuai;
  FabricLaws laws = linear_laws(0.06, 0.02, 160.0);
  laws.shear = make_shear_law(0.8 * unit::kGfPerCmDeg, 1.5 * unit::kGfPerCm, 3.0 * unit::kGfPerCm);
  for (PlayLaw& law : laws.tensile) law = make_tensile_law(0.7, 0.6, 0.05, 500.0 * unit::kGfPerCm);
  return laws;
}

/// The four stand-ins for the paper's fabrics 1, 3, 6 and 10.
inline constexpr double kFourB[] = {0.02, 0.06, 0.12, 0.20};   ///< [gf cm2/cm]
inline constexpr double kFourHB[] = {0.01, 0.02, 0.04, 0.07};  ///< [gf cm/cm]
inline constexpr double kFourMass_g_per_m2 = 200.0;

}  // namespace fuai_test
