// Figures 6, 7 and 8: the bent strip, the direction of the force in the hand, and curvature against force.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "fuai/experiments/fabric_plot.h"
#include "fuai/experiments/paper_context.h"
#include "fuai/experiments/scene_pictures.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/io/fabric_library.h"
#include "fuai/scenes/paper_bending.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

/// Arc curvatures of Figure 6 [1/m]: a quarter turn of the 16 cm strip is 0.098 1/cm, a half turn 0.196.
constexpr std::array kStages{4.0, 10.0, 18.0};
/// The printed form never comes to rest: each stage stops here.
constexpr std::int64_t kPrintedSteps = 20'000;
constexpr double kLongestArrow = 0.06;  // [m]

const char* mode_name(PaperMode mode) { return mode == PaperMode::kAsPrinted ? "as printed" : "corrected"; }

struct BendingRun {
  Fabric fabric;
  FabricLaws laws;
  PaperMode mode = PaperMode::kCorrected;
  std::vector<PaperBendingStage> stages;
  double spacing = 0.0;
  int columns = 0, rows = 0, grip = 0;
  double seconds = 0.0;
};

BendingRun run_bending(const std::string& id, PaperMode mode, std::span<const double> curvatures,
                       const Progress& progress) {
  BendingRun run;
  run.fabric = load_fabric(id);
  run.laws = make_fabric_laws(run.fabric);
  run.mode = mode;
  PaperBendingOptions options;
  options.relaxation.mode = mode;
  if (mode == PaperMode::kAsPrinted) options.stop.max_steps = kPrintedSteps;
  PaperBending scene = make_paper_bending(run.laws, options);
  run.spacing = options.spacing;
  run.columns = scene.model->columns;
  run.rows = scene.model->rows;
  run.grip = scene.grip;
  const Stopwatch watch;
  for (std::size_t i = 0; i < curvatures.size(); ++i) {
    run.stages.push_back(bend_to(scene, curvatures[i]));
    if (progress) progress("", static_cast<double>(i + 1) / static_cast<double>(curvatures.size()));
  }
  run.seconds = watch.seconds();
  return run;
}

void report_run(PaperContext& context, const std::string& figure, const BendingRun& run) {
  PaperSummaryRow row{figure, run.fabric.id, mode_name(run.mode), 0, 0.0, true, run.seconds};
  for (const PaperBendingStage& s : run.stages) {
    row.steps += s.relaxation.steps;
    row.residual_node_weights = std::max(row.residual_node_weights, s.relaxation.residual);
    row.converged = row.converged && s.relaxation.converged;
  }
  context.result.runs.push_back(row);
}

Vec3 printed_force(const PaperBendingStage& stage) {
  return stage.force.printed_stretch + stage.force.printed_bending;
}

/// One stage with the arrow of Eq. (7) and the arrow of the true reaction.
ClothPicture stage_picture(const BendingRun& run, const PaperBendingStage& stage, double metres_per_newton) {
  const Vec3 grip = stage.positions[static_cast<std::size_t>(run.grip)];
  std::vector<ArrowItem> arrows(2);
  arrows[0].origin = arrows[1].origin = grip;
  arrows[0].vector = metres_per_newton * printed_force(stage);
  arrows[0].colour = series_colour(3);
  arrows[0].label = "Eq. (7) " + text_of("%.3g gf", printed_force(stage).norm() / unit::kGramForce);
  arrows[1].vector = metres_per_newton * stage.force.reaction;
  arrows[1].colour = series_colour(4);
  arrows[1].label = "reaction " + text_of("%.3g gf", stage.force.reaction.norm() / unit::kGramForce);
  return paper_bending_picture(make_lattice_mesh(run.columns, run.rows, run.spacing, stage.positions),
                               std::move(arrows),
                               run.fabric.name + ", " + mode_name(run.mode) + ", arc curvature " +
                                   text_of("%.2f 1/cm", stage.arc_curvature / unit::kPerCentimetre),
                               4.0 / 3.0);
}

/// Curvatures of Figures 7 and 8 [1/m]: out to a half turn and back.
std::vector<double> there_and_back() {
  std::vector<double> curvatures;
  for (int i = 1; i <= 10; ++i) curvatures.push_back(2.0 * i);
  for (int i = 9; i >= 0; --i) curvatures.push_back(2.0 * i);
  return curvatures;
}

Series stage_series(const BendingRun& run, const std::string& label, int colour, SeriesStyle style, auto x_of,
                    auto y_of) {
  Series series;
  series.label = label;
  series.colour = colour;
  series.style = style;
  series.arrows = style != SeriesStyle::kPoints;
  for (const PaperBendingStage& stage : run.stages) {
    series.x.push_back(x_of(stage));
    series.y.push_back(y_of(stage));
  }
  return series;
}

/// (a) what the paper plots, (b) the force a hand feels, (c) the curve the law was made from.
PlotGrid force_plot(const BendingRun& printed, const BendingRun& corrected) {
  const auto grip_curvature = [](const PaperBendingStage& s) {
    return s.grip_curvature / unit::kPerCentimetre;
  };
  const auto arc_curvature = [](const PaperBendingStage& s) {
    return s.arc_curvature / unit::kPerCentimetre;
  };
  const auto printed_bending = [](const PaperBendingStage& s) {
    return s.force.printed_bending.norm() / unit::kGramForce;
  };
  const auto reaction = [](const PaperBendingStage& s) { return s.force.reaction.norm() / unit::kGramForce; };
  PlotGrid grid;
  grid.columns = 3;
  grid.title = printed.fabric.name;
  grid.plots.resize(3);
  Plot& a = grid.plots[0];
  a.title = "(a) Eq. (7), bending term";
  a.x_label = "curvature at the held particle [1/cm]";
  a.y_label = "force [gf]";
  a.series.push_back(
      stage_series(printed, "as printed", 3, SeriesStyle::kPoints, grip_curvature, printed_bending));
  a.series.push_back(
      stage_series(corrected, "corrected", 4, SeriesStyle::kLineAndPoints, grip_curvature, printed_bending));
  Plot& b = grid.plots[1];
  b.title = "(b) true reaction on the hand";
  b.x_label = "curvature of the arc [1/cm]";
  b.y_label = "force [gf]";
  b.series.push_back(
      stage_series(printed, "as printed, not at rest", 3, SeriesStyle::kPoints, arc_curvature, reaction));
  b.series.push_back(
      stage_series(corrected, "corrected", 4, SeriesStyle::kLineAndPoints, arc_curvature, reaction));
  grid.plots[2] = bending_plot(corrected.fabric, corrected.laws);
  grid.plots[2].title = "(c) the law of this fabric";
  return grid;
}

HtmlTable stage_table(const BendingRun& printed, const BendingRun& corrected) {
  HtmlTable table;
  table.header = {"mode",
                  "arc curvature [1/cm]",
                  "curvature at grip [1/cm]",
                  "mid-strip [1/cm]",
                  "Eq. (7) bending [gf]",
                  "Eq. (7) springs [gf]",
                  "true reaction [gf]",
                  "residual [node weights]"};
  for (const BendingRun* run : {&corrected, &printed}) {
    for (const PaperBendingStage& s : run->stages) {
      table.rows.push_back({mode_name(run->mode), text_of("%.2f", s.arc_curvature / unit::kPerCentimetre),
                            text_of("%.4f", s.grip_curvature / unit::kPerCentimetre),
                            text_of("%.4f", s.mid_curvature / unit::kPerCentimetre),
                            text_of("%.5f", s.force.printed_bending.norm() / unit::kGramForce),
                            text_of("%.5f", s.force.printed_stretch.norm() / unit::kGramForce),
                            text_of("%.5f", s.force.reaction.norm() / unit::kGramForce),
                            text_of("%.2g", s.relaxation.residual)});
    }
  }
  return table;
}

void add_force_figure(PaperContext& context, const std::string& number, const std::string& id,
                      const std::string& stands_for, int index) {
  const std::vector<double> curvatures = there_and_back();
  const BendingRun corrected = run_bending(id, PaperMode::kCorrected, curvatures,
                                           context.part("figure " + number + ", corrected", 2 * index, 4));
  const BendingRun printed = run_bending(id, PaperMode::kAsPrinted, curvatures,
                                         context.part("figure " + number + ", as printed", 2 * index + 1, 4));
  report_run(context, number, corrected);
  report_run(context, number, printed);
  HtmlPage& page = context.page;
  page.heading("Figure " + number + ": curvature against force, " + corrected.fabric.name, "figure" + number);
  page.paragraph(corrected.fabric.name + " stands for the paper's bending characteristic " + stands_for +
                 ": its measured rigidity is nearest. The strip is bent to a half turn and back.");
  context.add_plot("figure" + number, force_plot(printed, corrected), 1350, 430);
  page.figure("figure" + number + ".png",
              "(a) What the paper plots: the table's moment at the curvature of the held particle, times the "
              "spacing. It follows the "
              "measured curve because it is the measured curve. (b) What a hand would feel. Going back, "
              "friction gives another force. "
              "(c) The law of the fabric over the whole range of the instrument.",
              "curvature against force");
  context.add_table("figure" + number + ".csv", stage_table(printed, corrected));
}

}  // namespace

void add_figure_6(PaperContext& context) {
  constexpr const char* kFabric = "wool-tropical";
  HtmlPage& page = context.page;
  page.heading("Figure 6: direction of the force while bending", "figure6");
  page.paragraph(
      "17 x 9 particles, 1 cm apart. The left edge is clamped; the middle particle of the right edge is held "
      "and moved on the arc "
      "that pure bending would give. Two arrows start at it: Eq. (7) of the paper, and the true reaction, "
      "the derivative of the "
      "cloth's energy by the position of the hand.");
  int index = 0;
  for (PaperMode mode : {PaperMode::kCorrected, PaperMode::kAsPrinted}) {
    const BendingRun run = run_bending(kFabric, mode, kStages,
                                       context.part(std::string("figure 6, ") + mode_name(mode), index++, 2));
    report_run(context, "6", run);
    double largest = 1e-12;
    for (const PaperBendingStage& s : run.stages) {
      largest = std::max({largest, s.force.reaction.norm(), printed_force(s).norm()});
    }
    std::vector<std::pair<std::string, std::string>> pictures;
    for (std::size_t i = 0; i < run.stages.size(); ++i) {
      const std::string file = std::string("figure6-") + (mode == PaperMode::kAsPrinted ? "printed-" : "") +
                               std::string(1, static_cast<char>('a' + i)) + ".png";
      context.add_picture(file, stage_picture(run, run.stages[i], kLongestArrow / largest), 900, 675);
      pictures.emplace_back(
          file, "arc " + text_of("%.2f 1/cm", run.stages[i].arc_curvature / unit::kPerCentimetre));
    }
    page.gallery(pictures, std::string(mode == PaperMode::kCorrected ? "Corrected" : "As printed") + ", " +
                               run.fabric.name + ". The longest arrow of the row is " +
                               text_of("%.3g gf", largest / unit::kGramForce) + ".");
  }
  page.list({"Agrees with the paper: the bending force points back to the flat state.",
             "Does not agree: the printed Eq. (7) is a moment read as a force. It halves when the lattice is "
             "refined to half the "
             "spacing, and it is mostly spring force here; the true reaction keeps its value."});
}

void add_figures_7_and_8(PaperContext& context, bool seven, bool eight) {
  if (seven) add_force_figure(context, "7", "wool-tropical", "3", 0);
  if (eight) add_force_figure(context, "8", "polyester-faille", "1", 1);
}

}  // namespace fuai
