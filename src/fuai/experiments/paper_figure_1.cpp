// Figure 1: the measured bending behaviour and the law made from it.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "fuai/experiments/fabric_plot.h"
#include "fuai/experiments/paper_context.h"
#include "fuai/fabric/buckling_fit.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/u3m.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

/// The FAB files whose buckling tests are shown, by the bundled fabric they became.
constexpr std::array kFabFabrics{"cupro-woven-su1098", "cotton-knit-shirley"};

/// Force against clamp distance of one short buckling test: measured points and the fitted strip.
Plot buckling_plot(const BucklingFit& fit, FabTest test) {
  Plot plot;
  plot.title = std::string(to_string(fit.direction)) + ", " + to_string(test) +
               (test == FabTest::kU1 ? " (buckles upwards)" : " (buckles downwards)");
  plot.x_label = "clamp distance [cm]";
  plot.y_label = "force on the strip [gf]";
  for (const BucklingTestFit& t : fit.tests) {
    if (t.test != test) continue;
    Series measured, model;
    measured.label = "measured, offset and drift taken off";
    measured.style = SeriesStyle::kPoints;
    measured.colour = 6;
    model.label = "buckled strip with the fitted law";
    model.colour = series_index(fit.direction);
    for (std::size_t i = 0; i < t.measured.size(); ++i) {
      measured.x.push_back(t.clamp_distance[i] / unit::kCentimetre);
      measured.y.push_back(t.measured[i] / unit::kGramForce);
      model.x.push_back(t.clamp_distance[i] / unit::kCentimetre);
      model.y.push_back(t.model[i] / unit::kGramForce);
    }
    plot.series = {measured, model};
  }
  return plot;
}

std::vector<std::string> fit_row(const Fabric& fabric, const BucklingFit& fit) {
  const auto with_error = [](const char* format, double value, double error, double unit) {
    return text_of(format, value / unit) + " ± " + text_of("%.2g", error / unit);
  };
  return {fabric.name,
          to_string(fit.direction),
          with_error("%.4f", fit.B, fit.B_error, unit::kGfCm2PerCm),
          with_error("%.4f", fit.hysteresis_2HB, fit.hysteresis_2HB_error, unit::kGfCmPerCm),
          text_of("%.4f", fit.B_alone[0] / unit::kGfCm2PerCm),
          text_of("%.4f", fit.B_alone[1] / unit::kGfCm2PerCm),
          text_of("%.1f", 100.0 * fit.rms_fraction),
          fit.quality};
}

void add_buckling(PaperContext& context) {
  HtmlPage& page = context.page;
  HtmlTable table;
  table.caption =
      "Bending laws from the buckling tests. ± is the standard error for independent residuals; B of D1 and "
      "of U1 alone "
      "show the honest spread.";
  table.header = {"fabric",      "direction",   "B [gf·cm²/cm]",   "2HB [gf·cm/cm]",
                  "B, D1 alone", "B, U1 alone", "rms [% of span]", "quality"};
  std::size_t done = 0;
  for (const char* id : kFabFabrics) {
    const Fabric fabric = load_fabric(id);
    const FabRecord record = read_u3m_physics(data_folder() + "/u3m/" + id + ".physics.json");
    PlotGrid grid;
    grid.title = fabric.name + ": buckling tests of the Fabric Analyzer";
    grid.columns = 2;
    for (Direction direction : {Direction::kWarp, Direction::kWeft}) {
      const BucklingFit fit = fit_buckling(record, direction);
      for (FabTest test : {FabTest::kD1, FabTest::kU1}) grid.plots.push_back(buckling_plot(fit, test));
      table.rows.push_back(fit_row(fabric, fit));
      if (context.progress)
        context.progress("figure 1", context.fraction + context.share * static_cast<double>(++done) / 4.0);
    }
    const std::string stem = std::string("figure1-") + id;
    context.add_plot(stem, grid, 1100, 760);
    page.figure(stem + ".png",
                "A strip of 2 cm between two clamps that come together: three nested cycles. The gap between "
                "going and coming is the "
                "friction of the cloth. Offset and drift of the load cell are free in each test.",
                "buckling tests of " + fabric.name);
  }
  context.add_table("figure1-fits.csv", table);
}

}  // namespace

void add_figure_1(PaperContext& context) {
  HtmlPage& page = context.page;
  page.heading("Figure 1: measured bending and the law", "figure1");
  page.paragraph(
      "The paper shows the KES bending loop of a wool: curvature from -2.5 to 2.5 1/cm and back. No raw KES "
      "loop is public. What is: "
      "the published B and 2HB of a wool and a polyester (left: the loop that returns them), and the raw "
      "buckling tests of a cupro "
      "and a cotton knit (below: a law fitted to them, and its loops).");
  PlotGrid grid;
  grid.columns = 2;
  grid.title = "Moment against curvature";
  for (const char* id : {"wool-tropical", "polyester-faille", "cupro-woven-su1098", "cotton-knit-shirley"}) {
    const Fabric fabric = load_fabric(id);
    Plot plot = bending_plot(fabric, make_fabric_laws(fabric));
    plot.title = fabric.name;
    plot.bands.push_back({0.5, 1.5, true, "B is read here", 5});
    plot.reference_lines.push_back({1.0, true, "2HB", 6});
    grid.plots.push_back(plot);
  }
  context.add_plot("figure1", grid, 1200, 820);
  page.figure("figure1.png",
              "Loops of the laws over the range of the instrument, with the window in which KES reads B and "
              "the curvature at which it "
              "reads 2HB. The paper's law is one branch of such a loop; here both branches and everything "
              "between are there.",
              "bending loops of four fabrics");
  add_buckling(context);
}

}  // namespace fuai
