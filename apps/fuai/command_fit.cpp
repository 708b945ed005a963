// `fuai fabric fit`: a fabric from a cantilever or a drape tester alone.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bands_text.h"
#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/experiments/overhang.h"
#include "fuai/fabric/laws.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/text_file.h"
#include "fuai/laboratory/fit_bending.h"
#include "fuai/units/constants.h"
#include "fuai/units/parse.h"

namespace fuai_app {

using namespace fuai;

namespace {

using Words = std::vector<std::string>;

struct FitOptions {
  std::string output, name, composition, mass, thickness;
  Words overhang_warp, overhang_weft, length_warp, length_weft;  ///< readings with unit
  std::string angle = "41.5deg";
  Words drape;  ///< readings in percent
  int runs = 5;
  bool no_bands = false;
  BandCommandOptions bands;
};

double positive(const std::string& text, Dimension dimension, const char* option) {
  const double value = parse_value(text, dimension, option);
  if (value > 0.0) return value;
  throw Error(ErrorKind::kUsage, std::string(option) + ": '" + text + "' is not above zero", {},
              "give what was measured");
}

Readings readings(const Words& words, Dimension dimension, const char* option, double factor = 1.0) {
  std::vector<double> values;
  for (const std::string& word : words) values.push_back(factor * positive(word, dimension, option));
  return readings_of(values);
}

/// The overhangs of a direction, from readings of either kind.
Readings overhang_of(const FitOptions& o, Direction direction, double angle) {
  const bool warp = direction == Direction::kWarp;
  const Words& overhang = warp ? o.overhang_warp : o.overhang_weft;
  const Words& length = warp ? o.length_warp : o.length_weft;
  if (!overhang.empty() && !length.empty())
    throw Error(
        ErrorKind::kUsage,
        std::string("overhang and bending length of the ") + to_string(direction) + " are one measurement",
        {}, "give one of the two");
  if (!overhang.empty()) return readings(overhang, kLength, warp ? "--overhang-warp" : "--overhang-weft");
  if (length.empty()) return {};
  if (std::abs(angle - kFlexometerAngle) > 1e-6)
    throw Error(ErrorKind::kUsage, "the bending length of the standards is half the overhang at 41.5 degrees",
                {}, "give the overhang with --angle");
  return readings(length, kLength, warp ? "--bending-length-warp" : "--bending-length-weft", 2.0);
}

Fabric fabric_of(const FitOptions& o) {
  Fabric fabric;
  fabric.id = fabric_id_of(o.output);
  fabric.name = o.name.empty() ? fabric.id : o.name;
  fabric.composition = o.composition;
  const Provenance given{ProvenanceKind::kMeasured, "given to `fuai fabric fit` by hand", ""};
  fabric.areal_mass = {positive(o.mass, kArealMass, "--mass"), given};
  if (!o.thickness.empty()) fabric.thickness = {positive(o.thickness, kLength, "--thickness"), given};
  return fabric;
}

std::string readings_text(const Readings& r) {
  return std::to_string(r.count) + (r.count == 1 ? " reading" : " readings");
}

std::string percent(double part) { return format_number(100.0 * part) + " %"; }

JsonValue fit_json(const BendingFit& fit) {
  const auto B = [](double value) { return value / unit::kGfCm2PerCm; };
  JsonValue json;
  json.set("B_gf_cm2_per_cm", B(fit.B())).set("low", B(fit.low())).set("high", B(fit.high()));
  json.set("2HB_gf_cm_per_cm", fit.hysteresis() / unit::kGfCmPerCm);
  JsonValue ends{JsonValue::Array{}};
  for (std::size_t i = 0; i < 3; ++i) {
    JsonValue end;
    end.set("2HB_over_B_per_cm", fit.hysteresis_ratio[i] / unit::kPerCentimetre);
    ends.push(end.set("B_gf_cm2_per_cm", B(fit.rigidity[i])));
  }
  json.set("by_friction", ends).set("noise_percent", 100.0 * fit.noise);
  return json.set("without_friction_B_gf_cm2_per_cm", B(fit.apparent));
}

void print_fit(const Console& console, const char* direction, const BendingFit& fit) {
  const auto B = [](double value) { return format_number(value / unit::kGfCm2PerCm); };
  console.line(std::string("B ") + direction + "  " + B(fit.B()) + " gf cm2/cm, between " + B(fit.low()) +
               " and " + B(fit.high()));
  for (std::size_t i = 0; i < 3; ++i) {
    console.line("  " + B(fit.rigidity[i]) +
                 " with 2HB = " + format_number(fit.hysteresis_ratio[i] / unit::kPerCentimetre) +
                 " /cm times B" + (i == 1 ? ", the rule of the fibre" : ""));
  }
  if (!std::isnan(fit.apparent)) console.line("  " + B(fit.apparent) + " if there were no friction");
  console.line("  noise " + percent(fit.noise));
}

/// What was fitted, for files and bands.
struct Fitted {
  Fabric fabric;
  FabricUncertainty uncertainty;
  JsonValue json{JsonValue::Object{}};
};

Fitted fit_cantilever(const Console& console, const FitOptions& o) {
  Fitted made{fabric_of(o), {}, JsonValue(JsonValue::Object{})};
  const double angle = parse_value(o.angle, kAngle, "--angle");
  for (const Direction direction : {Direction::kWarp, Direction::kWeft}) {
    const Readings overhang = overhang_of(o, direction, angle);
    if (overhang.count == 0) continue;
    const BendingFit fit = fit_bending_to_overhang(made.fabric, overhang, angle);
    put_bending(made.fabric, direction, fit,
                "an overhang of " + format_number(overhang.mean / unit::kCentimetre) + " cm at " +
                    format_number(angle / unit::kDegree) + " deg, " + readings_text(overhang));
    made.uncertainty.bending[static_cast<std::size_t>(direction)] = fit;
    print_fit(console, to_string(direction), fit);
    made.json.set(to_string(direction), fit_json(fit));
  }
  return made;
}

Fitted fit_drape(const Console& console, const FitOptions& o) {
  Fitted made{fabric_of(o), {}, JsonValue(JsonValue::Object{})};
  const Readings drape = readings(o.drape, kDimensionless, "--drape");
  if (!(drape.mean < 1.0))
    throw Error(ErrorKind::kUsage, "--drape: a drape coefficient is below 100 %", {},
                "write it with the sign: 49.8%");
  DrapeFitOptions options;
  options.geometry = geometry_of(o.bands);
  options.runs = o.runs;
  options.seed = console.options().seed;
  options.threads = console.options().threads;
  const BendingFit fit = fit_bending_to_drape(made.fabric, drape, options, console.progress());
  const auto centimetres = [](double x) { return format_number(x / unit::kCentimetre) + " cm"; };
  const std::string test = "a drape coefficient of " + percent(drape.mean) + ", disc " +
                           centimetres(options.geometry.disc) + ", specimen " +
                           centimetres(options.geometry.specimen) + ", " + readings_text(drape);
  const Provenance measured{ProvenanceKind::kMeasured, "given to `fuai fabric fit` by hand", ""};
  made.fabric.drape.drape_coefficient = {drape.mean, measured};
  made.fabric.drape.disc_diameter = {options.geometry.disc, measured};
  made.fabric.drape.specimen_diameter = {options.geometry.specimen, measured};
  for (const Direction direction : {Direction::kWarp, Direction::kWeft}) {
    put_bending(made.fabric, direction, fit, test + "; one value for warp and weft");
    made.uncertainty.bending[static_cast<std::size_t>(direction)] = fit;
    made.json.set(to_string(direction), fit_json(fit));
  }
  made.uncertainty.one_fit = true;
  print_fit(console, "warp and weft", fit);
  return made;
}

int run_fit(const Console& console, const FitOptions& o) {
  const bool strip =
      !(o.overhang_warp.empty() && o.overhang_weft.empty() && o.length_warp.empty() && o.length_weft.empty());
  if (strip == !o.drape.empty()) {
    throw Error(ErrorKind::kUsage,
                strip ? "a cantilever and a drape coefficient are two fits" : "there is nothing to fit to",
                {}, "give --overhang-warp and --overhang-weft, or --bending-length-..., or --drape");
  }
  check_can_write(o.output);
  Fitted made = strip ? fit_cantilever(console, o) : fit_drape(console, o);
  JsonValue json, assumed{JsonValue::Array{}};
  json.set("fitted", made.json);
  const FabricLaws laws = make_fabric_laws(made.fabric);
  console.line("Assumed");
  console.line("  2HB by the fibre; B goes with it");
  assumed.push("2HB by the fibre; B goes with it");
  for (const LawReport& report : laws.reports) {
    for (const std::string& sentence : report.assumptions) {
      console.line("  " + report.law + ": " + sentence);
      assumed.push(report.law + ": " + sentence);
    }
  }
  json.set("assumed", assumed).set("file", o.output);
  write_fabric_file(o.output, made.fabric);
  console.say("wrote " + o.output);
  bool at_rest = true;
  if (!o.no_bands) at_rest = run_bands(console, made.fabric, made.uncertainty, o.bands, strip, json);
  console.result(json);
  return at_rest ? 0 : kExitCheckFailed;
}

}  // namespace

void declare_fit(const Command& parent) {
  const auto o = std::make_shared<FitOptions>();
  constexpr int kMostRuns = 100;
  const Command command = parent.command(
      "fit", "A fabric from a cantilever or a drape coefficient alone: what they tell, what stays assumed");
  command.option("-o,--output", o->output, "Fabric file to write").required();
  command.option("--mass", o->mass, "Areal mass with unit, e.g. '16.3 mg/cm2'").required();
  command.option("--thickness", o->thickness, "Thickness with unit, e.g. 0.4mm");
  command.option("--name", o->name, "Name of the fabric");
  command.option("--composition", o->composition, "Fibres, e.g. '100 % wool': friction is assumed by them");
  command.option("--overhang-warp", o->overhang_warp, "Readings of the free length with unit");
  command.option("--overhang-weft", o->overhang_weft, "The same along the weft");
  command.option("--angle", o->angle, "Of the line that the tip meets, below level");
  command.option("--bending-length-warp", o->length_warp, "Readings with unit: half the overhang at 41.5deg");
  command.option("--bending-length-weft", o->length_weft, "The same along the weft");
  command.option("--drape", o->drape,
                 "Readings of the drape coefficient, e.g. 49.8%; with --disc and --specimen");
  command.option("--runs", o->runs, "Specimens at each rigidity that is tried with --drape")
      .range(1, kMostRuns);
  command.flag("--no-bands", o->no_bands, "Do not carry the uncertainty on");
  declare_band_options(command, o->bands);
  command.examples(
      {"fuai fabric fit --mass '16.29 mg/cm2' --composition '100 % wool' --overhang-warp 3.67cm 3.71cm "
       "--overhang-weft 3.5cm -o wool.fabric.toml",
       "fuai fabric fit --mass 110g/m2 --bending-length-warp 1.3cm -o faille.fabric.toml",
       "fuai fabric fit --mass '16.29 mg/cm2' --drape 49.8% --disc 12.7cm --specimen 25.4cm -o "
       "wool.fabric.toml"});
  command.body([o](const Console& console) { return run_fit(console, *o); });
}

}  // namespace fuai_app
