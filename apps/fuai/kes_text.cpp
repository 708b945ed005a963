// Prints, draws and lists parameters.
// SPDX-License-Identifier: Apache-2.0
#include "kes_text.h"

#include <cmath>

#include "fabric_text.h"
#include "fuai/core/error.h"
#include "fuai/io/text_file.h"

namespace fuai_app {

using namespace fuai;

void check_plot_name(const std::string& name) {
  if (name.empty() || name.ends_with(".svg") || name.ends_with(".png")) return;
  throw Error(ErrorKind::kUsage, "--plot: cannot tell the kind of picture of '" + name + "'", {},
              "end the name in .png or .svg");
}

void print_kes_values(const Console& console, const std::vector<KesValue>& simulated,
                      const std::vector<KesValue>& own) {
  console.line("  " + padded("symbol", 8) + padded("simulated", 12) + padded("fabric", 12) +
               padded("difference", 12) + "unit");
  for (std::size_t i = 0; i < simulated.size(); ++i) {
    const KesQuantity& q = kes_quantity(simulated[i].quantity);
    const auto shown = [&](double value) {
      return std::isnan(value) ? std::string("-") : format_number(value / q.to_si);
    };
    const double difference = 100.0 * (simulated[i].value - own[i].value) / own[i].value;
    console.line("  " + padded(std::string(q.symbol), 8) + padded(shown(simulated[i].value), 12) +
                 padded(shown(own[i].value), 12) +
                 padded(std::isfinite(difference) ? format_number(difference) + " %" : "-", 12) +
                 std::string(q.kes_unit));
  }
}

JsonValue kes_json(const std::vector<KesValue>& values) {
  JsonValue json{JsonValue::Object{}};
  for (const KesValue& v : values) {
    const KesQuantity& q = kes_quantity(v.quantity);
    json.set(std::string(q.key), v.value / q.to_si);
  }
  return json;
}

void write_kes_plot(const Console& console, const std::string& name, const Plot& plot) {
  if (name.empty()) return;
  constexpr int kWidth = 900, kHeight = 640;  // [pt]
  const PlotGrid grid{{}, 1, {plot}};
  write_atomically(
      name, name.ends_with(".svg") ? plot_svg(grid, kWidth, kHeight) : plot_png(grid, kWidth, kHeight, 1.0));
  console.say("wrote " + name);
}

}  // namespace fuai_app
