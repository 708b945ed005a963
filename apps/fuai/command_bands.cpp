// `fuai fabric bands`: how far the drape and the bending moment of a fabric are known.
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include "bands_text.h"
#include "commands.h"
#include "fuai/fabric/laws.h"
#include "fuai/io/fabric_library.h"

namespace fuai_app {

using namespace fuai;

namespace {

struct BandsOptions {
  std::string fabric;
  BandCommandOptions bands;
};

int run_fabric_bands(const Console& console, const BandsOptions& options) {
  FabricUncertainty uncertainty;
  uncertainty.scatter = scatter_of(options.bands);
  const Fabric fabric = load_fabric(options.fabric);
  for (const std::string& warning : fabric.warnings) console.warn(warning);
  console.line(fabric.name);
  JsonValue json, assumptions{JsonValue::Array{}};
  json.set("fabric", fabric.id);
  for (const LawReport& report : make_fabric_laws(fabric).reports)
    for (const std::string& sentence : report.assumptions) {
      console.detail("assumed: " + report.law + ": " + sentence);
      assumptions.push(report.law + ": " + sentence);
    }
  const bool at_rest = run_bands(console, fabric, uncertainty, options.bands, true, json);
  console.result(json.set("assumptions", assumptions));
  return at_rest ? 0 : kExitCheckFailed;
}

}  // namespace

void declare_bands(const Command& parent) {
  const auto options = std::make_shared<BandsOptions>();
  const Command command = parent.command(
      "bands", "What scatter and assumptions of a fabric's numbers do to its drape and bending moment");
  command.option("FABRIC", options->fabric, "Bundled name or path of a fabric file").required();
  declare_band_options(command, options->bands);
  command.examples(
      {"fuai fabric bands wool-tropical", "fuai fabric bands wool-tropical --scatter 20%",
       "fuai --json fabric bands cupro-woven-su1098 --disc 12.7cm --specimen 25.4cm --samples 50"});
  command.body([options](const Console& console) { return run_fabric_bands(console, *options); });
}

}  // namespace fuai_app
