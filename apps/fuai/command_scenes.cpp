// `fuai scenes` and `fuai render`.
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <optional>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/experiments/scene_pictures.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"
#include "fuai/picture/image.h"
#include "fuai/picture/offscreen_renderer.h"
#include "fuai/scenes/catalogue.h"
#include "fuai/units/parse.h"

namespace fuai_app {

using namespace fuai;

int run_scenes(const Console& console) {
  JsonValue list{JsonValue::Array{}};
  for (const SceneEntry& entry : scene_entries()) {
    const std::string name(entry.name), description(entry.description);
    std::string line = name;
    line.append(name.size() < 16 ? 16 - name.size() : 1, ' ').append(description);
    console.line(line);
    list.push(JsonValue().set("name", name).set("description", description));
  }
  console.result(JsonValue().set("scenes", std::move(list)));
  return 0;
}

int run_render(const Console& console, const RenderOptions& options) {
  if (!options.output.ends_with(".png")) {
    throw Error(ErrorKind::kUsage, "-o: pictures are PNG files, got '" + options.output + "'", {},
                "end the name in .png");
  }
  std::optional<double> seconds;
  if (!options.time.empty()) {
    seconds = parse_value(options.time, kTime, "--time");
    if (*seconds < 0.0)
      throw Error(ErrorKind::kUsage, "--time must not be negative", {}, "give a time such as 2s");
  }
  const PaperMode mode = options.as_printed ? PaperMode::kAsPrinted : PaperMode::kCorrected;
  const Fabric fabric = load_fabric(options.fabric);
  for (const std::string& warning : fabric.warnings) console.warn(warning);
  check_can_write(options.output);
  OffscreenRenderer renderer =
      make_offscreen_renderer();  // before the long run: a missing driver shows at once
  SceneMoment moment = run_scene(options.scene, make_fabric_laws(fabric), mode, seconds, console.progress());
  const RelaxationResult& r = moment.relaxation;
  const std::string caption = fabric.name + (options.as_printed ? ", as printed" : "");
  const ClothPicture picture = scene_picture(options.scene, std::move(moment.mesh), caption,
                                             static_cast<double>(options.width) / options.height);
  write_atomically(options.output, encode_png(renderer.render(picture, options.width, options.height)));
  console.say("wrote " + options.output + " after " + std::to_string(r.steps) + " steps, residual " +
              format_number(r.residual) + " node weights" + (r.converged ? "" : ", not at rest"));
  JsonValue json;
  json.set("file", options.output)
      .set("scene", options.scene)
      .set("fabric", fabric.id)
      .set("steps", std::int64_t{r.steps});
  json.set("residual_node_weights", r.residual)
      .set("converged", r.converged)
      .set("max_strain", r.max_stretch);
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(r.position_hash));
  json.set("state_hash", hash);
  console.result(json);
  return 0;
}

}  // namespace fuai_app
