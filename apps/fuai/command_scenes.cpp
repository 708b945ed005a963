// `fuai scenes` and `fuai render`.
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/experiments/scene_pictures.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"
#include "fuai/picture/image.h"
#include "fuai/picture/offscreen_renderer.h"
#include "fuai/scenes/catalogue.h"
#include "scene_options.h"

namespace fuai_app {

using namespace fuai;

namespace {

struct RenderOptions {
  std::string scene;
  std::string fabric = "cupro-woven-su1098";
  std::string time;     ///< with unit; empty: the scene's own, of the paper's until it is at rest
  int size = 0;         ///< nodes a side; 0: the scene's own
  std::string spacing;  ///< with unit; empty: the scene's own
  std::string output;
  int width = 1280, height = 800;
  bool as_printed = false, weave = false;
};

int run_scenes(const Console& console) {
  JsonValue list{JsonValue::Array{}};
  for (const SceneEntry& entry : scene_entries()) {
    const std::string name(entry.name), description(entry.description);
    std::string line = name;
    line.append(name.size() < 16 ? 16 - name.size() : 1, ' ').append(description);
    console.line(line);
    list.push(JsonValue()
                  .set("name", name)
                  .set("description", description)
                  .set("solver", entry.kind == SceneKind::kEngine ? "engine" : "paper"));
  }
  console.result(JsonValue().set("scenes", std::move(list)));
  return 0;
}

/// Pictures are taken of a run in steps of this length [s].
constexpr double kRenderStep = 0.001;

/// What a run ends with, besides its picture.
struct Rendered {
  ClothPicture picture;
  JsonValue json;
  std::string message;
};

double aspect_of(const RenderOptions& options) { return static_cast<double>(options.width) / options.height; }

Rendered render_paper(const Console& console, const RenderOptions& options, const Fabric& fabric,
                      std::optional<double> seconds) {
  const PaperMode mode = options.as_printed ? PaperMode::kAsPrinted : PaperMode::kCorrected;
  SceneMoment moment = run_scene(options.scene, make_fabric_laws(fabric), mode, seconds, console.progress());
  const RelaxationResult& r = moment.relaxation;
  Rendered out;
  out.picture = scene_picture(options.scene, std::move(moment.mesh),
                              options.scene + ": " + fabric.name + (options.as_printed ? ", as printed" : ""),
                              aspect_of(options));
  out.message = "after " + std::to_string(r.steps) + " steps, residual " + format_number(r.residual) +
                " node weights" + (r.converged ? "" : ", not at rest");
  out.json.set("steps", std::int64_t{r.steps})
      .set("residual_node_weights", r.residual)
      .set("converged", r.converged)
      .set("max_strain", r.max_stretch);
  out.json.set("state_hash", hash_text(r.position_hash));
  return out;
}

Rendered render_engine(const Console& console, const RenderOptions& options, const Fabric& fabric,
                       const EngineScene& scene, std::optional<double> seconds) {
  SceneRunner<float> runner(scene);
  const double until = seconds.value_or(scene.shown_at());
  const std::int64_t steps = until > 0.0 ? steps_of(until, kRenderStep, "--time") : 0;
  const Progress progress = console.progress();
  StepReport report;
  for (std::int64_t i = 0; i < steps; ++i) {
    report = runner.step(kRenderStep);
    if (progress && i % 16 == 0) progress(scene.name, static_cast<double>(i) / static_cast<double>(steps));
  }
  ClothState state;
  runner.simulation().snapshot(state);
  std::vector<GraspReading> hands;
  for (std::size_t i = 0; i < scene.hands.size(); ++i) hands.push_back(runner.hand_reading(i));
  const SimulationReading reading = runner.simulation().read();
  Rendered out;
  char time[32];
  std::snprintf(time, sizeof time, ", %.4g s", until);
  out.picture =
      engine_scene_picture(scene, state, hands, scene.name + ": " + fabric.name + time, aspect_of(options));
  out.message = "after " + format_number(until) + " s, residual " + format_number(report.residual) + " N";
  out.json.set("steps", steps)
      .set("residual_N", report.residual)
      .set("max_strain", reading.max_strain)
      .set("state_hash", hash_text(reading.state_hash));
  return out;
}

/// @throws Error (kUsage) for options that the kind of scene does not take.
void check_render_options(const RenderOptions& options, SceneKind kind) {
  if (!options.output.ends_with(".png")) {
    throw Error(ErrorKind::kUsage, "-o: pictures are PNG files, got '" + options.output + "'", {},
                "end the name in .png");
  }
  if (kind == SceneKind::kEngine && options.as_printed) {
    throw Error(ErrorKind::kUsage, "--as-printed is for the scenes of the paper", {},
                "take paper_drape or paper_bending, or leave it out");
  }
  if (kind == SceneKind::kPaper && (options.size != 0 || !options.spacing.empty())) {
    throw Error(ErrorKind::kUsage, "a scene of the paper has the paper's size and spacing", {},
                "leave --size and --spacing out, or take corner_drape or bending");
  }
}

int run_render(const Console& console, const RenderOptions& options) {
  const SceneKind kind = named_scene(options.scene).kind;
  check_render_options(options, kind);
  std::optional<double> seconds;
  if (!options.time.empty()) seconds = time_value(options.time, "--time", false);
  const SceneOptions size = scene_options(options.size, options.spacing);
  const Fabric fabric = load_fabric(options.fabric);
  for (const std::string& warning : fabric.warnings) console.warn(warning);
  check_can_write(options.output);
  std::optional<EngineScene> scene;
  if (kind == SceneKind::kEngine) scene = make_engine_scene(options.scene, make_fabric_laws(fabric), size);
  OffscreenRenderer renderer =
      make_offscreen_renderer();  // before the long run: a missing driver shows at once
  Rendered out = scene ? render_engine(console, options, fabric, *scene, seconds)
                       : render_paper(console, options, fabric, seconds);
  if (options.weave)
    for (ClothItem& cloth : out.picture.cloths) cloth.yarns = yarns_of(fabric);
  write_atomically(options.output, encode_png(renderer.render(out.picture, options.width, options.height)));
  console.say("wrote " + options.output + " " + out.message);
  JsonValue json = out.json;
  json.set("file", options.output).set("scene", options.scene).set("fabric", fabric.id);
  console.result(json);
  return 0;
}

}  // namespace

void declare_scenes(const Command& parent) {
  const Command command = parent.command("scenes", "List the scenes, one line each");
  command.examples({"fuai scenes", "fuai --json scenes"});
  command.body(run_scenes);
}

void declare_render(const Command& parent) {
  const auto options = std::make_shared<RenderOptions>();
  constexpr int kLeastPixels = 16, kMostPixels = 8192;
  const Command command = parent.command("render", "A picture of a scene, without a display");
  command.option("SCENE", options->scene, "A name that `fuai scenes` lists").required();
  command.option("--fabric", options->fabric, "Bundled name or path of a fabric file");
  command.option("--time", options->time,
                 "Time with unit, e.g. 2s. Default: when the scene shows what it is about. Scenes of the "
                 "paper count ten updates a second, as the paper did; their default: at rest");
  command.option("-o,--output", options->output, "PNG file to write").required();
  declare_size(command, options->size, options->spacing);
  command.option("--width", options->width, "Pixels").range(kLeastPixels, kMostPixels);
  command.option("--height", options->height, "Pixels").range(kLeastPixels, kMostPixels);
  command.flag("--as-printed", options->as_printed,
               "The paper's method with all its faults, instead of the corrected one");
  command.flag("--weave", options->weave, "With the yarns at their true size, where they are to be seen");
  command.examples({"fuai render hanging_sheet --fabric wool-tropical --time 2s -o sheet.png",
                    "fuai render corner_drape --spacing 5mm -o drape.png",
                    "fuai render paper_drape --fabric graded-10 --time 30s --as-printed -o paper.png"});
  command.body([options](const Console& console) { return run_render(console, *options); });
}

}  // namespace fuai_app
