// `fuai fabrics` and `fuai fabric show`.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/experiments/fabric_plot.h"
#include "fuai/fabric/laws.h"
#include "fuai/io/fabric_fields.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"
#include "fuai/units/constants.h"

namespace fuai_app {
namespace {

using namespace fuai;

bool is_evidence(const Provenance& provenance) {
  return provenance.kind != ProvenanceKind::kAssumed && provenance.kind != ProvenanceKind::kStatistic;
}

/// "bending, weight": the blocks with at least one number or curve that is about this very cloth.
std::vector<std::string> measured_blocks(Fabric& fabric) {
  std::vector<std::string> blocks;
  const auto add = [&](const std::string& block) {
    if (std::ranges::find(blocks, block) == blocks.end()) blocks.push_back(block);
  };
  for (const FabricField& field : fabric_fields(fabric)) {
    if (!field.kes || !field.value->has_value() || !is_evidence(field.value->provenance)) continue;
    add(field.section.substr(0, field.section.find('.')));
  }
  return blocks;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "nothing" : text;
}

std::string first_source(Fabric& fabric) {
  for (const FabricField& field : fabric_fields(fabric)) {
    if (field.section.starts_with("bending") && field.value->has_value())
      return field.value->provenance.source;
  }
  return fabric.areal_mass.provenance.source;
}

JsonValue provenance_json(const Provenance& p) {
  JsonValue value;
  value.set("kind", to_string(p.kind)).set("source", p.source);
  if (!p.quality.empty()) value.set("quality", p.quality);
  return value;
}

/// Text filled with blanks to `columns`; a continuation byte of UTF-8 takes no column.
std::string padded(std::string_view text, int columns) {
  const auto width =
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; });
  return std::string(text) +
         std::string(static_cast<std::size_t>(std::max<std::ptrdiff_t>(columns - width, 1)), ' ');
}

std::string symbol_of(const FabricField& field) {
  return field.kes ? std::string(kes_quantity(*field.kes).symbol)
                   : field.key.substr(0, field.key.rfind("_gf"));
}

void print_numbers(const Console& console, Fabric& fabric, JsonValue& json) {
  console.line("  " + padded("section", 14) + padded("symbol", 12) + padded("value", 10) +
               padded("unit", 14) + padded("SI value", 12) + padded("SI unit", 12) + "kind");
  for (const FabricField& field : fabric_fields(fabric)) {
    if (!field.value->has_value()) continue;
    const double number = field.value->value / field.to_si;
    const std::string si_unit(field.kes ? kes_quantity(*field.kes).si_unit : "");
    console.line("  " + padded(field.section, 14) + padded(symbol_of(field), 12) +
                 padded(format_number(number), 10) + padded(field.unit, 14) +
                 padded(format_number(field.value->value), 12) + padded(si_unit, 12) +
                 to_string(field.value->provenance.kind));
    JsonValue entry;
    entry.set(field.key, number).set("si_value", field.value->value).set("si_unit", si_unit);
    entry.set("provenance", provenance_json(field.value->provenance));
    json.set(field.path(), std::move(entry));
  }
}

/// Each source once, with the first section that names it.
void print_sources(const Console& console, Fabric& fabric) {
  std::vector<std::string> seen;
  const auto add = [&](const std::string& section, const Provenance& p) {
    const std::string text =
        std::string(to_string(p.kind)) + ": " + p.source + (p.quality.empty() ? "" : " [" + p.quality + "]");
    if (std::ranges::find(seen, text) != seen.end()) return;
    seen.push_back(text);
    console.line("  " + section + ": " + text);
  };
  for (const FabricField& field : fabric_fields(fabric)) {
    if (field.value->has_value()) add(field.section, field.value->provenance);
  }
  for (const FabricCurveField& field : fabric_curve_fields(fabric)) {
    if (*field.curve) add(field.section, (*field.curve)->provenance);
  }
}

void print_laws(const Console& console, const FabricLaws& laws, JsonValue& json) {
  for (const LawReport& report : laws.reports) {
    std::string text = "  " + report.law + ": " + report.origin;
    if (report.origin == "measured loop") {
      text += ", rms residual " + format_number(100.0 * report.rms_residual_fraction) + " % of the peak";
    }
    console.line(text);
    JsonValue entry, assumptions{JsonValue::Array{}};
    for (const std::string& assumption : report.assumptions) {
      console.line("    assumed: " + assumption);
      assumptions.push(assumption);
    }
    entry.set("origin", report.origin).set("rms_residual_percent", 100.0 * report.rms_residual_fraction);
    entry.set("assumptions", std::move(assumptions));
    json.set(report.law, std::move(entry));
  }
}

}  // namespace

int run_fabrics(const Console& console) {
  JsonValue list{JsonValue::Array{}};
  for (const std::string& id : bundled_fabric_ids()) {
    Fabric fabric = load_fabric(id);
    const std::vector<std::string> measured = measured_blocks(fabric);
    char head[160];
    std::snprintf(head, sizeof head, "%-22s %5.0f g/m2  ", id.c_str(),
                  fabric.areal_mass.value / unit::kGPerM2);
    console.line(head + fabric.composition + "; measured: " + joined(measured) + "; " + first_source(fabric));
    JsonValue entry, blocks{JsonValue::Array{}};
    for (const std::string& block : measured) blocks.push(block);
    entry.set("id", id).set("name", fabric.name).set("composition", fabric.composition);
    entry.set("areal_mass_kg_per_m2", fabric.areal_mass.value).set("measured", std::move(blocks));
    entry.set("source", first_source(fabric));
    list.push(std::move(entry));
  }
  console.result(JsonValue().set("fabrics", std::move(list)));
  return 0;
}

int run_show(const Console& console, const ShowOptions& options) {
  const bool svg = options.plot.ends_with(".svg");
  if (!options.plot.empty() && !svg && !options.plot.ends_with(".png")) {
    throw Error(ErrorKind::kUsage, "--plot: cannot tell the kind of picture of '" + options.plot + "'", {},
                "end the name in .png or .svg");
  }
  Fabric fabric = load_fabric(options.fabric);
  const FabricLaws laws = make_fabric_laws(fabric);
  for (const std::string& warning : fabric.warnings) console.warn(warning);
  JsonValue json, numbers{JsonValue::Object{}}, law_json{JsonValue::Object{}}, warnings{JsonValue::Array{}};
  console.line(fabric.name + (fabric.composition.empty() ? "" : " (" + fabric.composition + ")"));
  if (!fabric.note.empty()) console.line("  " + fabric.note);
  print_numbers(console, fabric, numbers);
  console.line("Where the numbers come from");
  print_sources(console, fabric);
  console.line("Laws");
  print_laws(console, laws, law_json);
  for (const std::string& warning : fabric.warnings) warnings.push(warning);
  json.set("id", fabric.id)
      .set("name", fabric.name)
      .set("composition", fabric.composition)
      .set("note", fabric.note);
  json.set("numbers", std::move(numbers))
      .set("laws", std::move(law_json))
      .set("warnings", std::move(warnings));
  if (!options.plot.empty()) {
    const PlotGrid plot = fabric_plot(fabric, laws);
    write_atomically(options.plot, svg ? plot_svg(plot, 1400, 900) : plot_png(plot, 1400, 900, 1.0));
    console.say("wrote " + options.plot);
    json.set("plot", options.plot);
  }
  console.result(json);
  return 0;
}

}  // namespace fuai_app
