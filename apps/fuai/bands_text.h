// What `fuai fabric fit` and `fuai fabric bands` share: the options of the bands, how they are told.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "command_line.h"
#include "fuai/laboratory/fabric_bands.h"

namespace fuai_app {

/// Options as words with units.
struct BandCommandOptions {
  std::string disc = "18cm", specimen = "30cm", spacing = "5mm";
  std::string scatter = "10%";
  int samples = 20;
};

/// --disc, --specimen, --spacing, --scatter, --samples.
void declare_band_options(const Command& command, BandCommandOptions& options);

/// The tester. @throws Error (kUsage)
fuai::DrapeGeometry geometry_of(const BandCommandOptions& options);

/// Scatter of measured numbers. @throws Error (kUsage)
double scatter_of(const BandCommandOptions& options);

/// Runs and tells; fills `json` with `bands`. @param drape without it only the moments
/// @return whether every specimen came to rest. @throws Error
bool run_bands(const Console& console, const fuai::Fabric& fabric, const fuai::FabricUncertainty& uncertainty,
               const BandCommandOptions& options, bool drape, JsonValue& json);

}  // namespace fuai_app
