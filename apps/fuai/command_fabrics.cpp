// `fuai fabrics`.
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <limits>
#include <memory>

#include "commands.h"
#include "fabric_text.h"
#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/laboratory/fabric_filter.h"
#include "fuai/laboratory/fabric_numbers.h"
#include "fuai/units/constants.h"
#include "fuai/units/parse.h"

namespace fuai_app {
namespace {

using namespace fuai;

constexpr int kSourceColumns = 60;

struct FabricsOptions {
  std::vector<std::string> words, measured;
  std::string lightest, heaviest;  ///< with unit; empty: no limit
};

FabricFilter filter_of(const FabricsOptions& options) {
  FabricFilter filter;
  filter.words = options.words;
  filter.measured = options.measured;
  if (!options.lightest.empty()) filter.least_mass = parse_value(options.lightest, kArealMass, "--min-mass");
  if (!options.heaviest.empty()) filter.most_mass = parse_value(options.heaviest, kArealMass, "--max-mass");
  if (filter.least_mass > filter.most_mass) {
    throw Error(ErrorKind::kUsage, "--min-mass is more than --max-mass", {}, "exchange the two");
  }
  return filter;
}

JsonValue entry_of(const Fabric& fabric, const std::vector<std::string>& measured) {
  JsonValue entry, blocks{JsonValue::Array{}};
  for (const std::string& block : measured) blocks.push(block);
  entry.set("id", fabric.id).set("name", fabric.name).set("composition", fabric.composition);
  entry.set("areal_mass_kg_per_m2", fabric.areal_mass.value).set("measured", std::move(blocks));
  return entry.set("source", main_source(fabric));
}

int run_fabrics(const Console& console, const FabricsOptions& options) {
  const FabricFilter filter = filter_of(options);
  JsonValue list{JsonValue::Array{}};
  int count = 0;
  for (const std::string& id : bundled_fabric_ids()) {
    const Fabric fabric = load_fabric(id);
    if (!passes(filter, fabric)) continue;
    ++count;
    const std::vector<std::string> measured = measured_blocks(fabric);
    char mass[32];
    std::snprintf(mass, sizeof mass, "%4.0f g/m2  ", fabric.areal_mass.value / unit::kGPerM2);
    console.line(padded(id, 20) + mass + fabric.composition +
                 "; measured: " + (measured.empty() ? "nothing of this very cloth" : joined(measured)) +
                 "; " + shortened(main_source(fabric), kSourceColumns));
    list.push(entry_of(fabric, measured));
  }
  if (count == 0) console.say("no bundled fabric is like that; `fuai fabrics` lists all");
  console.result(JsonValue().set("fabrics", std::move(list)));
  return 0;
}

}  // namespace

void declare_fabrics(const Command& parent) {
  const auto options = std::make_shared<FabricsOptions>();
  const Command command = parent.command("fabrics", "List the bundled fabrics, all or those looked for");
  command.option("WORD", options->words,
                 "Only fabrics with each of these words in name, composition, note or sources");
  command.option("--measured", options->measured, "Only where this was measured on the very cloth")
      .among({"weight", "thickness", "bending", "shear", "tensile", "surface", "compression", "drape"});
  command.option("--min-mass", options->lightest, "Only so heavy or heavier, e.g. 100g/m2");
  command.option("--max-mass", options->heaviest, "Only so heavy or lighter, e.g. 20mg/cm2");
  command.examples({"fuai fabrics", "fuai --json fabrics", "fuai fabrics wool",
                    "fuai fabrics --measured bending --measured shear --max-mass 150g/m2"});
  command.body([options](const Console& console) { return run_fabrics(console, *options); });
}

}  // namespace fuai_app
