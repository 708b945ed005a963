// Every number of a fabric by its path in a fabric file: the one list that readers, writers and screens walk
// through. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/fabric/fabric.h"
#include "fuai/units/kes.h"

namespace fuai {

/// One number of a fabric.
struct FabricNumber {
  std::string section;  ///< "bending.warp", "weight"
  Kes quantity;         ///< definition, unit and key
  const Known* known;   ///< value [SI] and provenance; may have no value

  /// "bending.warp.B_gf_cm2_per_cm"
  std::string path() const { return section + "." + std::string(kes_quantity(quantity).key); }
  /// Value in KES units.
  double kes_value() const { return known->value / kes_quantity(quantity).to_si; }
};

/// The KES numbers of a fabric in the order of a fabric file, with and without value; pointers into `fabric`.
std::vector<FabricNumber> fabric_numbers(const Fabric& fabric);

}  // namespace fuai
