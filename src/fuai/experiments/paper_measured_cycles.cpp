// Not in the paper: the laws driven through the measured nested cycles, and where they miss.
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "fuai/experiments/fabric_plot.h"
#include "fuai/experiments/measured_cycles.h"
#include "fuai/experiments/paper_context.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

HtmlTable cycle_table(const std::vector<MeasuredCycles>& all) {
  HtmlTable table;
  table.caption =
      "Misfit of the law in each measured cycle, in percent of that cycle's peak; energy lost in the cycle.";
  table.header = {"fabric",
                  "test",
                  "cycle",
                  "peak strain or angle",
                  "peak [gf/cm]",
                  "rms [%]",
                  "largest [%]",
                  "lost, measured [gf·cm/cm²]",
                  "lost, law [gf·cm/cm²]"};
  for (const MeasuredCycles& m : all) {
    for (const CycleMisfit& c : m.comparison.cycles) {
      const bool shear = m.curve.test == Test::kShear;
      table.rows.push_back({m.fabric_name, m.law, std::to_string(c.cycle + 1),
                            shear ? text_of("%.1f deg", c.peak_strain / unit::kDegree)
                                  : text_of("%.2f %%", c.peak_strain / unit::kPercent),
                            text_of("%.1f", c.peak_stress / unit::kGfPerCm),
                            text_of("%.1f", 100.0 * c.rms_fraction), text_of("%.1f", 100.0 * c.max_fraction),
                            text_of("%.3f", c.measured_loop_area / unit::kGfCmPerCm2),
                            text_of("%.3f", c.predicted_loop_area / unit::kGfCmPerCm2)});
    }
  }
  return table;
}

class MeasuredCyclesSection : public PaperFigure {
 public:
  std::vector<PaperTask> tasks() override {
    return {{"measured nested cycles", [this](const Progress&) { all_ = compare_all_measured_cycles(); }}};
  }

  void write(PaperContext& context) override {
    HtmlPage& page = context.page;
    page.heading("Beyond the paper: partial reversals against measurement", "cycles");
    page.paragraph(
        "The paper leaves open what the cloth does when it turns back before the end of a branch. The Fabric "
        "Analyzer's stretch "
        "tests turn back four times at growing loads. The law is made from the first loading and the last "
        "recovery only (its play "
        "radii from all cycles); the turns between are its prediction.");
    PlotGrid grid;
    grid.title = "Measured cycles and the law driven along the same path";
    grid.columns = 2;
    for (const MeasuredCycles& m : all_) grid.plots.push_back(measured_cycles_plot(m));
    context.add_plot("measured-cycles", grid, 1200, 1100);
    page.figure("measured-cycles.png", "Points measured, lines the law.",
                "nested cycles, measured and predicted");
    context.add_table("measured-cycles.csv", cycle_table(all_));
    page.list(
        {"Right: virgin loading, last recovery and the closing of the small loops; every cycle of the knit.",
         "Wrong: in the small cycles of the woven cupro the law loses too much. Friction in tension grows "
         "with the load of "
         "the cycle; the law's friction depends on strain only.",
         "Wrong: a strip that has been stretched starts its next cycle a little longer; the law has no "
         "lasting elongation.",
         "Wrong: a bias strip reloads along a softer curve than the virgin one, and its angle creeps on "
         "while the load "
         "already falls; the law climbs back too early and loses too much."});
  }

 private:
  std::vector<MeasuredCycles> all_;
};

}  // namespace

std::unique_ptr<PaperFigure> make_measured_cycles() { return std::make_unique<MeasuredCyclesSection>(); }

}  // namespace fuai
