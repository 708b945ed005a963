// Names and units of the fields.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/view_quantity.h"

#include "fuai/units/constants.h"

namespace fuai {
namespace {

using enum ClothField;

constexpr ViewUnit kStrainKes{unit::kPercent, "%"}, kStrainSi{1.0, "-"};
constexpr ViewUnit kAngleKes{unit::kDegree, "deg"}, kAngleSi{1.0, "rad"};
constexpr ViewUnit kCurvatureKes{unit::kPerCentimetre, "1/cm"}, kCurvatureSi{1.0, "1/m"};
constexpr ViewUnit kMomentKes{unit::kGfCmPerCm, "gf·cm/cm"}, kMomentSi{1.0, "N"};
constexpr ViewUnit kStressKes{unit::kGfPerCm, "gf/cm"}, kStressSi{1.0, "N/m"};
constexpr ViewUnit kEnergyKes{unit::kGfCmPerCm2, "gf·cm/cm²"}, kEnergySi{1.0, "J/m²"};
constexpr ViewUnit kSpeedKes{unit::kCentimetre, "cm/s"}, kSpeedSi{1.0, "m/s"};

// The least ranges are about what cloth at rest shows by rounding and by its own weight.
constexpr ViewQuantity kQuantities[] = {
    {kWarpStrain, TextId::kFieldWarpStrain, kStrainKes, kStrainSi, 1e-3},
    {kWeftStrain, TextId::kFieldWeftStrain, kStrainKes, kStrainSi, 1e-3},
    {kShearAngle, TextId::kFieldShearAngle, kAngleKes, kAngleSi, 5e-3},
    {kWarpCurvature, TextId::kFieldWarpCurvature, kCurvatureKes, kCurvatureSi, 5.0},
    {kWeftCurvature, TextId::kFieldWeftCurvature, kCurvatureKes, kCurvatureSi, 5.0},
    {kWarpMoment, TextId::kFieldWarpMoment, kMomentKes, kMomentSi, 1e-5},
    {kWeftMoment, TextId::kFieldWeftMoment, kMomentKes, kMomentSi, 1e-5},
    {kWarpStress, TextId::kFieldWarpStress, kStressKes, kStressSi, 0.2},
    {kWeftStress, TextId::kFieldWeftStress, kStressKes, kStressSi, 0.2},
    {kShearStress, TextId::kFieldShearStress, kStressKes, kStressSi, 0.2},
    {kEnergy, TextId::kFieldEnergy, kEnergyKes, kEnergySi, 1e-4},
    {kSpeed, TextId::kFieldSpeed, kSpeedKes, kSpeedSi, 0.01},
};
static_assert(std::size(kQuantities) == kClothFieldCount);

}  // namespace

std::span<const ViewQuantity> view_quantities() { return kQuantities; }

std::string shown_unit(const KesQuantity& quantity, UnitSystem system) {
  const std::string_view unit = system == UnitSystem::kKes ? quantity.kes_unit : quantity.si_unit;
  if (unit == "-") return {};
  return unit == "um" ? "µm" : std::string(unit);
}

LoopAxes loop_axes(PlottedLoop kind, UnitSystem system) {
  const bool kes = system == UnitSystem::kKes;
  switch (kind) {
    case PlottedLoop::kBending:
      return {kes ? TextId::kAxisCurvatureKes : TextId::kAxisCurvatureSi,
              kes ? TextId::kAxisMomentKes : TextId::kAxisMomentSi,
              (kes ? kCurvatureKes : kCurvatureSi).to_si, (kes ? kMomentKes : kMomentSi).to_si};
    case PlottedLoop::kShear:
      return {kes ? TextId::kAxisAngleKes : TextId::kAxisAngleSi,
              kes ? TextId::kAxisShearKes : TextId::kAxisShearSi, (kes ? kAngleKes : kAngleSi).to_si,
              (kes ? kStressKes : kStressSi).to_si};
    case PlottedLoop::kTension:
      break;
  }
  return {kes ? TextId::kAxisStrainKes : TextId::kAxisStrainSi,
          kes ? TextId::kAxisTensionKes : TextId::kAxisTensionSi, (kes ? kStrainKes : kStrainSi).to_si,
          (kes ? kStressKes : kStressSi).to_si};
}

}  // namespace fuai
