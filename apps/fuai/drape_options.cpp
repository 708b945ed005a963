// Reads the options of a drape test.
// SPDX-License-Identifier: Apache-2.0
#include "drape_options.h"

#include "fuai/units/parse.h"

namespace fuai_app {

void declare_drape_options(const Command& command, DrapeWords& words) {
  constexpr int kMostSpecimens = 1000;
  command.option("--disc", words.disc, "Diameter of the disc with unit");
  command.option("--specimen", words.specimen, "Diameter of the cloth with unit");
  command.option("--spacing", words.spacing, "Distance of the nodes with unit");
  command.option("--runs", words.runs, "Specimens, each with a seed of its own").range(1, kMostSpecimens);
  command.flag("--no-bands", words.no_bands, "Do not try the ends of what was assumed");
}

fuai::DrapeTestOptions drape_options_of(const Console& console, const DrapeWords& words) {
  fuai::DrapeTestOptions options;
  options.geometry.disc = fuai::parse_value(words.disc, fuai::kLength, "--disc");
  options.geometry.specimen = fuai::parse_value(words.specimen, fuai::kLength, "--specimen");
  options.geometry.spacing = fuai::parse_value(words.spacing, fuai::kLength, "--spacing");
  options.runs = words.runs;
  options.seed = console.options().seed;
  options.threads = console.options().threads;
  // One specimen has no spread to set a band against.
  if (words.no_bands || words.runs < 2) options.band_seeds = 0;
  return options;
}

}  // namespace fuai_app
