// Plots, tables and page of the cloth that is bent in the hand.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>

#include "felt_bending.h"
#include "fuai/picture/plot.h"
#include "fuai/units/constants.h"

namespace fuai_app {

using namespace fuai;

namespace {

/// Colours that differ.
constexpr int kColours = 7;
/// Arrows show directions alone: all have this length [cm].
constexpr double kArrow = 3.0;

std::string text_of(const char* unit, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.5g%s", value, unit);
  return text;
}

double milli(double force) { return 1e3 * force; }

Series curve(const FeltBending& run, bool paper, int colour) {
  Series series;
  series.label = run.id;
  series.colour = colour;
  series.arrows = true;
  series.style = colour < kColours ? SeriesStyle::kLine : SeriesStyle::kDashed;
  for (const BendingMoment& moment : run.moments) {
    series.x.push_back(moment.curvature / unit::kPerCentimetre);
    series.y.push_back(milli(paper ? moment.paper_pushes : moment.pushes));
  }
  return series;
}

PlotGrid force_plots(const std::vector<FeltBending>& runs) {
  PlotGrid grid;
  grid.columns = 2;
  grid.title = "17 x 9 cloth bent by a simulated hand, there and back";
  for (bool paper : {false, true}) {
    Plot plot;
    plot.title = paper ? "(b) Eq. (7) as printed, on the same cloth" : "(a) true reaction";
    plot.x_label = "curvature of the arc [1/cm]";
    plot.y_label = "force that pushes the hand back [mN]";
    for (std::size_t i = 0; i < runs.size(); ++i)
      plot.series.push_back(curve(runs[i], paper, static_cast<int>(i)));
    grid.plots.push_back(plot);
  }
  return grid;
}

/// A line from the hand along a force.
Series arrow(const Vec3& hand, const Vec3& force, int colour, const std::string& label) {
  Series series;
  series.label = label;
  series.colour = colour;
  series.arrows = true;
  const double length = force.norm();
  for (double share : {0.0, 1.0}) {
    const double along = length > 0.0 ? share * kArrow / length : 0.0;
    series.x.push_back(100.0 * hand.x() + along * force.x());
    series.y.push_back(100.0 * hand.z() + along * force.z());
  }
  return series;
}

PlotGrid direction_plots(const std::vector<FeltBending>& runs) {
  PlotGrid grid;
  grid.columns = runs.size() > 1 ? 2 : 1;
  grid.title = "Shapes on the way out, from the side, and the directions of the force on the hand";
  for (const FeltBending& run : runs) {
    Plot plot;
    plot.title = run.name;
    plot.x_label = "x [cm]";
    plot.y_label = "z [cm]";
    plot.x_range = Range{-4.0, 20.0};
    plot.y_range = Range{-4.0, 14.0};
    for (const BendingShape& shape : run.shapes) {
      const bool first = &shape == &run.shapes.front();
      Series yarn;
      yarn.colour = 6;
      for (const Vec3& place : shape.yarn) {
        yarn.x.push_back(100.0 * place.x());
        yarn.y.push_back(100.0 * place.z());
      }
      plot.series.push_back(yarn);
      plot.series.push_back(arrow(shape.yarn.back(), shape.moment.reaction, 4, first ? "true reaction" : ""));
      plot.series.push_back(
          arrow(shape.yarn.back(), shape.moment.paper_bend, 3, first ? "Eq. (7), bending" : ""));
    }
    grid.plots.push_back(plot);
  }
  return grid;
}

HtmlTable summary(const std::vector<FeltBending>& runs) {
  HtmlTable table;
  table.caption =
      "Force that pushes the hand back at half of the largest curvature. Loop: the way out less the way "
      "back.";
  table.header = {"fabric",   "B weft [gf cm2/cm]", "curvature [1/cm]", "reaction out [mN]",      "back [mN]",
                  "loop [%]", "Eq. (7) out [mN]",   "back [mN]",        "Eq. (7) of reaction [%]"};
  for (const FeltBending& run : runs) {
    const double half = 0.5 * run.top(), out = run.push_at(half, false, false),
                 back = run.push_at(half, true, false), paper = run.push_at(half, false, true);
    table.rows.push_back({run.id,
                          std::isnan(run.weft_rigidity) ? "from the curve"
                                                        : text_of("", run.weft_rigidity / unit::kGfCm2PerCm),
                          text_of("", half / unit::kPerCentimetre), text_of("", milli(out)),
                          text_of("", milli(back)), text_of("", 100.0 * (out - back) / out),
                          text_of("", milli(paper)), text_of("", milli(run.push_at(half, true, true))),
                          text_of("", 100.0 * paper / out)});
  }
  return table;
}

HtmlTable moments(const FeltBending& run) {
  HtmlTable table;
  table.header = {"time_s",         "curvature_per_m", "tool_x_m",          "tool_y_m",
                  "tool_z_m",       "reaction_x_N",    "reaction_y_N",      "reaction_z_N",
                  "felt_x_N",       "felt_y_N",        "felt_z_N",          "paper_bend_x_N",
                  "paper_bend_y_N", "paper_bend_z_N",  "reaction_pushes_N", "paper_pushes_N"};
  for (const BendingMoment& m : run.moments) {
    std::vector<std::string> row{text_of("", m.time), text_of("", m.curvature)};
    for (const Vec3& v : {m.tool, m.reaction, m.felt, m.paper_bend})
      for (int i = 0; i < 3; ++i) row.push_back(text_of("", v[i]));
    row.push_back(text_of("", m.pushes));
    row.push_back(text_of("", m.paper_pushes));
    table.rows.push_back(row);
  }
  return table;
}

void add_plot(std::vector<OutputFile>& files, const std::string& stem, const PlotGrid& plot, int width,
              int height) {
  files.push_back({stem + ".png", plot_png(plot, width, height)});
  files.push_back({stem + ".svg", plot_svg(plot, width, height)});
}

}  // namespace

std::vector<OutputFile> felt_bending_page(const std::vector<FeltBending>& runs) {
  std::vector<OutputFile> files;
  const int rows = static_cast<int>((runs.size() + 1) / 2);
  add_plot(files, "force", force_plots(runs), 1300, 560);
  add_plot(files, "directions", direction_plots(runs), runs.size() > 1 ? 1200 : 700, 420 * rows + 40);
  HtmlPage page("Cloth bent in the hand: section 4.2 of the founding paper");
  page.paragraph(
      "A cloth of 17 x 9 particles at 1 cm, without weight, clamped at two columns; a simulated hand holds "
      "the "
      "middle particle of the free edge through a simulated PHANToM Premium and takes it along the arc that "
      "pure bending would give, out in four seconds and back in four. The cloth is the engine's at 1 kHz. "
      "Both forces are those of the same shape at the same moment, in the mean of a tenth of a second.");
  page.figure(
      "force.png",
      "Force against curvature, arrows in the order of time. (a) What the cloth really does to the hand: "
      "fabrics differ, and the way back lies below the way out, by friction, and a little by the air; near "
      "flat the cloth has to be pushed. What shakes is the device's own friction and encoder, through the "
      "cloth's mass. (b) The bending term of Eq. (7) as printed: hardly a function of the curvature, for its "
      "one branch starts at half of 2HB for a cloth that is hardly bent, as it is beside a particle that is "
      "held; and more on the way back than on the way out, where the true reaction is less.",
      "force against curvature");
  page.table(summary(runs));
  files.push_back({"summary.csv", to_csv(summary(runs))});
  page.figure("directions.png",
              "Directions of the two forces at some moments of the way out; all arrows have the same length.",
              "shapes and directions");
  for (const FeltBending& run : runs) files.push_back({run.id + ".csv", to_csv(moments(run))});
  page.list({"1 mN is about a tenth of a gram force.",
             "The table of every moment of a fabric stands beside this page as CSV, each plot as SVG."});
  files.push_back({"index.html", page.html()});
  return files;
}

}  // namespace fuai_app
