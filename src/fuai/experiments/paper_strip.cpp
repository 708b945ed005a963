// Bends the strip of Figures 6 to 8.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/paper_strip.h"

#include <algorithm>

#include "fuai/experiments/paper_context.h"
#include "fuai/io/fabric_library.h"

namespace fuai {
namespace {

/// The printed form never comes to rest: each stage stops here.
constexpr std::int64_t kPrintedSteps = 20'000, kMostSteps = 5'000'000;

}  // namespace

StripRun run_strip(const std::string& fabric_id, PaperMode mode, std::span<const double> curvatures,
                   const Progress& progress) {
  StripRun run;
  run.fabric = load_fabric(fabric_id);
  run.laws = make_fabric_laws(run.fabric);
  run.mode = mode;
  PaperBendingOptions options;
  options.relaxation.mode = mode;
  if (mode == PaperMode::kCorrected) options.stop.max_steps = kMostSteps;
  if (mode == PaperMode::kAsPrinted) options.stop.max_steps = kPrintedSteps;
  PaperBending scene = make_paper_bending(run.laws, options);
  run.spacing = options.spacing;
  run.columns = scene.model->columns;
  run.rows = scene.model->rows;
  run.grip = scene.grip;
  const Stopwatch watch;
  for (double curvature : curvatures) {
    run.stages.push_back(bend_to(scene, curvature));
    if (progress)
      progress("", static_cast<double>(run.stages.size()) / static_cast<double>(curvatures.size()));
  }
  run.seconds = watch.seconds();
  return run;
}

PaperSummaryRow summary_of(const std::string& figure, const StripRun& run) {
  PaperSummaryRow row{figure, run.fabric.id, mode_name(run.mode), 0, 0.0, true, run.seconds};
  for (const PaperBendingStage& s : run.stages) {
    row.steps += s.relaxation.steps;
    row.residual_node_weights = std::max(row.residual_node_weights, s.relaxation.residual);
    row.converged = row.converged && s.relaxation.converged;
  }
  return row;
}

}  // namespace fuai
