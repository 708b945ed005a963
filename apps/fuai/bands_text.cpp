// The options of bands, and how they are told.
// SPDX-License-Identifier: Apache-2.0
#include "bands_text.h"

#include "fuai/core/error.h"
#include "fuai/units/constants.h"
#include "fuai/units/parse.h"

namespace fuai_app {

using namespace fuai;

namespace {

/// "51.4 (47.1 to 54.2) %"
std::string text_of(const SampleBand& band, double unit, const std::string& name) {
  return format_number(band.as_it_is / unit) + " " + name + "; drawn " + format_number(band.mean / unit) +
         " +- " + format_number(band.deviation / unit) + ", 5 to 95 %: " + format_number(band.low / unit) +
         " to " + format_number(band.high / unit);
}

JsonValue json_of(const SampleBand& band, double unit) {
  JsonValue json;
  json.set("as_it_is", band.as_it_is / unit).set("mean", band.mean / unit).set("std", band.deviation / unit);
  json.set("p5", band.low / unit).set("p95", band.high / unit);
  return json.set("carried", band.carried / unit);
}

}  // namespace

void declare_band_options(const Command& command, BandCommandOptions& options) {
  constexpr int kMostSamples = 1000;
  command.option("--disc", options.disc, "Diameter of the drape tester's disc with unit");
  command.option("--specimen", options.specimen, "Diameter of the cloth with unit");
  command.option("--spacing", options.spacing, "Distance of the nodes with unit");
  command.option("--scatter", options.scatter,
                 "Standard deviation of measured numbers, 5 to 20 % in practice");
  command.option("--samples", options.samples, "Fabrics that are drawn, a specimen each")
      .range(2, kMostSamples);
}

DrapeGeometry geometry_of(const BandCommandOptions& options) {
  return {parse_value(options.disc, kLength, "--disc"), parse_value(options.specimen, kLength, "--specimen"),
          parse_value(options.spacing, kLength, "--spacing")};
}

double scatter_of(const BandCommandOptions& options) {
  const double scatter = parse_value(options.scatter, kDimensionless, "--scatter");
  if (scatter >= 0.0 && scatter <= 1.0) return scatter;
  throw Error(ErrorKind::kUsage, "--scatter: '" + options.scatter + "' is not between 0 and 100 %", {},
              "write it with the sign: 10%");
}

bool run_bands(const Console& console, const Fabric& fabric, const FabricUncertainty& uncertainty,
               const BandCommandOptions& options, bool drape, JsonValue& json) {
  FabricBandOptions run;
  run.geometry = geometry_of(options);
  run.samples = options.samples;
  run.drape = drape;
  run.seed = console.options().seed;
  run.threads = console.options().threads;
  const FabricBands bands = find_fabric_bands(fabric, uncertainty, run, console.progress());
  JsonValue told, moment, sentences{JsonValue::Array{}};
  console.line("Carried to");
  if (bands.drape) {
    console.line("  drape coefficient  " + text_of(bands.drape_coefficient, unit::kPercent, "%"));
    console.line("    of it the numbers " + format_number(bands.drape_coefficient.carried / unit::kPercent) +
                 " points, the rest is specimens");
    told.set("drape_coefficient_percent", json_of(bands.drape_coefficient, unit::kPercent));
  }
  for (const Direction direction : {Direction::kWarp, Direction::kWeft}) {
    const SampleBand& band = bands.moment[static_cast<std::size_t>(direction)];
    console.line(std::string("  moment ") + to_string(direction) + "        " +
                 text_of(band, unit::kGfCmPerCm, "gf cm/cm at 1 /cm"));
    moment.set(to_string(direction), json_of(band, unit::kGfCmPerCm));
  }
  for (const std::string& sentence : bands.drawn) {
    console.line("  drawn: " + sentence);
    sentences.push(sentence);
  }
  told.set("moment_gf_cm_per_cm", moment).set("drawn", sentences).set("samples", options.samples);
  told.set("scatter_percent", 100.0 * uncertainty.scatter).set("at_rest", bands.at_rest);
  if (bands.drape)
    told.set("disc_m", run.geometry.disc)
        .set("specimen_m", run.geometry.specimen)
        .set("spacing_m", run.geometry.spacing);
  json.set("bands", told);
  return bands.at_rest;
}

}  // namespace fuai_app
