// Puts the paper's figures together.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/paper_page.h"

#include <cstdio>
#include <string>

#include "fuai/core/error.h"
#include "fuai/experiments/paper_context.h"

namespace fuai {
namespace {

void add_introduction(HtmlPage& page) {
  page.raw(
      "<p "
      "lang=\"ja\">和田典大、亀田能成、角所考、美濃導彦「仮想布操作のための視覚・力覚フィードバックの実現」("
      "京都大学) の図を、"
      "実測した布で作り直したもの。</p>\n");
  page.paragraph(
      "The figures of the founding paper (Wada, Kameda, Kakusho, Minoh, Kyoto University), remade with "
      "measured fabrics. Each "
      "experiment runs in two forms. As printed: the equations to the letter, with bending forces on the end "
      "particles only, the "
      "single branch of the measured loop, and no memory. Corrected: full gradients with the reaction on the "
      "middle particle, "
      "the whole loop with memory, area weights. Both relax by the paper's per-particle descent, Eq. (6).");
  page.list({"Moments and forces are per KES: 1 gf = 9.80665e-3 N; curvature in 1/cm.",
             "Two colours for the yarn directions everywhere: warp and weft as in the legend of Figure 1.",
             "Each table stands beside this page as CSV, each plot as SVG."});
}

}  // namespace

std::string text_of(const char* format, double value) {
  char text[64];
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  std::snprintf(text, sizeof text, format, value);
#pragma GCC diagnostic pop
  return text;
}

PaperPage make_paper_page(const PaperPageOptions& options, const Progress& progress) {
  const int figure = options.figure;
  if (figure != 0 && figure != 1 && figure != 4 && figure != 6 && figure != 7 && figure != 8) {
    throw Error(ErrorKind::kUsage, "the paper's page has no figure " + std::to_string(figure), {},
                "use 1, 4, 6, 7 or 8");
  }
  const auto wanted = [&](int number) { return figure == 0 || figure == number; };
  PaperContext context{make_offscreen_renderer(),
                       HtmlPage("Virtual cloth of a measured fabric: the founding paper's figures, remade"),
                       {},
                       progress,
                       0.0,
                       1.0};
  add_introduction(context.page);
  // Shares of the run time, for the progress bar only.
  const auto run = [&](int number, double share, auto add) {
    if (!wanted(number)) return;
    context.share = figure == 0 ? share : 1.0;
    add();
    context.fraction += context.share;
  };
  run(1, 0.02, [&] { add_figure_1(context); });
  run(4, 0.68, [&] { add_figure_4(context); });
  run(6, 0.10, [&] { add_figure_6(context); });
  run(7, 0.10, [&] { add_figures_7_and_8(context, true, false); });
  run(8, 0.10, [&] { add_figures_7_and_8(context, false, true); });
  context.add_file("index.html", context.page.html());
  return std::move(context.result);
}

}  // namespace fuai
