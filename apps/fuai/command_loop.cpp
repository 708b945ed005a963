// `fuai loop`: a strip hangs in a loop from the clamp that holds both its ends.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <string>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/laboratory/hanging_loop.h"
#include "fuai/units/constants.h"
#include "fuai/units/parse.h"

namespace fuai_app {

using namespace fuai;

namespace {

struct LoopCommandOptions {
  std::string kind;  ///< heart, pear or ring
  std::string fabric;
  std::string direction = "warp";
  std::string length = "10cm";  ///< with unit
  int segments = 80;
  bool elastic = false;
};

int run_loop(const Console& console, const LoopCommandOptions& command) {
  HangingLoopOptions options;
  options.kind = command.kind == "heart" ? LoopKind::kHeart
                                         : (command.kind == "pear" ? LoopKind::kPear : LoopKind::kRing);
  options.direction = command.direction == "weft" ? Direction::kWeft : Direction::kWarp;
  options.length = parse_value(command.length, kLength, "--length");
  options.segments = command.segments;
  options.elastic = command.elastic;
  const Fabric fabric = load_fabric(command.fabric);
  for (const std::string& warning : fabric.warnings) console.warn(warning);
  const HangingLoopResult r = run_hanging_loop(make_fabric_laws(fabric), options, console.progress());
  const auto centimetres = [](double x) { return format_number(x / unit::kCentimetre) + " cm"; };
  console.line(fabric.name + ", " + command.direction + ", " + command.kind + " loop of " +
               centimetres(options.length) + (options.elastic ? ", without friction" : ""));
  console.line("height          " + centimetres(r.height));
  if (std::isnan(r.bending_length)) {
    console.line(r.height > elastica_loop(options.kind, 0.0).height * options.length
                     ? "bending length  none: the strip is too long for its stiffness"
                     : "bending length  none: the strip stands higher than one without weight would");
  } else {
    console.line("bending length  " + centimetres(r.bending_length) + " (exact loop)");
    console.line("rigidity        " + format_number(r.bending_rigidity / unit::kGfCm2PerCm) +
                 " gf cm2/cm from weight and bending length");
  }
  for (const std::string& sentence : r.assumptions) console.detail("assumed: " + sentence);
  JsonValue json, assumptions{JsonValue::Array{}};
  for (const std::string& sentence : r.assumptions) assumptions.push(sentence);
  json.set("height_m", r.height).set("bending_length_m", r.bending_length);
  json.set("bending_rigidity_gf_cm2_per_cm", r.bending_rigidity / unit::kGfCm2PerCm);
  json.set("loop", command.kind).set("length_m", options.length).set("spacing_m", r.spacing);
  json.set("direction", command.direction).set("elastic", options.elastic);
  json.set("iterations", r.iterations).set("assumptions", assumptions);
  console.result(json.set("fabric", fabric.id));
  return 0;
}

}  // namespace

void declare_loop(const Command& parent) {
  const auto options = std::make_shared<LoopCommandOptions>();
  constexpr int kFewestSegments = 16, kMostSegments = 1000;
  const Command command = parent.command(
      "loop", "A strip whose ends are brought together in a clamp hangs in a loop: height, bending length");
  command
      .option("LOOP", options->kind, "heart, pear or ring: the ends leave the clamp upward, downward, level")
      .among({"heart", "pear", "ring"})
      .required();
  command.option("FABRIC", options->fabric, "Bundled name or path of a fabric file").required();
  command.option("--direction", options->direction, "Yarns along the strip: warp or weft")
      .among({"warp", "weft"});
  command.option("--length", options->length, "Of the strip between the clamps, with unit");
  command.option("--segments", options->segments, "Yarn crossings along the strip")
      .range(kFewestSegments, kMostSegments);
  command.flag("--elastic", options->elastic, "Without friction: the elastic curves of the laws alone");
  command.examples({"fuai loop heart wool-tropical",
                    "fuai loop pear cotton-knit-shirley --direction weft --length 15cm --elastic"});
  command.body([options](const Console& console) { return run_loop(console, *options); });
}

}  // namespace fuai_app
