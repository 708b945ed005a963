// `fuai kes`: a fabric in a virtual instrument.
// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/io/curve_csv.h"
#include "fuai/io/fabric_library.h"
#include "fuai/laboratory/kes_round_trip.h"
#include "fuai/units/constants.h"
#include "fuai/units/parse.h"
#include "kes_text.h"

namespace fuai_app {
namespace {

using namespace fuai;

Test test_of(const std::string& word) {
  return word == "bending" ? Test::kBending : (word == "shear" ? Test::kShear : Test::kTensile);
}

/// SI value of the unit of a test's strain.
double strain_unit(Test test) {
  return test == Test::kBending ? unit::kPerCentimetre
                                : (test == Test::kShear ? unit::kDegree : unit::kPercent);
}

double plain_number(std::string_view text, const std::string& whole) {
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw Error(ErrorKind::kUsage, "--reverse: '" + whole + "' is no reversal", {},
                "write OUT or OUT:BACK, such as 1.5:0.5");
  }
  return value;
}

/// "1.5:0.5" or "1.5".
KesReversal reversal_of(const std::string& text, Test test) {
  const std::size_t colon = text.find(':');
  KesReversal reversal;
  reversal.out = plain_number(std::string_view(text).substr(0, colon), text) * strain_unit(test);
  if (colon != std::string::npos)
    reversal.back = plain_number(std::string_view(text).substr(colon + 1), text) * strain_unit(test);
  if (!(reversal.out > reversal.back) || !(reversal.back >= 0.0)) {
    throw Error(ErrorKind::kUsage, "--reverse: '" + text + "' does not turn back", {},
                "OUT must be more than BACK, and BACK not below 0");
  }
  return reversal;
}

KesTest test_of(const KesCommandOptions& options) {
  KesTest test;
  test.test = test_of(options.test);
  if (!options.direction.empty())
    test.direction = options.direction == "weft" ? Direction::kWeft : Direction::kWarp;
  for (const std::string& text : options.reverse) test.reversals.push_back(reversal_of(text, test.test));
  if (!options.spacing.empty()) test.spacing = parse_value(options.spacing, kLength, "--spacing");
  return test;
}

std::string direction_of(const KesTest& test) {
  if (!test.direction && test.test == Test::kShear) return "mean";
  return to_string(test.direction.value_or(Direction::kWarp));
}

void print(const Console& console, const Fabric& fabric, const KesRoundTrip& trip) {
  const std::string direction = direction_of(trip.test);
  console.line(fabric.name + ", " + to_string(trip.test.test) + ", " +
               (direction == "mean" ? "mean of warp and weft" : direction));
  print_kes_values(console, trip.simulated, trip.input);
  console.line("loop: " + format_number(100.0 * trip.loop_rms) + " % of its peak (rms) from the " +
               (trip.loop_measured ? "measured curve, as one cycle" : "law of the fabric"));
}

int run_instrument(const Console& console, const KesCommandOptions& options, const Fabric& fabric) {
  const KesTest test = test_of(options);
  const KesRoundTrip trip = run_kes_round_trip(fabric, test, console.progress());
  print(console, fabric, trip);
  for (const std::string& note : trip.notes) console.detail("assumed: " + note);
  if (!options.csv.empty()) {
    write_curve_csv(options.csv, trip.record.curve);
    console.say("wrote " + options.csv);
  }
  write_kes_plot(console, options.plot, kes_plot(fabric, trip));
  JsonValue json = kes_json(trip.simulated), notes{JsonValue::Array{}};
  for (const std::string& note : trip.notes) notes.push(note);
  json.set("input", kes_json(trip.input)).set("stated", kes_json(trip.stated));
  json.set("loop_rms_percent", 100.0 * trip.loop_rms);
  json.set("loop", trip.loop_measured ? "measured" : "law");
  json.set("test", to_string(test.test)).set("direction", direction_of(test)).set("fabric", fabric.id);
  json.set("spacing_m", trip.record.spacing).set("iterations", trip.record.iterations);
  if (test.test == Test::kShear)
    json.set("edge_share_percent", 100.0 * trip.record.edge_share).set("stretch", trip.record.stretch);
  console.result(json.set("assumptions", notes));
  return 0;
}

int run_kes(const Console& console, const KesCommandOptions& options) {
  check_plot_name(options.plot);
  const bool fab = options.test == "buckling" || options.test == "stretch";
  if (fab && (!options.reverse.empty() || !options.spacing.empty())) {
    throw Error(ErrorKind::kUsage, "the tests of the Fabric Analyzer have a path and a lattice of their own",
                {}, "leave --reverse and --spacing out");
  }
  const Fabric fabric = load_fabric(options.fabric);
  for (const std::string& warning : fabric.warnings) console.warn(warning);
  return fab ? run_fab(console, options, fabric) : run_instrument(console, options, fabric);
}

}  // namespace

void declare_kes(const Command& parent) {
  const auto options = std::make_shared<KesCommandOptions>();
  const Command command = parent.command(
      "kes",
      "A fabric in a virtual instrument (KES, or the Fabric Analyzer): the loop and its parameters beside "
      "the fabric's own");
  command
      .option("TEST", options->test,
              "bending (FB2), tensile or shear (FB1); buckling or stretch as the Fabric Analyzer does them")
      .among({"bending", "tensile", "shear", "buckling", "stretch"})
      .required();
  command.option("FABRIC", options->fabric, "Bundled name or path of a fabric file").required();
  command
      .option("--direction", options->direction,
              "Yarns from clamp to clamp: warp or weft. Default: warp; in shear the mean of both")
      .among({"warp", "weft"});
  command.option("--reverse", options->reverse,
                 "Partial reversals on the way to the first stop, OUT or OUT:BACK in 1/cm, degrees or "
                 "percent; BACK is 0, in tension no load, where it is left out");
  command.option("--spacing", options->spacing,
                 "Distance of the nodes with unit; must divide the specimen's length, 1 cm in bending, "
                 "else 5 cm. Default: 2 mm in bending, 5 mm in shear, 1 cm in tension");
  command.option("--csv", options->csv, "Write the simulated curve as a curve file").file();
  command
      .option("--plot", options->plot, "Draw the simulated loop over the fabric's into FILE.png or FILE.svg")
      .file();
  command.examples({"fuai kes bending wool-tropical",
                    "fuai kes shear wool-tropical --plot shear.png --csv shear.csv",
                    "fuai --json kes tensile cupro-woven-su1098 --direction weft",
                    "fuai kes bending polyester-faille --reverse 0.5 1 1.5:0.5 --plot minor.svg"});
  command.body([options](const Console& console) { return run_kes(console, *options); });
}

}  // namespace fuai_app
