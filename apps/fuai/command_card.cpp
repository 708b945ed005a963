// `fuai fabric card`.
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include "commands.h"
#include "drape_options.h"
#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"
#include "fuai/laboratory/fabric_card.h"

namespace fuai_app {
namespace {

using namespace fuai;

struct CardOptions {
  std::string fabric, output;
  DrapeWords drape;
};

void check_name(const std::string& name) {
  for (const char* ending : {".png", ".svg", ".html"}) {
    if (name.ends_with(ending)) return;
  }
  throw Error(ErrorKind::kUsage, "--output: cannot tell the kind of file of '" + name + "'", {},
              "end the name in .png, .svg or .html");
}

std::string bytes_of(const FabricStudy& study, const StudyPictures& pictures, const std::string& name) {
  if (name.ends_with(".html")) return card_html(study, pictures, FUAI_VERSION);
  const Sheet sheet = card_sheet(study, pictures, FUAI_VERSION);
  return name.ends_with(".svg") ? sheet_svg(sheet) : sheet_png(sheet);
}

int run_card(const Console& console, const CardOptions& options) {
  check_name(options.output);
  const DrapeTestOptions drape = drape_options_of(console, options.drape);
  const Fabric fabric = load_fabric(options.fabric);
  for (const std::string& warning : fabric.warnings) console.warn(warning);
  // Before the long run: can it be drawn, and written?
  check_can_write(options.output);
  OffscreenRenderer renderer = make_offscreen_renderer();
  const FabricStudy study = run_fabric_study(fabric, drape, console.progress());
  write_atomically(options.output, bytes_of(study, draw_study(study, renderer), options.output));
  console.line(fabric.name + ": " + drape_in_words(study.drape));
  console.say("wrote " + options.output);
  JsonValue json;
  json.set("file", options.output).set("fabric", fabric.id);
  json.set("drape_coefficient_percent", 100.0 * study.drape.coefficient.mean);
  console.result(json.set("node_count", study.drape.nodes.mean).set("at_rest", study.drape.at_rest()));
  if (study.drape.at_rest()) return 0;
  throw Error(ErrorKind::kCheckFailed, "a specimen did not come to rest", {}, "take another --spacing");
}

}  // namespace

void declare_card(const Command& parent) {
  const auto options = std::make_shared<CardOptions>();
  const Command command =
      parent.command("card", "One page about a fabric: drape, loops, numbers in KES units and SI, sources");
  command.option("FABRIC", options->fabric, "Bundled name or path of a fabric file").required();
  command.option("-o,--output", options->output, "File to write: .png, .svg or .html").required();
  declare_drape_options(command, options->drape);
  command.examples({"fuai fabric card wool-tropical -o wool.png",
                    "fuai fabric card cupro-woven-su1098 -o cupro.html --disc 12.7cm --specimen 25.4cm"});
  command.body([options](const Console& console) { return run_card(console, *options); });
}

}  // namespace fuai_app
