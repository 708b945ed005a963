// `fuai report`.
// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "drape_options.h"
#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"
#include "fuai/laboratory/fabric_report.h"

namespace fuai_app {
namespace {

using namespace fuai;

struct ReportWords {
  std::vector<std::string> fabrics;
  std::string output;
  DrapeWords drape;
  bool no_kes = false;
};

ReportOptions options_of(const Console& console, const ReportWords& words) {
  if (!words.output.ends_with(".html")) {
    throw Error(ErrorKind::kUsage, "--output: '" + words.output + "' is no name of a page", {},
                "end the name in .html; a browser prints the page as PDF");
  }
  if (words.fabrics.size() != 1) check_compared_count(words.fabrics.size());
  ReportOptions options;
  options.drape = drape_options_of(console, words.drape);
  if (words.no_kes) options.kes.clear();
  options.version = FUAI_VERSION;
  options.names = words.fabrics;
  options.output = words.output;
  return options;
}

JsonValue json_of(const ReportedTest& reported) {
  JsonValue json;
  json.set("test", to_string(reported.test.test));
  json.set("direction", reported.test.direction ? to_string(*reported.test.direction) : "mean");
  const bool done = reported.trip.has_value();
  return json.set("loop_rms_percent", done ? JsonValue(100.0 * reported.trip->loop_rms) : JsonValue());
}

JsonValue json_of(const ReportedFabric& fabric) {
  const DrapeTest& drape = fabric.study.drape;
  JsonValue json, tests{JsonValue::Array{}}, spread, band{JsonValue::Array{}};
  for (const ReportedTest& reported : fabric.kes) tests.push(json_of(reported));
  spread.set("mean", 100.0 * drape.coefficient.mean).set("std", 100.0 * drape.coefficient.deviation);
  band.push(100.0 * drape.band_low).push(100.0 * drape.band_high);
  json.set("id", fabric.study.fabric.id).set("name", fabric.study.fabric.name).set("hash", fabric.hash);
  json.set("drape_coefficient_percent", spread).set("band_percent", band);
  json.set("node_count", drape.nodes.mean).set("at_rest", drape.at_rest());
  return json.set("kes", tests);
}

int run_report(const Console& console, const ReportWords& words) {
  const ReportOptions options = options_of(console, words);
  std::vector<Fabric> fabrics;
  for (const std::string& name : words.fabrics) {
    fabrics.push_back(load_fabric(name));
    for (const std::string& warning : fabrics.back().warnings) console.warn(warning);
  }
  // Before the long run: can it be drawn, and written?
  check_can_write(words.output);
  OffscreenRenderer renderer = make_offscreen_renderer();
  const FabricReport report = run_fabric_report(fabrics, options, console.progress());
  std::vector<StudyPictures> pictures;
  for (const ReportedFabric& fabric : report.fabrics) pictures.push_back(draw_study(fabric.study, renderer));
  const std::string page = report_html(report, options, pictures);
  write_atomically(words.output, page);
  JsonValue json, list{JsonValue::Array{}};
  for (const ReportedFabric& fabric : report.fabrics) {
    console.line(fabric.study.fabric.name + ": " + drape_in_words(fabric.study.drape));
    for (const ReportedTest& reported : fabric.kes)
      if (!reported.trip) console.warn(fabric.study.fabric.name + ": " + reported.failure);
    list.push(json_of(fabric));
  }
  console.say("wrote " + words.output + "; a browser prints it as PDF");
  json.set("file", words.output).set("bytes", static_cast<std::int64_t>(page.size()));
  json.set("version", options.version).set("seed", static_cast<std::int64_t>(options.drape.seed));
  json.set("fabrics", list).set("commands", repeating_commands(options));
  console.result(json);
  if (report.at_rest()) return 0;
  throw Error(ErrorKind::kCheckFailed, "a specimen did not come to rest; the page says which", {},
              "take another --spacing");
}

}  // namespace

void declare_report(const Command& parent) {
  const auto words = std::make_shared<ReportWords>();
  const Command command = parent.command(
      "report", "One self-contained page about a fabric, or a comparison of up to six, to repeat it from");
  command.option("FABRIC", words->fabrics, "One to six bundled names or paths of fabric files").required();
  command.option("-o,--output", words->output, "File to write: .html").required();
  declare_drape_options(command, words->drape);
  command.flag("--no-kes", words->no_kes, "Leave out the virtual KES instruments: 20 s of a core a fabric");
  command.examples({"fuai report wool-tropical -o wool.html",
                    "fuai report wool-tropical polyester-faille -o two.html --disc 12.7cm --specimen 25.4cm",
                    "fuai --json --seed 7 report graded-1 graded-10 -o graded.html --no-kes"});
  command.body([words](const Console& console) { return run_report(console, *words); });
}

}  // namespace fuai_app
