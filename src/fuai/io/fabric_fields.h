// The one list of everything a fabric file can hold, and where it stands in a Fabric.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/fabric/fabric.h"
#include "fuai/units/kes.h"

namespace fuai {

/// What values of a field are possible at all.
enum class FieldRange {
  kPositive,     ///< above zero: stiffnesses, mass, thickness, lengths
  kNotNegative,  ///< zero is possible: hysteresis, friction
  kUpToHundred,  ///< a percentage of a whole, 0 to 100
};

/// One number of a fabric file.
struct FabricField {
  std::string section;     ///< "bending.warp"
  std::string key;         ///< "B_gf_cm2_per_cm"
  std::string unit;        ///< unit expression of the number in the file, "-" where there is none
  double to_si = 1.0;      ///< SI value of one such unit
  std::optional<Kes> kes;  ///< the quantity with its plausible range; none for instrument settings
  FieldRange range = FieldRange::kPositive;
  Known* value = nullptr;  ///< where it stands in the fabric

  /// "bending.warp.B_gf_cm2_per_cm"
  std::string path() const { return section + "." + key; }
};

/// One place for a measured curve.
struct FabricCurveField {
  std::string section;  ///< "bending.warp"
  Test test = Test::kBending;
  Direction direction = Direction::kWarp;
  std::optional<KnownCurve>* curve = nullptr;

  std::string path() const { return section + ".curve"; }
};

/// Every number of a fabric, in the order of the file. The pointers stay valid as long as the fabric does.
/// Thread class: set-up.
std::vector<FabricField> fabric_fields(Fabric& fabric);

/// Every place for a curve, in the order of the file. Thread class: set-up.
std::vector<FabricCurveField> fabric_curve_fields(Fabric& fabric);

/// Checks one number in the unit of its field: throws when it is impossible, warns when it is outside the
/// range of real cloth (with the unit it was probably written in, when another unit would make it plausible).
/// @param where place and key for messages
/// @throws Error (kBadInput): not finite, negative, zero where nothing can be zero, above 100 %
void check_field(const FabricField& field, double number, const Where& where,
                 std::vector<std::string>& warnings);

/// Checks numbers against each other and appends warnings: WT against LT Fm EMT / 2 (5 %), a specimen that is
/// not larger than the drape tester's disc. @param name file or fabric name for the messages
void check_consistency(Fabric& fabric, const std::string& name);

/// Peak load of the standard KES-FB1 setting, 500 gf/cm, in SI, marked as assumed.
Known standard_peak_load();

/// Gives every tensile test that states no peak load the standard one. Thread class: set-up.
void assume_peak_loads(Fabric& fabric);

}  // namespace fuai
