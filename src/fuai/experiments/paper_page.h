// Remakes the founding paper's figures: pictures, plots, tables and a page that explains them.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth" (Japanese), Figs. 1,
// 4, 6, 7, 8.
#pragma once

#include <vector>

#include "fuai/core/progress.h"
#include "fuai/experiments/html_page.h"

namespace fuai {

/// Which figures to make.
struct PaperPageOptions {
  int figure = 0;   ///< 0: all; else 1, 4, 6, 7 or 8
  int threads = 0;  ///< 0: as many as the machine has cores; the results do not depend on it
};

/// One line of the summary that the command prints and --json carries.
struct PaperSummaryRow {
  std::string figure, fabric, mode;
  long long steps = 0;
  double residual_node_weights = 0.0;  ///< largest out-of-balance force in weights of a node; on the engine
                                       ///< the root of the sum of squares, which is no less
  bool converged = false;
  double seconds = 0.0;  ///< wall clock of this run
};

struct PaperPage {
  std::vector<OutputFile> files;      ///< index.html, PNG and CSV
  std::vector<PaperSummaryRow> runs;  ///< every relaxation that was run
};

/// Makes the page. Needs an OpenGL driver for the pictures.
/// @throws Error (kUsage) for a figure that does not exist, (kNoDevice) without OpenGL, (kBadInput) when a
/// bundled fabric cannot be read. Thread class: set-up.
PaperPage make_paper_page(const PaperPageOptions& options, const Progress& progress);

}  // namespace fuai
