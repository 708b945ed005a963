// The KES numbers of a fabric, stated or assumed by its laws, each with where it comes from.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/fabric/fabric.h"
#include "fuai/fabric/laws.h"
#include "fuai/units/kes.h"

namespace fuai {

/// One number.
struct FabricNumber {
  Kes quantity = Kes::kW;
  std::string section;    ///< "bending.warp"
  Known known;            ///< [SI]; NaN: neither measured nor needed by a law
  std::string condition;  ///< what it is comparable at: "to 500 gf/cm"; empty where there is only one way

  bool setting_known = true;  ///< false: read at a setting that nobody stated, comparable with nothing

  const KesQuantity& definition() const { return kes_quantity(quantity); }
  double in_kes_units() const { return known.value / definition().to_si; }
  /// "bending.warp.B_gf_cm2_per_cm"
  std::string path() const { return section + "." + std::string(definition().key); }
};

/// Every KES number of a fabric in the order of its file, the same rows for every fabric. What the file does
/// not state is read off its measured curve (computed), else off the law that stands for it (assumed, with
/// the rule as its source). Thread class: set-up.
/// @param laws of this fabric
std::vector<FabricNumber> fabric_numbers(const Fabric& fabric, const FabricLaws& laws);

/// Whether a number is about this very cloth: not assumed and no statistic over many. Thread class: any.
bool is_evidence(const Provenance& provenance) noexcept;

/// "bending", "weight": the blocks of the file with at least one such number. Thread class: set-up.
std::vector<std::string> measured_blocks(const Fabric& fabric);

/// Where the bending, else the weight, comes from. Thread class: set-up.
std::string main_source(const Fabric& fabric);

}  // namespace fuai
