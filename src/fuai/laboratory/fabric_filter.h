// Which fabrics of a library a user looks for.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "fuai/fabric/fabric.h"

namespace fuai {

/// All of it must hold; a default filter lets everything through.
struct FabricFilter {
  std::vector<std::string> words;     ///< each in name, composition, note, or the source of a number;
                                      ///< capital or small Latin letters alike
  std::vector<std::string> measured;  ///< blocks measured on this very cloth: "bending"
  double least_mass = 0.0;            ///< [kg/m2]
  double most_mass = std::numeric_limits<double>::infinity();  ///< [kg/m2]
};

/// Whether a fabric passes. Thread class: set-up.
bool passes(const FabricFilter& filter, const Fabric& fabric);

}  // namespace fuai
