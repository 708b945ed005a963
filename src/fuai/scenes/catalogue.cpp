// Lists and runs the scenes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/scenes/catalogue.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "fuai/core/error.h"
#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/paper_bending.h"
#include "fuai/scenes/paper_drape.h"

namespace fuai {
namespace {

constexpr double kStepsPerSecond = 10.0;  // "about 10 Hz", section 4.1 of the paper
constexpr std::int64_t kMostSteps = 20'000'000, kPrintedSteps = 30'000;
constexpr double kBentCurvature = 12.0;  // [1/m]: well past a quarter turn of the 16 cm strip

using Maker = EngineScene (*)(const FabricLaws&, const SceneOptions&);

struct Scene {
  SceneEntry entry;
  Maker make;  // null: the paper's
};

constexpr std::array kScenes{
    Scene{{"hanging_sheet", "33 x 33 nodes at 1 cm, let go from level, held by two corners",
           SceneKind::kEngine},
          make_hanging_sheet},
    Scene{{"hanging_strip", "64 rows, 9 columns at 1 cm, hung from the top edge", SceneKind::kEngine},
          make_hanging_strip},
    Scene{{"taut_patch", "32 x 32 at 1 cm, top edge clamped, a fingertip pulls at 2 Hz and trembles at 8 Hz",
           SceneKind::kEngine},
          make_taut_patch},
    Scene{{"yank", "the same sheet; the fingertip goes at 5 m/s for 20 ms and stops", SceneKind::kEngine},
          make_yank},
    Scene{{"shake", "the same sheet; the fingertip zig-zags at 5 m/s in a box of 30 cm", SceneKind::kEngine},
          make_shake},
    Scene{
        {"bending", "17 x 17 at 1 cm, no gravity, two rows clamped, the tip lifted by 4 cm and brought back",
         SceneKind::kEngine},
        make_bending},
    Scene{
        {"corner_drape", "a sheet of 17 cm, a corner block of 4 cm held: the paper's Figure 4 on the engine",
         SceneKind::kEngine},
        make_corner_drape},
    Scene{{"grasp_and_lift", "33 x 33 at 1 cm, far edge held; a hand lifts a corner by 15 cm and lets go",
           SceneKind::kEngine},
          make_grasp_and_lift},
    Scene{{"table_edge", "33 x 33 at 1 cm, pinned flat on a table, falls over its edge", SceneKind::kEngine},
          make_table_edge},
    Scene{{"drape_tester", "a round specimen of 30 cm on a disc of 18 cm, let go from flat",
           SceneKind::kEngine},
          make_drape_tester},
    Scene{{"paper_drape",
           "18 x 18 particles at 1 cm, 5 x 5 of them on a table's corner, let go from flat (the paper's "
           "Figure 4)",
           SceneKind::kPaper},
          nullptr},
    Scene{
        {"paper_bending",
         "17 x 9 particles at 1 cm, clamped at one edge, bent by one held particle (the paper's Figures 6 to "
         "8)",
         SceneKind::kPaper},
        nullptr},
};

/// The entries alone, for scene_entries().
constexpr auto kEntries = [] {
  std::array<SceneEntry, kScenes.size()> entries;
  for (std::size_t i = 0; i < kScenes.size(); ++i) entries[i] = kScenes[i].entry;
  return entries;
}();

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

const SceneEntry& find_scene(std::string_view name) {
  for (const SceneEntry& entry : kEntries)
    if (entry.name == name) return entry;
  std::string known;
  for (const SceneEntry& entry : kEntries) known += (known.empty() ? "" : ", ") + std::string(entry.name);
  throw Error(ErrorKind::kUsage, "there is no scene '" + std::string(name) + "'", {},
              "the scenes are " + known);
}

EngineScene make_engine_scene(std::string_view name, const FabricLaws& laws, const SceneOptions& options) {
  find_scene(name);
  for (const Scene& scene : kScenes)
    if (scene.entry.name == name && scene.make) return scene.make(laws, options);
  throw Error(ErrorKind::kUsage, "'" + std::string(name) + "' is a scene of the paper, which has no time", {},
              "`fuai paper` and `fuai render` run it");
}

SceneMoment run_scene(std::string_view name, const FabricLaws& laws, PaperMode mode,
                      std::optional<double> seconds, const Progress& progress) {
  const RelaxationStop stop = stop_at(mode, seconds);
  if (name == "paper_drape") return run_drape(laws, mode, stop, progress);
  if (name == "paper_bending") return run_bending(laws, mode, stop, progress);
  find_scene(name);
  throw Error(ErrorKind::kUsage, "'" + std::string(name) + "' is a scene of the engine, not of the paper");
}

}  // namespace fuai
