// The options of a drape test that several commands share.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "command_line.h"
#include "fuai/laboratory/drape_test.h"

namespace fuai_app {

/// As written on the command line.
struct DrapeWords {
  std::string disc = "18cm";      ///< diameter with unit
  std::string specimen = "30cm";  ///< diameter with unit
  std::string spacing = "5mm";    ///< with unit
  int runs = 5;                   ///< specimens
  bool no_bands = false;          ///< assumptions are not tried
};

/// Adds them to a command.
void declare_drape_options(const Command& command, DrapeWords& words);

/// Their values, with the seed and threads of the console. @throws fuai::Error (kUsage) for a value without
/// a unit.
fuai::DrapeTestOptions drape_options_of(const Console& console, const DrapeWords& words);

}  // namespace fuai_app
