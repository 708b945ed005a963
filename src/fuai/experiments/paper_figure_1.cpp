// Figure 1: the measured bending behaviour and the law made from it.
// SPDX-License-Identifier: Apache-2.0
#include <array>

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
          fit.quality.substr(0, fit.quality.find_first_of(":;"))};
}

class Figure1 : public PaperFigure {
 public:
  std::vector<PaperTask> tasks() override {
    std::vector<PaperTask> list;
    for (std::size_t f = 0; f < kFabFabrics.size(); ++f) {
      for (Direction direction : {Direction::kWarp, Direction::kWeft}) {
        list.push_back(
            {std::string("buckling fit of ") + kFabFabrics[f], [this, f, direction](const Progress&) {
               const std::string path = data_folder() + "/u3m/" + kFabFabrics[f] + ".physics.json";
               fits_[f][static_cast<std::size_t>(direction)] =
                   fit_buckling(read_u3m_physics(path), direction);
             }});
      }
    }
    return list;
  }

  void write(PaperContext& context) override {
    HtmlPage& page = context.page;
    page.heading("Figure 1: measured bending and the law", "figure1");
    page.paragraph(
        "The paper shows the KES bending loop of a wool: curvature from -2.5 to 2.5 1/cm and back. No raw "
        "KES loop is public. "
        "What is: the published B and 2HB of a wool and a polyester (upper row: the loop that returns them), "
        "and the raw "
        "buckling tests of a cupro and a cotton knit (lower row: the loop of the law fitted to them; below: "
        "the fit itself).");
    write_loops(context);
    for (std::size_t f = 0; f < kFabFabrics.size(); ++f) write_buckling(context, f);
    context.add_table("figure1-fits.csv", fit_table());
    page.list(
        {"Agrees with the paper: a loop of two nearly parallel branches, wider for cotton than for wool and "
         "filament.",
         "Does not agree: the paper keeps the rising branch only, so its cloth pushes even when flat. Here "
         "both branches "
         "and every partial reversal follow from one law with memory.",
         "Weak: these are not KES loops. A buckled strip shows its bending only through a force of about 1 "
         "gf, and the load "
         "cell's offset is larger than that; trust B to about 20 % and 2HB to about 10 %."});
  }

 private:
  static void write_loops(PaperContext& context) {
    PlotGrid grid;
    grid.columns = 2;
    grid.title = "Moment against curvature";
    for (const char* id :
         {"wool-tropical", "polyester-faille", "cupro-woven-su1098", "cotton-knit-shirley"}) {
      const Fabric fabric = load_fabric(id);
      Plot plot = bending_plot(fabric, make_fabric_laws(fabric));
      plot.title = fabric.name;
      plot.bands.push_back({0.5, 1.5, true, "B is read here", 5});
      plot.reference_lines.push_back({1.0, true, "2HB", 6});
      grid.plots.push_back(plot);
    }
    context.add_plot("figure1", grid, 1200, 820);
    context.page.figure(
        "figure1.png",
        "Loops of the laws over the range of the instrument, with the window in which KES reads B and the "
        "curvature at which it reads 2HB. Where warp and weft were published as one number, they coincide.",
        "bending loops of four fabrics");
  }

  void write_buckling(PaperContext& context, std::size_t f) const {
    const Fabric fabric = load_fabric(kFabFabrics[f]);
    PlotGrid grid;
    grid.title = fabric.name + ": buckling tests of the Fabric Analyzer";
    grid.columns = 2;
    for (const BucklingFit& fit : fits_[f]) {
      for (FabTest test : {FabTest::kD1, FabTest::kU1}) grid.plots.push_back(buckling_plot(fit, test));
    }
    const std::string stem = std::string("figure1-") + kFabFabrics[f];
    context.add_plot(stem, grid, 1100, 760);
    context.page.figure(
        stem + ".png",
        "A strip of 2 cm between two clamps that come together: three nested cycles. The gap between going "
        "and "
        "coming is the friction of the cloth. Offset and drift of the load cell are free in each test.",
        "buckling tests of " + fabric.name);
  }

  HtmlTable fit_table() const {
    HtmlTable table;
    table.caption =
        "Bending laws from the buckling tests. ± is the standard error for independent residuals; B of D1 "
        "and of U1 "
        "alone show the honest spread.";
    table.header = {"fabric",      "direction",   "B [gf·cm²/cm]",   "2HB [gf·cm/cm]",
                    "B, D1 alone", "B, U1 alone", "rms [% of span]", "quality"};
    for (std::size_t f = 0; f < kFabFabrics.size(); ++f) {
      for (const BucklingFit& fit : fits_[f]) table.rows.push_back(fit_row(load_fabric(kFabFabrics[f]), fit));
    }
    return table;
  }

  std::array<std::array<BucklingFit, 2>, kFabFabrics.size()> fits_;  // [fabric][warp, weft]
};

}  // namespace

std::unique_ptr<PaperFigure> make_figure_1() { return std::make_unique<Figure1>(); }

}  // namespace fuai
