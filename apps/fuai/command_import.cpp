// `fuai fabric import`.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "commands.h"
#include "fabric_text.h"
#include "fuai/core/error.h"
#include "fuai/fabric/laws.h"
#include "fuai/io/fabric_fields.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/fabric_import.h"
#include "fuai/io/text_file.h"
#include "fuai/units/parse.h"

namespace fuai_app {
namespace {

using namespace fuai;

struct ImportOptions {
  std::vector<std::string> files;
  std::string output;
  std::string name;       ///< replaces the name found in the files
  std::string mass;       ///< with unit; needed with curve files alone
  std::string thickness;  ///< with unit
  std::string test;       ///< for curve files without a fuai-curve line
  std::string direction;  ///< the same
};

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

/// A value given as an option; one that no cloth can have is wrong usage.
double positive_value(const std::string& text, Dimension dimension, const char* option) {
  const double value = parse_value(text, dimension, option);
  if (value > 0.0) return value;
  throw Error(ErrorKind::kUsage, std::string(option) + ": '" + text + "' is not above zero", {},
              "give what was measured, or leave the option out");
}

void apply_overrides(Fabric& fabric, const ImportOptions& options) {
  if (!options.name.empty()) fabric.name = options.name;
  const Provenance given{ProvenanceKind::kMeasured, "given to the importer by hand", ""};
  if (!options.mass.empty()) fabric.areal_mass = {positive_value(options.mass, kArealMass, "--mass"), given};
  if (!options.thickness.empty())
    fabric.thickness = {positive_value(options.thickness, kLength, "--thickness"), given};
}

/// What was taken over, with each residual and assumption of the laws that follow from it.
void print_summary(const Console& console, Fabric& fabric, const FabricLaws& laws, JsonValue& json) {
  JsonValue numbers{JsonValue::Object{}}, laws_json{JsonValue::Object{}}, warnings{JsonValue::Array{}};
  for (const FabricField& field : fabric_fields(fabric)) {
    if (!field.value->has_value()) continue;
    const Provenance& p = field.value->provenance;
    const double number = field.value->value / field.to_si;
    print_wrapped(console, "  " + field.path() + " = " + format_number(number) + " " + field.unit + "  ",
                  "(" + std::string(to_string(p.kind)) + (p.quality.empty() ? "" : "; " + p.quality) + ")",
                  4);
    numbers.set(field.path(), number);
  }
  console.line("Laws");
  print_laws(console, laws, laws_json);
  for (const std::string& warning : fabric.warnings) {
    console.warn(warning);
    warnings.push(warning);
  }
  json.set("name", fabric.name).set("numbers", std::move(numbers)).set("laws", std::move(laws_json));
  json.set("warnings", std::move(warnings));
}

/// All fabrics of the named files; exactly one unless there is one sheet.
ImportedFabrics read_all(const Console& console, const ImportOptions& options) {
  FabricImport import;
  import.files = options.files;
  import.curves = curve_options(options);
  import.name = fabric_id_of(options.output);
  import.has_mass = !options.mass.empty();
  ImportedFabrics read = import_fabrics(import);
  console.detail("read " + options.files.front() + " as " + read.kind);
  return read;
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

/// A fabric with the place it goes to.
struct Target {
  Fabric fabric;
  std::string path;
};

/// Where each fabric goes; a name that was given twice gets a number.
std::vector<Target> targets_of(std::vector<Fabric> fabrics, const ImportOptions& options) {
  namespace fs = std::filesystem;
  std::error_code code;
  const bool into_folder = options.output.ends_with('/') || fs::is_directory(options.output, code);
  if (fabrics.size() > 1 && !into_folder) {
    throw Error(ErrorKind::kUsage,
                "the sheet holds " + std::to_string(fabrics.size()) + " fabrics, -o names one file", {},
                "give a folder: -o fabrics/");
  }
  std::vector<Target> targets;
  std::set<std::string> taken;
  for (Fabric& fabric : fabrics) {
    apply_overrides(fabric, options);
    std::string path = options.output;
    if (into_folder) {
      const std::string first = file_stem(fabric.name);
      std::string stem = first;
      for (int count = 2; !taken.insert(stem).second; ++count) stem = first + "-" + std::to_string(count);
      path = (fs::path(options.output) / (stem + ".fabric.toml")).string();
    }
    fabric.id = fabric_id_of(path);
    targets.push_back({std::move(fabric), std::move(path)});
  }
  return targets;
}

/// Measurements are never replaced by what was made of them.
void check_inputs_survive(const Target& target, const std::vector<std::string>& inputs) {
  for (const std::string& path : fabric_file_paths(target.path, target.fabric)) {
    for (const std::string& input : inputs)
      check_input_survives(path, input, "give another -o: another folder or another name");
  }
}

/// The laws, with the input file named when they cannot be made.
FabricLaws laws_of(const Fabric& fabric, const ImportOptions& options) {
  try {
    return make_fabric_laws(fabric);
  } catch (const Error& e) {
    if (!e.where().file.empty()) throw;
    throw Error(e.kind(), e.problem(),
                {options.files.front(), e.where().line, e.where().column, e.where().key}, e.cure());
  }
}

void make_folder(const std::string& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) {
    throw Error(ErrorKind::kBadInput, "cannot make the folder: " + code.message(), {folder, 0, 0, ""},
                "name another folder with -o");
  }
}

int run_import(const Console& console, const ImportOptions& options) {
  // 1. Everything that can be wrong with the measurements, before anything is written.
  ImportedFabrics read = read_all(console, options);
  const std::vector<std::string> fits = std::move(read.fits);
  std::vector<Target> targets = targets_of(std::move(read.fabrics), options);
  std::vector<FabricLaws> laws;
  for (const Target& target : targets) {
    check_inputs_survive(target, options.files);
    laws.push_back(laws_of(target.fabric, options));
  }

  // 2. The files.
  if (options.output.ends_with('/')) make_folder(options.output);
  for (const Target& target : targets) {
    write_fabric_file(target.path, target.fabric);
    console.say("wrote " + target.path);
  }

  // 3. What was taken over.
  JsonValue json, list{JsonValue::Array{}}, fit_lines{JsonValue::Array{}};
  for (const std::string& line : fits) {
    print_wrapped(console, "  ", line, 4);
    fit_lines.push(line);
  }
  for (std::size_t i = 0; i < targets.size(); ++i) {
    console.line(targets[i].fabric.name);
    JsonValue entry;
    print_summary(console, targets[i].fabric, laws[i], entry);
    entry.set("file", targets[i].path);
    list.push(std::move(entry));
  }
  if (!fits.empty()) json.set("fits", std::move(fit_lines));
  json.set("fabrics", std::move(list));
  console.result(json);
  return 0;
}

}  // namespace

void declare_import(const Command& parent) {
  const auto options = std::make_shared<ImportOptions>();
  const Command command = parent.command(
      "import", "Measurements in: U3M/FAB physics JSON, KES curve CSV, KES sheet -> fabric file");
  command.option("FILE", options->files, "Files of one fabric; one KES sheet may hold several fabrics")
      .required();
  command
      .option("-o,--output", options->output, "Fabric file to write; a folder for a sheet of several fabrics")
      .required();
  command.option("--name", options->name, "Name of the fabric, instead of the one in the file");
  command.option("--mass", options->mass,
                 "Areal mass with unit, e.g. '16.3 mg/cm2'; needed with curve files alone");
  command.option("--thickness", options->thickness, "Thickness with unit, e.g. 0.4mm");
  command.option("--test", options->test,
                 "Test of a curve file that does not say: bending, shear, tensile, compression");
  command.option("--direction", options->direction,
                 "Direction of a curve file that does not say: warp, weft, bias");
  command.examples({"fuai fabric import cupro.physics.json -o cupro.fabric.toml",
                    "fuai fabric import bend-warp.csv bend-weft.csv --mass '16 mg/cm2' -o wool.fabric.toml",
                    "fuai fabric import kes-sheet.csv -o fabrics/"});
  command.body([options](const Console& console) { return run_import(console, *options); });
}

}  // namespace fuai_app
