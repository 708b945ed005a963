// Lists and runs the scenes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/scenes/catalogue.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "fuai/core/error.h"
#include "fuai/scenes/paper_bending.h"
#include "fuai/scenes/paper_drape.h"

namespace fuai {
namespace {

constexpr double kStepsPerSecond = 10.0;  // "about 10 Hz", section 4.1 of the paper
constexpr std::int64_t kMostSteps = 20'000'000, kPrintedSteps = 30'000;
constexpr double kBentCurvature = 12.0;  // [1/m]: well past a quarter turn of the 16 cm strip

constexpr std::array kEntries{
    SceneEntry{"paper_drape",
               "18 x 18 particles at 1 cm, 5 x 5 of them on a table's corner, let go from flat (the paper's "
               "Figure 4)"},
    SceneEntry{"paper_bending",
               "17 x 9 particles at 1 cm, clamped at one edge, bent by one held particle (the paper's "
               "Figures 6 to 8)"},
};

RelaxationStop stop_at(PaperMode mode, std::optional<double> seconds) {
  RelaxationStop stop;
  stop.max_steps = mode == PaperMode::kAsPrinted ? kPrintedSteps : kMostSteps;
  if (seconds)
    stop.max_steps = static_cast<std::int64_t>(std::llround(std::min(*seconds * kStepsPerSecond, 1e15)));
  return stop;
}

SceneMoment run_drape(const FabricLaws& laws, PaperMode mode, const RelaxationStop& stop,
                      const Progress& progress) {
  PaperDrapeOptions options;
  options.relaxation.mode = mode;
  PaperDrape scene = make_paper_drape(laws, options);
  SceneMoment moment;
  moment.relaxation = scene.solver.run(scene.state, stop, progress);
  const LatticeModel& model = *scene.model;
  moment.mesh = make_lattice_mesh(model.columns, model.rows, model.spacing, scene.state.positions);
  return moment;
}

SceneMoment run_bending(const FabricLaws& laws, PaperMode mode, const RelaxationStop& stop,
                        const Progress& progress) {
  PaperBendingOptions options;
  options.relaxation.mode = mode;
  options.stop = stop;
  PaperBending scene = make_paper_bending(laws, options);
  SceneMoment moment;
  PaperBendingStage stage = bend_to(scene, kBentCurvature, progress);
  moment.relaxation = stage.relaxation;
  const LatticeModel& model = *scene.model;
  moment.mesh = make_lattice_mesh(model.columns, model.rows, model.spacing, stage.positions);
  return moment;
}

}  // namespace

std::span<const SceneEntry> scene_entries() { return kEntries; }

SceneMoment run_scene(std::string_view name, const FabricLaws& laws, PaperMode mode,
                      std::optional<double> seconds, const Progress& progress) {
  const RelaxationStop stop = stop_at(mode, seconds);
  if (name == "paper_drape") return run_drape(laws, mode, stop, progress);
  if (name == "paper_bending") return run_bending(laws, mode, stop, progress);
  std::string known;
  for (const SceneEntry& entry : kEntries) known += (known.empty() ? "" : ", ") + std::string(entry.name);
  throw Error(ErrorKind::kUsage, "there is no scene '" + std::string(name) + "'", {},
              "the scenes are " + known);
}

}  // namespace fuai
