// Figures 7 and 8: curvature against force, beside the curve of the fabric.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "fuai/experiments/fabric_plot.h"
#include "fuai/experiments/paper_context.h"
#include "fuai/experiments/paper_strip.h"
#include "fuai/io/fabric_library.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

/// Curvatures of the moved strip [1/m]: out to a half turn and back.
std::vector<double> there_and_back() {
  std::vector<double> curvatures;
  for (int i = 1; i <= 10; ++i) curvatures.push_back(2.0 * i);
  for (int i = 4; i >= 0; --i) curvatures.push_back(4.0 * i);
  return curvatures;
}

/// Forces at the free end of a strip that is laid on a cylinder, over the curvature of the cylinder.
struct Cylinder {
  std::vector<double> curvature, printed, reaction,
      branch;  ///< [1/cm], [gf]; branch: printed curve at 1 cm width
};

Cylinder impose(const std::string& fabric_id) {
  Cylinder result;
  const FabricLaws laws = make_fabric_laws(load_fabric(fabric_id));
  PaperBendingOptions options;
  PaperBending scene = make_paper_bending(laws, options);
  const PlayLaw& law = laws.bending[static_cast<std::size_t>(Direction::kWeft)];
  // 1.8 1/cm: the circle through three particles 1 cm apart reaches 2 1/cm when the thread folds on itself.
  for (int i = 1; i <= 18; ++i) {
    const double curvature = 0.1 * i * unit::kPerCentimetre;
    impose_cylinder(scene, curvature);
    const GraspForce force = evaluate_grasp(scene.solver, scene.state, scene.grip);
    result.curvature.push_back(0.1 * i);
    result.printed.push_back(force.printed_bending.norm() / unit::kGramForce);
    result.reaction.push_back(force.reaction.norm() / unit::kGramForce);
    result.branch.push_back(
        (law.elastic().evaluate(curvature).value + law.friction().evaluate(curvature).value) /
        unit::kGfCmPerCm);
  }
  return result;
}

Series series_of(const std::string& label, int colour, SeriesStyle style, std::vector<double> x,
                 std::vector<double> y) {
  Series series;
  series.label = label;
  series.colour = colour;
  series.style = style;
  series.x = std::move(x);
  series.y = std::move(y);
  return series;
}

/// The part of the reaction that pushes the hand back along the arc, towards flat; negative when the cloth
/// pulls it on [N]. On the arc x = sin(K s) / K, z = (1 - cos(K s)) / K the hand moves along d(x, z) / dK.
double push_back(const StripRun& run, const PaperBendingStage& stage) {
  const double s = run.spacing * (run.columns - 2);  // two columns are clamped, the arc begins at the second
  const double K = stage.arc_curvature, turn = K * s;
  Vec3 onward = Vec3::UnitZ();
  if (turn > 1e-6)
    onward = Vec3(turn * std::cos(turn) - std::sin(turn), 0.0, turn * std::sin(turn) - 1.0 + std::cos(turn))
                 .normalized();
  return -onward.dot(stage.force.reaction);
}

Series stage_series(const StripRun& run, const std::string& label, int colour, SeriesStyle style) {
  std::vector<double> x, y;
  for (const PaperBendingStage& stage : run.stages) {
    x.push_back(stage.arc_curvature / unit::kPerCentimetre);
    y.push_back(push_back(run, stage) / unit::kGramForce);
  }
  Series series = series_of(label, colour, style, std::move(x), std::move(y));
  series.arrows = style != SeriesStyle::kPoints;
  return series;
}

class ForceFigure : public PaperFigure {
 public:
  ForceFigure(std::string number, std::string fabric_id, std::string stands_for)
      : number_(std::move(number)), id_(std::move(fabric_id)), stands_for_(std::move(stands_for)) {}

  std::vector<PaperTask> tasks() override {
    return {{"strip of figure " + number_ + ", corrected",
             [this](const Progress& p) {
               corrected_ = run_strip(id_, PaperMode::kCorrected, there_and_back(), p);
             }},
            {"strip of figure " + number_ + ", as printed",
             [this](const Progress& p) {
               printed_ = run_strip(id_, PaperMode::kAsPrinted, there_and_back(), p);
             }},
            {"cylinder of figure " + number_, [this](const Progress&) { cylinder_ = impose(id_); }}};
  }

  void write(PaperContext& context) override {
    for (const StripRun* run : {&corrected_, &printed_})
      context.result.runs.push_back(summary_of(number_, *run));
    HtmlPage& page = context.page;
    page.heading("Figure " + number_ + ": curvature against force, " + corrected_.fabric.name,
                 "figure" + number_);
    page.paragraph(corrected_.fabric.name + " stands for the paper's bending characteristic " + stands_for_ +
                   ": of the measured fabrics its rigidity is nearest to that member of the graded family.");
    context.add_plot("figure" + number_, plots(), 1200, 860);
    page.figure(
        "figure" + number_ + ".png",
        "(a) The strip laid on a cylinder, as a hand that could impose any shape would: the printed "
        "Eq. (7) at the end "
        "particle is the table's moment at that curvature times the spacing, so it follows the "
        "measured branch because it "
        "is the measured branch. (b) The law of the fabric over the whole range of the instrument. "
        "(c) The strip held at "
        "one particle, at rest: the part of the true reaction that pushes the hand back along its "
        "way, out to a half turn and back; on the way back friction lowers it, and near flat the cloth "
        "has to be pushed. "
        "(d) The same as printed: it never rests, the springs' noise is all that is felt.",
        "curvature against force of " + corrected_.fabric.name);
    context.add_table("figure" + number_ + ".csv", stage_table());
    page.list(
        {"Agrees with the paper: in (a) force against curvature has the shape of the KES curve, and the two "
         "fabrics of "
         "Figures 7 and 8 differ as their curves do.",
         "Does not agree: one pinched particle cannot carry a moment, so in (c) a hand feels far less than "
         "(a) suggests, and "
         "the curvature at the held particle is not that of the arc.",
         "The paper's curve starts at 2HB/2 for flat cloth, a force out of nothing; with memory it starts at "
         "zero.",
         "Weak: the springs of the plain descent are soft (10 gf/cm). With 2 gf/cm the reaction of the wool "
         "is 24 % lower at "
         "0.04 1/cm and 2 % higher at a half turn; only a held patch of fixed size and real thread stiffness "
         "will settle it."});
  }

 private:
  PlotGrid plots() const {
    PlotGrid grid;
    grid.columns = 2;
    grid.title = corrected_.fabric.name;
    grid.plots.resize(4);
    Plot& a = grid.plots[0];
    a.title = "(a) imposed cylinder, force at the end particle";
    a.x_label = "curvature [1/cm]";
    a.y_label = "force [gf]";
    a.series = {series_of("rising branch of the law, gf·cm/cm read as gf", 6, SeriesStyle::kDashed,
                          cylinder_.curvature, cylinder_.branch),
                series_of("Eq. (7), bending term, as printed", 3, SeriesStyle::kPoints, cylinder_.curvature,
                          cylinder_.printed),
                series_of("true reaction, corrected", 4, SeriesStyle::kLineAndPoints, cylinder_.curvature,
                          cylinder_.reaction)};
    grid.plots[1] = bending_plot(corrected_.fabric, corrected_.laws);
    grid.plots[1].title = "(b) the law of this fabric";
    Plot& c = grid.plots[2];
    c.title = "(c) strip held at one particle, corrected";
    c.x_label = "curvature of the arc [1/cm]";
    c.y_label = "reaction that pushes back [gf]";
    c.series = {stage_series(corrected_, "there and back", 4, SeriesStyle::kLineAndPoints)};
    Plot& d = grid.plots[3];
    d.title = "(d) the same as printed, not at rest";
    d.x_label = c.x_label;
    d.y_label = c.y_label;
    d.series = {stage_series(printed_, "after 20000 steps a stage", 3, SeriesStyle::kPoints)};
    return grid;
  }

  HtmlTable stage_table() const {
    HtmlTable table;
    table.header = {"mode",
                    "arc curvature [1/cm]",
                    "curvature at grip [1/cm]",
                    "mid-strip [1/cm]",
                    "Eq. (7) bending [gf]",
                    "Eq. (7) springs [gf]",
                    "true reaction [gf]",
                    "of it pushing back [gf]",
                    "largest stretch [%]",
                    "residual [node weights]"};
    for (const StripRun* run : {&corrected_, &printed_}) {
      for (const PaperBendingStage& s : run->stages) {
        table.rows.push_back({mode_name(run->mode), text_of("%.2f", s.arc_curvature / unit::kPerCentimetre),
                              text_of("%.4f", s.grip_curvature / unit::kPerCentimetre),
                              text_of("%.4f", s.mid_curvature / unit::kPerCentimetre),
                              text_of("%.5f", s.force.printed_bending.norm() / unit::kGramForce),
                              text_of("%.5f", s.force.printed_stretch.norm() / unit::kGramForce),
                              text_of("%.5f", s.force.reaction.norm() / unit::kGramForce),
                              text_of("%.5f", push_back(*run, s) / unit::kGramForce),
                              text_of("%.2f", s.relaxation.max_stretch / unit::kPercent),
                              text_of("%.2g", s.relaxation.residual)});
      }
    }
    return table;
  }

  std::string number_, id_, stands_for_;
  StripRun corrected_, printed_;
  Cylinder cylinder_;
};

}  // namespace

std::unique_ptr<PaperFigure> make_force_figure(const std::string& number, const std::string& fabric_id,
                                               const std::string& stands_for) {
  return std::make_unique<ForceFigure>(number, fabric_id, stands_for);
}

}  // namespace fuai
