// The bent strip of Figures 6 to 8: one run through a list of curvatures.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fuai/experiments/paper_page.h"
#include "fuai/fabric/fabric.h"
#include "fuai/scenes/paper_bending.h"

namespace fuai {

/// A strip, bent stage by stage.
struct StripRun {
  Fabric fabric;
  FabricLaws laws;
  PaperMode mode = PaperMode::kCorrected;
  std::vector<PaperBendingStage> stages;
  double spacing = 0.0;                 ///< [m]
  int columns = 0, rows = 0, grip = 0;  ///< nodes; index of the held particle
  double seconds = 0.0;
};

/// Bends a strip of a bundled fabric through the curvatures [1/m], in their order.
StripRun run_strip(const std::string& fabric_id, PaperMode mode, std::span<const double> curvatures,
                   const Progress& progress);

/// The line of the summary: steps of all stages, largest residual.
PaperSummaryRow summary_of(const std::string& figure, const StripRun& run);

}  // namespace fuai
