// `fuai fabric show`.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <string>

#include "commands.h"
#include "fabric_text.h"
#include "fuai/core/error.h"
#include "fuai/experiments/fabric_plot.h"
#include "fuai/io/fabric_fields.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"

namespace fuai_app {
namespace {

using namespace fuai;

struct ShowOptions {
  std::string fabric;
  std::string plot;  ///< .png or .svg; empty: none
};

constexpr int kPlotWidth = 1400, kPlotHeight = 900;  // pixels

JsonValue provenance_json(const Provenance& p) {
  JsonValue value;
  value.set("kind", to_string(p.kind)).set("source", p.source);
  if (!p.quality.empty()) value.set("quality", p.quality);
  return value;
}

std::string symbol_of(const FabricField& field) {
  return field.kes ? std::string(kes_quantity(*field.kes).symbol)
                   : field.key.substr(0, field.key.rfind(field.unit == "1/cm" ? "_per" : "_gf"));
}

/// SI unit of a field; those that are no KES quantity are loads, lengths and counts.
std::string si_unit_of(const FabricField& field) {
  if (field.kes) return std::string(kes_quantity(*field.kes).si_unit);
  return field.unit == "gf/cm" ? "N/m" : field.unit == "cm" ? "m" : field.unit == "1/cm" ? "1/m" : "-";
}

void print_numbers(const Console& console, Fabric& fabric, JsonValue& json) {
  console.line("  " + padded("section", 14) + padded("symbol", 12) + padded("value", 10) +
               padded("unit", 14) + padded("SI value", 12) + padded("SI unit", 12) + "kind");
  for (const FabricField& field : fabric_fields(fabric)) {
    if (!field.value->has_value()) continue;
    const double number = field.value->value / field.to_si;
    const std::string si_unit = si_unit_of(field);
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

/// Texts in the order of their first appearance, each with the places that carry it.
class Grouped {
 public:
  void add(const std::string& text, const std::string& place) {
    auto entry = std::ranges::find(entries_, text, &Entry::text);
    if (entry == entries_.end()) entry = entries_.insert(entry, Entry{text, {}});
    if (std::ranges::find(entry->places, place) == entry->places.end()) entry->places.push_back(place);
  }
  struct Entry {
    std::string text;
    std::vector<std::string> places;
  };
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

/// Each source once with the sections it covers, then each remark on quality, its first clause. The whole
/// remarks are long; --json has them.
void print_sources(const Console& console, Fabric& fabric) {
  Grouped sources, remarks;
  const auto add = [&](const std::string& section, const Provenance& p) {
    sources.add(p.source, section);
    if (!p.quality.empty()) remarks.add(shortened(p.quality, kTextColumns - 24), section);
  };
  for (const FabricField& field : fabric_fields(fabric)) {
    if (field.value->has_value()) add(field.section, field.value->provenance);
  }
  for (const FabricCurveField& field : fabric_curve_fields(fabric)) {
    if (*field.curve) add(field.section, (*field.curve)->provenance);
  }
  console.line("Where the numbers come from");
  for (const Grouped::Entry& entry : sources.entries())
    print_wrapped(console, "  " + joined(entry.places) + ": ", entry.text, 4);
  if (remarks.entries().empty()) return;
  console.line("How good they are (first clauses; --json has the whole remarks)");
  for (const Grouped::Entry& entry : remarks.entries())
    print_wrapped(console, "  " + joined(entry.places) + ": ", entry.text, 4);
}

void write_plot(const Console& console, const std::string& path, const Fabric& fabric,
                const FabricLaws& laws) {
  const PlotGrid plot = fabric_plot(fabric, laws);
  write_atomically(path, path.ends_with(".svg") ? plot_svg(plot, kPlotWidth, kPlotHeight)
                                                : plot_png(plot, kPlotWidth, kPlotHeight, 1.0));
  console.say("wrote " + path);
}

int run_show(const Console& console, const ShowOptions& options) {
  const bool plotted = !options.plot.empty();
  if (plotted && !options.plot.ends_with(".svg") && !options.plot.ends_with(".png")) {
    throw Error(ErrorKind::kUsage, "--plot: cannot tell the kind of picture of '" + options.plot + "'", {},
                "end the name in .png or .svg");
  }
  Fabric fabric = load_fabric(options.fabric);
  const FabricLaws laws = make_fabric_laws(fabric);
  if (plotted) write_plot(console, options.plot, fabric, laws);

  JsonValue json, numbers{JsonValue::Object{}}, law_json{JsonValue::Object{}}, warnings{JsonValue::Array{}};
  for (const std::string& warning : fabric.warnings) {
    console.warn(warning);
    warnings.push(warning);
  }
  console.line(fabric.name + (fabric.composition.empty() ? "" : " (" + fabric.composition + ")"));
  if (!fabric.note.empty()) print_wrapped(console, "  ", fabric.note, 2);
  print_numbers(console, fabric, numbers);
  print_sources(console, fabric);
  console.line("Laws");
  print_laws(console, laws, law_json);
  json.set("id", fabric.id)
      .set("name", fabric.name)
      .set("composition", fabric.composition)
      .set("note", fabric.note)
      .set("numbers", std::move(numbers))
      .set("laws", std::move(law_json))
      .set("warnings", std::move(warnings));
  if (plotted) json.set("plot", options.plot);
  console.result(json);
  return 0;
}

}  // namespace

void declare_show(const Command& parent) {
  const auto options = std::make_shared<ShowOptions>();
  const Command command = parent.command("show", "Every parameter in KES units and SI with its provenance");
  command.option("FABRIC", options->fabric, "Bundled name or path of a fabric file").required();
  command.option("--plot", options->plot, "Draw measured points and fitted loops into FILE.png or FILE.svg");
  command.examples(
      {"fuai fabric show wool-tropical", "fuai fabric show cupro-woven-su1098 --plot cupro.svg"});
  command.body([options](const Console& console) { return run_show(console, *options); });
}

}  // namespace fuai_app
