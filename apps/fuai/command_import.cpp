// `fuai fabric import`.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/fabric/fab_report.h"
#include "fuai/fabric/from_curves.h"
#include "fuai/fabric/laws.h"
#include "fuai/io/curve_csv.h"
#include "fuai/io/fabric_fields.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/kes_sheet.h"
#include "fuai/io/text_file.h"
#include "fuai/io/u3m.h"
#include "fuai/units/parse.h"

namespace fuai_app {
namespace {

using namespace fuai;

/// What a file to import is, by its name and first bytes.
enum class FileKind { kPhysicsJson, kFabricFile, kCurve, kSheet };

FileKind kind_of(const std::string& path, const std::string& text, bool told_to_be_curve) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && (text[first] == '{' || text[first] == '[') && !path.ends_with(".toml")) {
    return FileKind::kPhysicsJson;
  }
  if (path.ends_with(".toml")) return FileKind::kFabricFile;
  if (told_to_be_curve || text.substr(0, 200).find("fuai-curve/") != std::string::npos)
    return FileKind::kCurve;
  return FileKind::kSheet;
}

CurveCsvOptions curve_options(const ImportOptions& options) {
  CurveCsvOptions result;
  const auto pick = [](const std::string& word, auto values, const char* option, const char* cure) {
    for (auto value : values) {
      if (word == to_string(value)) return value;
    }
    throw Error(ErrorKind::kUsage, std::string(option) + ": '" + word + "' is not known", {}, cure);
  };
  if (!options.test.empty()) {
    result.test =
        pick(options.test, std::vector{Test::kBending, Test::kShear, Test::kTensile, Test::kCompression},
             "--test", "use bending, shear, tensile or compression");
  }
  if (!options.direction.empty()) {
    result.direction =
        pick(options.direction, std::vector{Direction::kWarp, Direction::kWeft, Direction::kBias},
             "--direction", "use warp, weft or bias");
  }
  return result;
}

/// The fabric of a set of curve files: mass and thickness come from the options.
Fabric fabric_of_curves(const ImportOptions& options) {
  Fabric fabric;
  fabric.name = std::filesystem::path(options.output).stem().stem().string();
  if (options.mass.empty()) {
    throw Error(ErrorKind::kUsage, "curve files do not say what the fabric weighs", {},
                "add --mass, e.g. --mass '16.3 mg/cm2'");
  }
  for (const std::string& file : options.files) {
    MeasuredCurve curve = read_curve_csv(file, curve_options(options));
    for (const std::string& warning : curve_warnings(curve)) fabric.warnings.push_back(warning);
    add_measured_curve(fabric, {std::move(curve), {ProvenanceKind::kMeasured, "curve file " + file, ""}});
  }
  return fabric;
}

void apply_overrides(Fabric& fabric, const ImportOptions& options) {
  if (!options.name.empty()) fabric.name = options.name;
  const Provenance given{ProvenanceKind::kMeasured, "given to the importer by hand", ""};
  if (!options.mass.empty()) fabric.areal_mass = {parse_value(options.mass, kArealMass, "--mass"), given};
  if (!options.thickness.empty())
    fabric.thickness = {parse_value(options.thickness, kLength, "--thickness"), given};
}

/// What was taken over, with each residual and assumption of the laws that follow from it.
void print_summary(const Console& console, Fabric& fabric, JsonValue& json) {
  JsonValue numbers{JsonValue::Object{}}, laws_json{JsonValue::Object{}}, warnings{JsonValue::Array{}};
  for (const FabricField& field : fabric_fields(fabric)) {
    if (!field.value->has_value()) continue;
    const Provenance& p = field.value->provenance;
    const double number = field.value->value / field.to_si;
    console.line("  " + field.path() + " = " + format_number(number) + " " + field.unit + "  (" +
                 to_string(p.kind) + (p.quality.empty() ? "" : "; " + p.quality) + ")");
    numbers.set(field.path(), number);
  }
  const FabricLaws laws = make_fabric_laws(fabric);
  for (const LawReport& report : laws.reports) {
    console.line("  law " + report.law + ": " + report.origin + ", rms residual " +
                 format_number(100.0 * report.rms_residual_fraction) + " % of the peak");
    JsonValue entry, assumptions{JsonValue::Array{}};
    for (const std::string& assumption : report.assumptions) {
      console.line("    assumed: " + assumption);
      assumptions.push(assumption);
    }
    entry.set("origin", report.origin).set("rms_residual_percent", 100.0 * report.rms_residual_fraction);
    entry.set("assumptions", std::move(assumptions));
    laws_json.set(report.law, std::move(entry));
  }
  for (const std::string& warning : fabric.warnings) {
    console.warn(warning);
    warnings.push(warning);
  }
  json.set("name", fabric.name).set("numbers", std::move(numbers)).set("laws", std::move(laws_json));
  json.set("warnings", std::move(warnings));
}

void print_fab_report(const Console& console, const FabFitReport& report, JsonValue& json) {
  JsonValue lines{JsonValue::Array{}};
  for (const std::string& line : describe(report)) {
    console.line("  " + line);
    lines.push(line);
  }
  json.set("fits", std::move(lines));
}

/// All fabrics of the named files; exactly one unless there is one sheet.
std::vector<Fabric> read_all(const Console& console, const ImportOptions& options, JsonValue& json) {
  const bool told = !options.test.empty();
  const std::string& first = options.files.front();
  const FileKind kind = kind_of(first, read_text_file(first), told);
  if (kind == FileKind::kCurve) return {fabric_of_curves(options)};
  if (options.files.size() > 1) {
    throw Error(ErrorKind::kUsage, "several files make one fabric only when all of them are curve files", {},
                "import '" + first + "' on its own");
  }
  if (kind == FileKind::kFabricFile) return {read_fabric_file(first)};
  if (kind == FileKind::kSheet) return read_kes_sheet(first);
  FabFitReport report;
  Fabric fabric = make_fabric_from_fab(read_u3m_physics(first), &report);
  print_fab_report(console, report, json);
  return {std::move(fabric)};
}

/// File name of a fabric: lower case letters, digits and hyphens.
std::string file_stem(const std::string& name) {
  std::string stem;
  for (char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || byte >= 0x80) {
      stem += static_cast<char>(std::tolower(byte));
    } else if (!stem.empty() && stem.back() != '-') {
      stem += '-';
    }
  }
  while (!stem.empty() && stem.back() == '-') stem.pop_back();
  return stem.empty() ? "fabric" : stem;
}

}  // namespace

int run_import(const Console& console, const ImportOptions& options) {
  JsonValue json, list{JsonValue::Array{}};
  std::vector<Fabric> fabrics = read_all(console, options, json);
  const bool into_folder = options.output.ends_with('/') || std::filesystem::is_directory(options.output);
  if (fabrics.size() > 1 && !into_folder) {
    throw Error(ErrorKind::kUsage,
                "the sheet holds " + std::to_string(fabrics.size()) + " fabrics, -o names one file", {},
                "give a folder: -o fabrics/");
  }
  if (into_folder) std::filesystem::create_directories(options.output);
  for (Fabric& fabric : fabrics) {
    apply_overrides(fabric, options);
    const std::string path =
        into_folder
            ? (std::filesystem::path(options.output) / (file_stem(fabric.name) + ".fabric.toml")).string()
            : options.output;
    fabric.id = fabric_id_of(path);
    console.line(fabric.name);
    JsonValue entry;
    print_summary(console, fabric, entry);
    write_fabric_file(path, fabric);
    console.say("wrote " + path);
    entry.set("file", path);
    list.push(std::move(entry));
  }
  json.set("fabrics", std::move(list));
  console.result(json);
  return 0;
}

}  // namespace fuai_app
