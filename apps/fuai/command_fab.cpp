// `fuai kes buckling` and `fuai kes stretch`: a fabric in the virtual Fabric Analyzer.
// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "fuai/io/curve_csv.h"
#include "fuai/io/text_file.h"
#include "fuai/laboratory/fab_round_trip.h"
#include "fuai/units/constants.h"
#include "kes_text.h"

namespace fuai_app {
namespace {

using namespace fuai;

/// One row a sample, in the machine's units.
std::string buckling_csv(const FabBucklingTrip& trip, Direction direction) {
  std::string text = "test,clamp_distance_cm,force_gf,branch\n";
  for (FabTest test : {FabTest::kD1, FabTest::kU1}) {
    int branch = 0;
    for (const auto& samples : trip.record.strip(direction, test).branches) {
      ++branch;
      for (const FabSample& s : samples) {
        text += std::string(to_string(test)) + "," + std::to_string(s.clamp_distance / unit::kCentimetre) +
                "," + std::to_string(s.force / unit::kGramForce) + "," + std::to_string(branch) + "\n";
      }
    }
  }
  return text;
}

int run_buckling(const Console& console, const KesCommandOptions& options, const Fabric& fabric,
                 Direction direction) {
  const FabBucklingTrip trip = run_fab_buckling_trip(fabric, direction, console.progress());
  const std::string title = fabric.name + ", buckling, " + to_string(direction);
  console.line(title);
  print_kes_values(console, trip.simulated, trip.stated);
  console.line("fit: " + trip.fit.quality);
  console.line("force: " + format_number(100.0 * trip.rms) +
               " % of its peak (rms) from the one-dimensional strip");
  if (!options.csv.empty()) {
    write_atomically(options.csv, buckling_csv(trip, direction));
    console.say("wrote " + options.csv);
  }
  write_kes_plot(console, options.plot, fab_buckling_plot(title, trip));
  JsonValue json = kes_json(trip.simulated);
  json.set("input", kes_json(trip.stated)).set("loop_rms_percent", 100.0 * trip.rms);
  json.set("quality", trip.fit.quality).set("clamp_tilt_deg", trip.fit.clamp_tilt / unit::kDegree);
  json.set("test", "buckling").set("direction", to_string(direction));
  console.result(json.set("fabric", fabric.id));
  return 0;
}

int run_stretch(const Console& console, const KesCommandOptions& options, const Fabric& fabric,
                Direction direction) {
  const FabStretchTrip trip = run_fab_stretch_trip(fabric, direction);
  const std::string title = fabric.name + ", stretch, " + to_string(direction);
  console.line(title + ", last cycle");
  print_kes_values(console, trip.simulated, trip.stated);
  if (trip.loop)
    console.line("loop: " + format_number(100.0 * trip.rms) +
                 " % of its peak (rms) from all measured samples");
  if (!options.csv.empty()) {
    write_curve_csv(options.csv, trip.curve);
    console.say("wrote " + options.csv);
  }
  write_kes_plot(console, options.plot, fab_stretch_plot(title, trip));
  JsonValue json = kes_json(trip.simulated);
  json.set("input", kes_json(trip.stated));
  json.set("loop_rms_percent", trip.loop ? JsonValue(100.0 * trip.rms) : JsonValue());
  json.set("test", "stretch").set("direction", to_string(direction));
  console.result(json.set("fabric", fabric.id));
  return 0;
}

}  // namespace

int run_fab(const Console& console, const KesCommandOptions& options, const Fabric& fabric) {
  const Direction direction = options.direction == "weft" ? Direction::kWeft : Direction::kWarp;
  return options.test == "buckling" ? run_buckling(console, options, fabric, direction)
                                    : run_stretch(console, options, fabric, direction);
}

}  // namespace fuai_app
