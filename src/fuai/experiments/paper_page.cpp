// Puts the paper's figures together: all computations first, side by side, then the pages in order.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/paper_page.h"

#include <cstdio>
#include <string>

#include "fuai/core/error.h"
#include "fuai/experiments/paper_context.h"
#include "fuai/runtime/parallel.h"
#include "fuai/runtime/shared_progress.h"

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
      "experiment runs in two forms, Figures 4 and 6 to 8 also in a third: on the cloth engine, at rest. As "
      "printed: the equations to the letter, with bending forces on the end "
      "particles only, "
      "the single branch of the measured loop, and no memory. Corrected: full gradients with the reaction on "
      "the middle "
      "particle, the whole loop with memory, area weights. These two relax by the paper's per-particle "
      "descent, "
      "Eq. (6).");
  page.list({"1 gf = 9.80665e-3 N. Moments are per width, in gf·cm/cm; curvatures in 1/cm.",
             "Warp is blue and weft is orange, in every plot and picture.",
             "Each table stands beside this page as CSV, each plot as SVG.",
             "Weight of a node: areal mass times spacing squared times standard gravity."});
}

std::vector<std::unique_ptr<PaperFigure>> wanted_figures(int figure) {
  if (figure != 0 && figure != 1 && figure != 4 && figure != 6 && figure != 7 && figure != 8) {
    throw Error(ErrorKind::kUsage, "the paper's page has no figure " + std::to_string(figure), {},
                "use 1, 4, 6, 7 or 8");
  }
  const auto wanted = [&](int number) { return figure == 0 || figure == number; };
  std::vector<std::unique_ptr<PaperFigure>> figures;
  if (wanted(1)) figures.push_back(make_figure_1());
  if (wanted(4)) figures.push_back(make_figure_4());
  if (wanted(4)) figures.push_back(make_engine_drapes());
  if (wanted(6)) figures.push_back(make_figure_6());
  // The measured rigidities nearest to the graded family's: 0.067 to 0.064, 0.019 to 0.017 gf cm2/cm in warp.
  if (wanted(7)) figures.push_back(make_force_figure("7", "wool-tropical", "3"));
  if (wanted(8)) figures.push_back(make_force_figure("8", "polyester-faille", "1"));
  if (wanted(6) || wanted(7) || wanted(8)) figures.push_back(make_engine_strips());
  if (wanted(1)) figures.push_back(make_measured_cycles());
  return figures;
}

void run_tasks(const std::vector<PaperTask>& tasks, int threads, const Progress& progress) {
  SharedProgress shared(progress, tasks.size());
  std::vector<std::function<void()>> work;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    work.emplace_back([&, i] {
      const Progress own = shared.of(i, tasks[i].name);
      tasks[i].run(own);
      if (own) own("", 1.0);
    });
  }
  run_parallel(work, threads);
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
  const auto figures = wanted_figures(options.figure);
  // The renderer first: a missing driver shows before the long runs.
  PaperContext context{make_offscreen_renderer(),
                       HtmlPage("Virtual cloth of a measured fabric: the founding paper's figures, remade"),
                       {}};
  std::vector<PaperTask> tasks;
  for (const auto& figure : figures) {
    for (PaperTask& task : figure->tasks()) tasks.push_back(std::move(task));
  }
  run_tasks(tasks, options.threads, progress);
  add_introduction(context.page);
  for (const auto& figure : figures) figure->write(context);
  context.add_file("index.html", context.page.html());
  return std::move(context.result);
}

}  // namespace fuai
