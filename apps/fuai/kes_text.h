// What the commands of the virtual instruments share: the table, the keys, the plot.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "console.h"
#include "fuai/fabric/fabric.h"
#include "fuai/laboratory/kes_round_trip.h"

namespace fuai_app {

/// Of `fuai kes`.
struct KesCommandOptions {
  std::string test;  ///< bending, tensile, shear, buckling or stretch
  std::string fabric;
  std::string direction;             ///< warp or weft; empty: warp, in shear both
  std::string csv, plot;             ///< files; empty: none
  std::vector<std::string> reverse;  ///< "OUT" or "OUT:BACK" in the unit of the test
  std::string spacing;               ///< with unit; empty: the instrument's own
};

/// @throws Error (kUsage) for a name that says no kind of picture; empty is fine.
void check_plot_name(const std::string& name);

/// One line a parameter: simulated, the fabric's, difference.
void print_kes_values(const Console& console, const std::vector<fuai::KesValue>& simulated,
                      const std::vector<fuai::KesValue>& own);

/// An object with the keys of units/kes.h.
JsonValue kes_json(const std::vector<fuai::KesValue>& values);

/// Writes a plot; nothing for an empty name.
void write_kes_plot(const Console& console, const std::string& name, const fuai::Plot& plot);

/// `fuai kes buckling` and `stretch`.
int run_fab(const Console& console, const KesCommandOptions& options, const fuai::Fabric& fabric);

}  // namespace fuai_app
