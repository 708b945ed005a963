// `fuai cantilever`: a strip that hangs under its own weight, and the bending length it shows.
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/experiments/overhang.h"
#include "fuai/io/fabric_library.h"
#include "fuai/units/constants.h"
#include "fuai/units/parse.h"

namespace fuai_app {

using namespace fuai;

namespace {

struct CantileverCommandOptions {
  std::string fabric;
  std::string direction = "warp";
  std::string length;         ///< with unit; empty with an angle
  std::string angle;          ///< of the chord, with unit: finds the overhang; empty with a length
  std::string width = "2cm";  ///< with unit
  std::string spacing;        ///< with unit; empty: a fortieth of the length
  bool elastic = false;
};

double length_value(const std::string& text, const char* option) {
  const double length = parse_value(text, kLength, option);
  if (!(length > 0.0)) {
    throw Error(ErrorKind::kUsage, std::string(option) + ": '" + text + "' is not more than 0", {},
                "give a length such as 10cm");
  }
  return length;
}

Direction direction_value(const std::string& text) {
  if (text == "warp") return Direction::kWarp;
  if (text == "weft") return Direction::kWeft;
  throw Error(ErrorKind::kUsage, "--direction: '" + text + "' is no direction of a strip", {},
              "take warp or weft");
}

JsonValue json_of(const CantileverOptions& options, const CantileverResult& r) {
  JsonValue json, assumptions{JsonValue::Array{}};
  json.set("reach_m", r.reach).set("droop_m", r.droop);
  json.set("tip_angle_deg", r.tip_angle / unit::kDegree);
  json.set("chord_angle_deg", r.chord_angle / unit::kDegree);
  json.set("bending_length_m", r.bending_length).set("bending_length_peirce_m", r.bending_length_peirce);
  json.set("bending_rigidity_gf_cm2_per_cm", r.bending_rigidity / unit::kGfCm2PerCm);
  json.set("length_m", options.length).set("width_m", options.width).set("spacing_m", r.spacing);
  json.set("direction", options.direction == Direction::kWarp ? "warp" : "weft");
  json.set("elastic", options.elastic);
  json.set("residual", r.equilibrium.residual).set("converged", r.equilibrium.converged);
  json.set("steps", r.equilibrium.steps);
  for (const std::string& sentence : r.assumptions) assumptions.push(sentence);
  return json.set("assumptions", assumptions);
}

void print(const Console& console, const Fabric& fabric, const CantileverOptions& options,
           const OverhangResult& found) {
  const CantileverResult& r = found.cantilever;
  const auto centimetres = [](double x) { return format_number(x / unit::kCentimetre) + " cm"; };
  const auto degrees = [](double x) { return format_number(x / unit::kDegree) + " deg"; };
  console.line(fabric.name + ", " + to_string(options.direction) + ", " + centimetres(options.length) +
               (options.elastic ? ", without friction" : ""));
  console.line("reach           " + centimetres(r.reach) + ", droop " + centimetres(r.droop));
  console.line("angle below level  " + degrees(r.tip_angle) + " at the tip, " + degrees(r.chord_angle) +
               " of the chord");
  console.line("bending length  " + centimetres(r.bending_length) + " (Peirce's formula " +
               centimetres(r.bending_length_peirce) + ")");
  if (found.runs > 0)
    console.line("half overhang   " + centimetres(found.half_overhang) + ", " +
                 format_number(found.rigidity / unit::kGfCm2PerCm) + " gf cm2/cm");
  console.line("rigidity        " + format_number(r.bending_rigidity / unit::kGfCm2PerCm) +
               " gf cm2/cm from weight and bending length");
  for (const std::string& sentence : r.assumptions) console.detail("assumed: " + sentence);
}

int run_cantilever(const Console& console, const CantileverCommandOptions& command) {
  CantileverOptions options;
  options.direction = direction_value(command.direction);
  if (!command.length.empty()) options.length = length_value(command.length, "--length");
  options.width = length_value(command.width, "--width");
  if (!command.spacing.empty()) options.spacing = length_value(command.spacing, "--spacing");
  options.elastic = command.elastic;
  const Fabric fabric = load_fabric(command.fabric);
  for (const std::string& warning : fabric.warnings) console.warn(warning);
  const FabricLaws laws = make_fabric_laws(fabric);
  OverhangResult found;
  if (command.angle.empty()) {
    found.cantilever = fuai::run_cantilever(laws, options, console.progress());
  } else {
    found = find_overhang(laws, options, parse_value(command.angle, kAngle, "--angle"), console.progress());
    options.length = found.overhang;
  }
  const CantileverResult& r = found.cantilever;
  print(console, fabric, options, found);
  JsonValue json = json_of(options, r);
  if (found.runs > 0) {
    json.set("overhang_m", found.overhang).set("half_overhang_m", found.half_overhang);
    json.set("half_overhang_rigidity_gf_cm2_per_cm", found.rigidity / unit::kGfCm2PerCm);
  }
  console.result(json.set("fabric", fabric.id));
  if (r.equilibrium.converged) return 0;
  throw Error(ErrorKind::kCheckFailed,
              "the strip did not come to rest: " + format_number(r.equilibrium.residual) +
                  " of its weight is out of balance",
              {}, "take another --spacing");
}

}  // namespace

void declare_cantilever(const Command& parent) {
  const auto options = std::make_shared<CantileverCommandOptions>();
  const Command command = parent.command(
      "cantilever", "A strip clamped level at one end, hanging under its own weight: bending length");
  command.option("FABRIC", options->fabric, "Bundled name or path of a fabric file").required();
  command.option("--direction", options->direction, "Yarns along the strip: warp or weft")
      .among({"warp", "weft"});
  const Command how = command.one_of("Length");
  how.option("--length", options->length, "Free length with unit, at least four spacings");
  how.option("--angle", options->angle,
             "Find the overhang whose chord lies at this angle below level: 41.5deg as ASTM D1388, or 43deg");
  command.option("--width", options->width, "Width with unit, at least two spacings");
  command.option("--spacing", options->spacing,
                 "Distance of the nodes with unit. Default: a fortieth of the length, at most half the "
                 "width");
  command.flag("--elastic", options->elastic, "Without friction: the elastic curves of the laws alone");
  command.examples({"fuai cantilever wool-tropical --length 10cm",
                    "fuai cantilever cupro-woven-su1098 --direction weft --length 8cm --elastic",
                    "fuai cantilever wool-tropical --angle 41.5deg",
                    "fuai --json cantilever graded-6 --length 15cm --spacing 5mm"});
  command.body([options](const Console& console) { return run_cantilever(console, *options); });
}

}  // namespace fuai_app
