// `fuai drape`: a virtual drape tester.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "commands.h"
#include "drape_options.h"
#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"
#include "fuai/laboratory/drape_files.h"
#include "fuai/laboratory/drape_test.h"
#include "fuai/units/constants.h"
#include "fuai/units/parse.h"

namespace fuai_app {

using namespace fuai;

namespace {

struct DrapeCommandOptions {
  std::string fabric;
  DrapeWords test;
  std::string path = "ramp";  ///< ramp, release, shakes or support
  std::string solver = "implicit";
  std::string loading = "2s";  ///< time with unit, of the ramp or of lowering the support
  std::string linger;          ///< time with unit to go on at rest; empty: none
  std::string out;             ///< folder; empty: no files
  bool elastic = false;        ///< without friction
  bool convergence = false;    ///< at other spacings too
};

/// A measured drape coefficient belongs to a geometry when both sizes agree this well [m].
constexpr double kSameSize = 1e-3;

double points(double coefficient) { return coefficient / unit::kPercent; }

std::string fixed(double value, int decimals) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

DrapePath path_value(const std::string& text) {
  if (text == "ramp") return DrapePath::kRamp;
  if (text == "release") return DrapePath::kRelease;
  if (text == "shakes") return DrapePath::kShakes;
  return DrapePath::kSupport;  // the only other word that the parser lets through
}

DrapeTestOptions options_of(const Console& console, const DrapeCommandOptions& command) {
  DrapeTestOptions options = drape_options_of(console, command.test);
  options.method.path = path_value(command.path);
  options.method.solver = command.solver == "explicit" ? DrapeSolver::kExplicit : DrapeSolver::kImplicit;
  options.method.loading = parse_value(command.loading, kTime, "--ramp");
  options.method.linger = command.linger.empty() ? 0.0 : parse_value(command.linger, kTime, "--linger");
  options.elastic = command.elastic;
  return options;
}

JsonValue numbers(const std::vector<double>& values, double factor) {
  JsonValue array{JsonValue::Array{}};
  for (const double value : values) array.push(factor * value);
  return array;
}

JsonValue spread_json(const DrapeSpread& spread, double factor) {
  JsonValue json;
  json.set("mean", factor * spread.mean).set("std", factor * spread.deviation);
  json.set("min", factor * spread.low).set("max", factor * spread.high);
  return json.set("each", numbers(spread.each, factor));
}

JsonValue bands_json(const DrapeTest& test) {
  JsonValue json{JsonValue::Object{}};
  for (const DrapeBand& band : test.bands) {
    JsonValue one;
    one.set("what", band.what).set("at_least_points", points(band.at_least));
    json.set(band.key, one.set("at_most_points", points(band.at_most)));
  }
  return json;
}

JsonValue locking_json(const YarnLocking& yarn) {
  JsonValue json;
  json.set("stiffness_N_per_m", yarn.stiffness).set("limit_N_per_m", yarn.limit);
  return json.set("factor", yarn.factor);
}

JsonValue specimens_json(const DrapeTest& test) {
  JsonValue array{JsonValue::Array{}};
  for (const DrapeSample& sample : test.samples) {
    const DrapeRun& run = sample.run;
    JsonValue json;
    json.set("seed", static_cast<std::int64_t>(sample.seed));
    json.set("drape_coefficient_percent", points(run.shadow.coefficient));
    json.set("node_count", static_cast<std::int64_t>(run.shadow.nodes.size()));
    json.set("node_amplitude_m", run.shadow.mean_amplitude());
    json.set("residual", run.residual).set("at_rest", run.at_rest).set("cloth_seconds", run.seconds);
    json.set("steps", run.steps).set("iterations", run.iterations).set("cpu_seconds", sample.cpu_seconds);
    array.push(json);
  }
  return array;
}

JsonValue measured_json(const DrapeMeasurement& measured) {
  JsonValue json;
  if (!measured.drape_coefficient.has_value()) return json;
  json.set("drape_coefficient_percent", points(measured.drape_coefficient.value));
  json.set("node_count", measured.node_count.value);
  json.set("disc_m", measured.disc_diameter.value);
  return json.set("specimen_m", measured.specimen_diameter.value);
}

JsonValue convergence_json(const DrapeConvergence& convergence) {
  JsonValue array{JsonValue::Array{}};
  for (const DrapeTest& test : convergence.tests) {
    JsonValue json;
    json.set("spacing_m", test.options.geometry.spacing);
    json.set("drape_coefficient_percent", spread_json(test.coefficient, 100.0));
    array.push(json.set("node_count", test.nodes.mean));
  }
  return array;
}

JsonValue json_of(const DrapeCommandOptions& command, const DrapeTest& test) {
  const DrapeGeometry& g = test.options.geometry;
  JsonValue json, histogram{JsonValue::Object{}}, assumptions{JsonValue::Array{}}, locking;
  json.set("drape_coefficient_percent", spread_json(test.coefficient, 100.0));
  json.set("node_count", test.nodes.mean).set("node_counts", numbers(test.nodes.each, 1.0));
  for (const auto& [nodes, specimens] : test.node_histogram) histogram.set(std::to_string(nodes), specimens);
  json.set("node_histogram", histogram).set("residual", test.residual()).set("seconds", test.seconds);
  json.set("at_rest", test.at_rest());
  json.set("band_percent", JsonValue::Array{points(test.band_low), points(test.band_high)});
  json.set("bands", bands_json(test));
  locking.set("warp", locking_json(test.locking[0])).set("weft", locking_json(test.locking[1]));
  json.set("locking", locking).set("specimens", specimens_json(test));
  json.set("disc_m", g.disc).set("specimen_m", g.specimen).set("spacing_m", g.spacing);
  json.set("path", command.path).set("solver", command.solver).set("elastic", command.elastic);
  for (const std::string& sentence : test.assumptions) assumptions.push(sentence);
  return json.set("assumptions", assumptions);
}

/// "measured 49.8 %, 5 nodes"; empty when nothing was measured.
std::string measured_text(const Fabric& fabric, const DrapeGeometry& g) {
  const DrapeMeasurement& m = fabric.drape;
  if (!m.drape_coefficient.has_value()) return {};
  std::string text = "measured " + fixed(points(m.drape_coefficient.value), 1) + " %";
  if (m.node_count.has_value()) text += ", " + fixed(m.node_count.value, 0) + " nodes";
  if (!m.disc_diameter.has_value() || !m.specimen_diameter.has_value())
    return text + " (the sizes of the tester are not stated)";
  const bool same = std::abs(m.disc_diameter.value - g.disc) < kSameSize &&
                    std::abs(m.specimen_diameter.value - g.specimen) < kSameSize;
  return same ? text
              : text + " on another tester, " + format_number(m.disc_diameter.value / unit::kCentimetre) +
                    " and " + format_number(m.specimen_diameter.value / unit::kCentimetre) + " cm";
}

void print_test(const Console& console, const Fabric& fabric, const DrapeTest& test) {
  const DrapeGeometry& g = test.options.geometry;
  console.line(fabric.name + ", disc " + format_number(g.disc / unit::kCentimetre) + " cm, specimen " +
               format_number(g.specimen / unit::kCentimetre) + " cm, spacing " +
               format_number(g.spacing / unit::kMillimetre) + " mm" +
               (test.options.elastic ? ", without friction" : ""));
  const DrapeSpread& c = test.coefficient;
  std::string text = "drape coefficient  " + fixed(points(c.mean), 1) + " %";
  if (test.samples.size() > 1) {
    text += " +- " + fixed(points(c.deviation), 1) + " over " + std::to_string(test.samples.size()) +
            " specimens (" + fixed(points(c.low), 1) + " to " + fixed(points(c.high), 1) + ")";
  }
  console.line(text);
  for (const DrapeBand& band : test.bands) {
    console.line("  assumed " + band.what + ": " + (band.at_least >= 0.0 ? "+" : "") +
                 fixed(points(band.at_least), 1) + " to " + (band.at_most >= 0.0 ? "+" : "") +
                 fixed(points(band.at_most), 1) + " points");
  }
  if (!test.bands.empty()) {
    console.line("  together           " + fixed(points(test.band_low), 1) + " to " +
                 fixed(points(test.band_high), 1) + " %");
  }
  text = "nodes              " + fixed(test.nodes.mean, 1) + " (";
  for (const auto& [nodes, specimens] : test.node_histogram)
    text += (text.back() == '(' ? "" : ", ") + std::to_string(specimens) + " x " + std::to_string(nodes);
  double amplitude = 0.0;
  for (const DrapeSample& sample : test.samples) amplitude += sample.run.shadow.mean_amplitude();
  amplitude /= static_cast<double>(test.samples.size());
  console.line(text + "), amplitude " + fixed(amplitude / unit::kMillimetre, 1) + " mm");
  const std::string measured = measured_text(fabric, g);
  if (!measured.empty()) console.line(measured);
  for (const std::string& sentence : test.assumptions) console.detail("assumed: " + sentence);
}

void print_convergence(const Console& console, const DrapeConvergence& convergence) {
  for (const DrapeTest& test : convergence.tests) {
    console.line("  " + format_number(test.options.geometry.spacing / unit::kMillimetre) +
                 " mm: " + fixed(points(test.coefficient.mean), 1) + " % +- " +
                 fixed(points(test.coefficient.deviation), 1) + ", " + fixed(test.nodes.mean, 1) + " nodes");
  }
}

/// Makes the folder and finds out whether it can be written to, before the long run.
void prepare_folder(const std::string& out) {
  std::error_code code;
  std::filesystem::create_directories(out, code);
  if (code) {
    throw Error(ErrorKind::kBadInput, "cannot make the folder: " + code.message(), {out, 0, 0, ""},
                "name another folder with --out");
  }
  check_can_write((std::filesystem::path(out) / "mesh.obj").string());
}

/// Writes everything; without a graphics driver what needs none, and then says so.
std::vector<std::string> write_files(const std::string& out, const Fabric& fabric, const DrapeTest& test,
                                     const DrapeConvergence& convergence, std::optional<Error>& no_device) {
  std::vector<OutputFile> files = drape_files(test, convergence, fabric.name);
  try {
    for (OutputFile& file : drape_pictures(test, convergence, fabric.name)) files.push_back(std::move(file));
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::kNoDevice) throw;
    no_device = e;
  }
  std::vector<NamedText> texts;
  std::vector<std::string> names;
  for (OutputFile& file : files) {
    names.push_back((std::filesystem::path(out) / file.name).string());
    texts.push_back({names.back(), std::move(file.bytes)});
  }
  write_together(texts);
  return names;
}

int run_drape(const Console& console, const DrapeCommandOptions& command) {
  const DrapeTestOptions options = options_of(console, command);
  const Fabric fabric = load_fabric(command.fabric);
  for (const std::string& warning : fabric.warnings) console.warn(warning);
  const FabricLaws laws = make_fabric_laws(fabric);
  if (!command.out.empty()) prepare_folder(command.out);
  const DrapeTest test = run_drape_test(laws, options, console.progress());
  print_test(console, fabric, test);
  if (test.coefficient.mean < kMayTouch)
    console.warn("folds of so limp a drape may touch, which is not simulated: they pass through each other");
  JsonValue json = json_of(command, test);
  json.set("fabric", fabric.id).set("measured", measured_json(fabric.drape));
  DrapeConvergence convergence;
  if (command.convergence) {
    convergence = run_drape_convergence(laws, options, console.progress());
    print_convergence(console, convergence);
    json.set("convergence", convergence_json(convergence));
  }
  std::optional<Error> no_device;
  if (!command.out.empty()) {
    JsonValue files{JsonValue::Array{}};
    for (const std::string& name : write_files(command.out, fabric, test, convergence, no_device))
      files.push(name);
    json.set("files", files);
    console.line("wrote shadow, pictures, mesh and tables into " + command.out);
  }
  console.result(json);
  if (no_device) throw Error(*no_device);
  if (test.at_rest()) return 0;
  throw Error(ErrorKind::kCheckFailed,
              "a specimen did not come to rest: " + format_number(test.residual()) +
                  " of a node's weight is out of balance",
              {}, "take another --spacing");
}

}  // namespace

void declare_drape(const Command& parent) {
  const auto options = std::make_shared<DrapeCommandOptions>();
  const Command command =
      parent.command("drape", "The drape test: drape coefficient, nodes, shadow, pictures, mesh");
  command.option("FABRIC", options->fabric, "Bundled name or path of a fabric file").required();
  declare_drape_options(command, options->test);
  command
      .option("--path", options->path,
              "How the weight comes on: gravity ramp, sudden release, ramp and three shakes, lowered support")
      .among({"ramp", "release", "shakes", "support"});
  command.option("--ramp", options->loading, "How long the weight, or the support, takes, e.g. 4s");
  command.flag("--elastic", options->elastic, "Without friction: the elastic curves of the laws alone");
  command.flag("--convergence", options->convergence,
               "At 2, 1.5, 1 and 0.75 times the spacing too, with a plot in --out");
  command.option("--solver", options->solver, "implicit, or explicit: the oracle, minutes a specimen")
      .among({"implicit", "explicit"});
  command.option("--linger", options->linger, "Goes on so long once the cloth rests, e.g. 2s");
  command.option("--out", options->out, "Folder for shadow, pictures, mesh and tables").file();
  command.examples({"fuai drape wool-tropical --out drape",
                    "fuai drape polyester-faille --disc 12.7cm --specimen 25.4cm",
                    "fuai --json --seed 7 drape graded-6 --runs 2 --elastic"});
  command.body([options](const Console& console) { return run_drape(console, *options); });
}

}  // namespace fuai_app
