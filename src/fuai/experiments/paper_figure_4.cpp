// Figure 4: the corner drape of four fabrics, as printed and corrected.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>

#include "fuai/experiments/paper_context.h"
#include "fuai/experiments/scene_pictures.h"
#include "fuai/io/fabric_library.h"
#include "fuai/scenes/paper_drape.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

/// The family that stands for the paper's unpublished characteristics, and four fabrics that were measured.
constexpr std::array kGraded{"graded-1", "graded-3", "graded-6", "graded-10"};
constexpr std::array kMeasured{"polyester-faille", "cupro-woven-su1098", "cotton-knit-shirley",
                               "wool-tropical"};

/// The printed form does not converge; it is stopped here, a hundred times the paper's 300 updates.
constexpr std::int64_t kPrintedSteps = 30'000;
constexpr int kWidth = 760, kHeight = 640;
constexpr std::int64_t kMostSteps = 20'000'000;

struct Drape {
  std::string id, name;
  PaperMode mode = PaperMode::kCorrected;
  RelaxationResult result;
  double seconds = 0.0, corner_z = 0.0, side_z = 0.0;
  SurfaceMesh mesh;
};

const char* mode_name(PaperMode mode) { return mode == PaperMode::kAsPrinted ? "as printed" : "corrected"; }

Drape run_drape(const std::string& id, PaperMode mode, const Progress& progress) {
  const Fabric fabric = load_fabric(id);
  PaperDrapeOptions options;
  options.relaxation.mode = mode;
  PaperDrape scene = make_paper_drape(make_fabric_laws(fabric), options);
  RelaxationStop stop;
  stop.max_steps = mode == PaperMode::kAsPrinted ? kPrintedSteps : kMostSteps;
  const Stopwatch watch;
  Drape drape{id, fabric.name, mode, scene.solver.run(scene.state, stop, progress), 0.0, 0.0, 0.0, {}};
  drape.seconds = watch.seconds();
  const LatticeModel& model = *scene.model;
  drape.corner_z = scene.free_corner().z();
  drape.side_z = scene.state.positions[static_cast<std::size_t>(model.node(model.columns - 1, 0))].z();
  drape.mesh = make_lattice_mesh(model.columns, model.rows, model.spacing, scene.state.positions);
  return drape;
}

HtmlTable drape_table(const std::vector<Drape>& drapes) {
  HtmlTable table;
  table.caption =
      "The runs. Residual: largest out-of-balance force in weights of a node; converged means below 0.001.";
  table.header = {"fabric",
                  "mode",
                  "steps",
                  "residual [node weights]",
                  "converged",
                  "free corner z [cm]",
                  "side corner z [cm]",
                  "largest stretch [%]",
                  "time [s]"};
  for (const Drape& d : drapes) {
    table.rows.push_back(
        {d.name, mode_name(d.mode), std::to_string(d.result.steps), text_of("%.2g", d.result.residual),
         d.result.converged ? "yes" : "no", text_of("%.2f", d.corner_z / unit::kCentimetre),
         text_of("%.2f", d.side_z / unit::kCentimetre),
         text_of("%.1f", d.result.max_stretch / unit::kPercent), text_of("%.1f", d.seconds)});
  }
  return table;
}

void add_gallery(PaperContext& context, const std::vector<Drape>& drapes, const std::string& caption) {
  std::vector<std::pair<std::string, std::string>> pictures;
  for (const Drape& d : drapes) {
    const std::string file = "figure4-" + d.id + (d.mode == PaperMode::kAsPrinted ? "-printed" : "") + ".png";
    context.add_picture(
        file, paper_drape_picture(d.mesh, d.name + ", " + mode_name(d.mode), kWidth / double{kHeight}),
        kWidth, kHeight);
    pictures.emplace_back(file, d.name + " (" + mode_name(d.mode) + ")");
  }
  context.page.gallery(pictures, caption);
}

}  // namespace

void add_figure_4(PaperContext& context) {
  std::vector<Drape> graded, measured, printed;
  int index = 0;
  const int count = static_cast<int>(2 * kGraded.size() + kMeasured.size());
  const auto run = [&](const char* id, PaperMode mode) {
    return run_drape(id, mode,
                     context.part(std::string("drape of ") + id + ", " + mode_name(mode), index++, count));
  };
  for (const char* id : kGraded) graded.push_back(run(id, PaperMode::kCorrected));
  for (const char* id : kMeasured) measured.push_back(run(id, PaperMode::kCorrected));
  for (const char* id : kGraded) printed.push_back(run(id, PaperMode::kAsPrinted));

  HtmlPage& page = context.page;
  page.heading("Figure 4: comparison of drapes", "figure4");
  page.paragraph(
      "18 x 18 particles, 1 cm apart; 5 x 5 of them lie fixed on the corner of a table, the rest is let go "
      "from flat and hangs "
      "under its own weight. The paper's four bending characteristics were never published. The graded "
      "family stands for them: "
      "the 5, 25, 50 and 75 % quantiles of the bending stiffness of 121 real fabrics, all four with the same "
      "weight.");
  add_gallery(context, graded,
              "Corrected: full gradients, the law with memory, area weights; at rest. Every line is one "
              "thread in ten; "
              "warp and weft have the same two colours in every picture.");
  add_gallery(context, measured,
              "The same experiment with the fabrics that were really measured, corrected mode.");
  add_gallery(context, printed,
              "As printed, after " + std::to_string(kPrintedSteps) +
                  " steps (the paper made about 300 updates). It never comes to rest: bending forces act on "
                  "the ends of each "
                  "three particles only, so flat cloth is unstable, and the single branch pushes with 2HB/2 "
                  "even when flat.");
  std::vector<Drape> all = graded;
  all.insert(all.end(), measured.begin(), measured.end());
  all.insert(all.end(), printed.begin(), printed.end());
  context.add_table("figure4.csv", drape_table(all));
  double slowest = 0.0;
  for (const Drape& d : graded) slowest = std::max(slowest, d.seconds);
  for (const Drape& d : all) {
    context.result.runs.push_back(
        {"4", d.id, mode_name(d.mode), d.result.steps, d.result.residual, d.result.converged, d.seconds});
  }
  page.paragraph("Against the paper's 30 seconds: the slowest corrected drape of the family took " +
                 text_of("%.0f", slowest) +
                 " s here to a residual below 0.001 node weights; the paper stopped after about 300 updates, "
                 "where this method is "
                 "still close to flat.");
  page.list(
      {"Agrees with the paper: stiffer cloth stands further out and its corner hangs less; the order of the "
       "four is the paper's.",
       "Does not agree: a bulge near the corner that the paper's Figure 4 shows for characteristics 6 and 10 "
       "comes, in the printed "
       "form, partly from its instability and not from the cloth.",
       "Weak: the springs are about a thousand times softer than threads (10 gf/cm), the price of a plain "
       "descent; so the cloth "
       "stretches as the table says. The engine that replaces it will not need that."});
}

}  // namespace fuai
