// `fuai fabrics`.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>

#include "commands.h"
#include "fabric_text.h"
#include "fuai/io/fabric_fields.h"
#include "fuai/io/fabric_library.h"
#include "fuai/units/constants.h"

namespace fuai_app {
namespace {

using namespace fuai;

constexpr int kSourceColumns = 60;

bool is_evidence(const Provenance& provenance) {
  return provenance.kind != ProvenanceKind::kAssumed && provenance.kind != ProvenanceKind::kStatistic;
}

/// "bending", "weight": the blocks with at least one number that is about this very cloth.
std::vector<std::string> measured_blocks(Fabric& fabric) {
  std::vector<std::string> blocks;
  for (const FabricField& field : fabric_fields(fabric)) {
    if (!field.kes || !field.value->has_value() || !is_evidence(field.value->provenance)) continue;
    const std::string block = field.section.substr(0, field.section.find('.'));
    if (std::ranges::find(blocks, block) == blocks.end()) blocks.push_back(block);
  }
  return blocks;
}

std::string first_source(Fabric& fabric) {
  for (const FabricField& field : fabric_fields(fabric)) {
    if (field.section.starts_with("bending") && field.value->has_value())
      return field.value->provenance.source;
  }
  return fabric.areal_mass.provenance.source;
}

int run_fabrics(const Console& console) {
  JsonValue list{JsonValue::Array{}};
  for (const std::string& id : bundled_fabric_ids()) {
    Fabric fabric = load_fabric(id);
    const std::vector<std::string> measured = measured_blocks(fabric);
    const std::string source = first_source(fabric);
    char mass[32];
    std::snprintf(mass, sizeof mass, "%4.0f g/m2  ", fabric.areal_mass.value / unit::kGPerM2);
    console.line(padded(id, 20) + mass + fabric.composition +
                 "; measured: " + (measured.empty() ? "nothing of this very cloth" : joined(measured)) +
                 "; " + shortened(source, kSourceColumns));
    JsonValue entry, blocks{JsonValue::Array{}};
    for (const std::string& block : measured) blocks.push(block);
    entry.set("id", id).set("name", fabric.name).set("composition", fabric.composition);
    entry.set("areal_mass_kg_per_m2", fabric.areal_mass.value).set("measured", std::move(blocks));
    entry.set("source", source);
    list.push(std::move(entry));
  }
  console.result(JsonValue().set("fabrics", std::move(list)));
  return 0;
}

}  // namespace

void declare_fabrics(const Command& parent) {
  const Command command = parent.command("fabrics", "List the bundled fabrics, one line each");
  command.examples({"fuai fabrics", "fuai --json fabrics"});
  command.body(run_fabrics);
}

}  // namespace fuai_app
