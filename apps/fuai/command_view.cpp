// `fuai view`.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/device/registry.h"
#include "fuai/io/text_file.h"
#include "fuai/runtime/interrupt.h"
#include "fuai/viewer/view_session.h"
#include "fuai/window/kept_settings.h"
#include "fuai/window/viewer.h"
#include "scene_options.h"

namespace fuai_app {

using namespace fuai;

namespace {

struct ViewOptions {
  std::vector<std::string> fabrics;
  std::string scene = "hanging_sheet";
  int size = 0;         ///< nodes a side; 0: the scene's own
  std::string spacing;  ///< with unit; empty: the scene's own
  std::string seconds;  ///< with unit; empty: until it is closed
  std::string screenshot, record, replay, folder = ".";
  std::string device = "mouse";
  std::string language, theme, units, heat_map;
  int width = 1280, height = 720;
  std::string texture, texture_width = "10cm";
  int zoom = 1, felt = 1, scale = 0;
  bool headless = false, moves = false, bare = false, weave = false, no_weave = false, rumble = false,
       sound = false;
};

/// The first bundled fabric that a newcomer sees: measured in bending and tension, of middling weight.
constexpr const char* kFirstFabric = "cupro-woven-su1098";

/// "warp-curvature".
std::string word_of(const ViewQuantity& quantity) {
  std::string word = ui_text(quantity.name, Language::kEnglish);
  std::replace(word.begin(), word.end(), ' ', '-');
  return word;
}

/// Number of the field, -1 for no word. @throws Error (kUsage) with all words.
int heat_map_of(const std::string& word) {
  if (word.empty()) return -1;
  std::string words;
  for (const ViewQuantity& quantity : view_quantities()) {
    if (word_of(quantity) == word) return static_cast<int>(quantity.field);
    words.append(words.empty() ? "" : ", ").append(word_of(quantity));
  }
  throw Error(ErrorKind::kUsage, "--heat-map: '" + word + "' is not known", {}, "use one of " + words);
}

/// @param settings as they were kept; options win
ViewSettings settings_of(const ViewOptions& options, ViewSettings settings) {
  if (options.weave && options.no_weave)
    throw Error(ErrorKind::kUsage, "--weave and --no-weave exclude each other", {}, "leave one out");
  if (!options.language.empty())
    settings.language = options.language == "ja" ? Language::kJapanese : Language::kEnglish;
  if (!options.theme.empty()) settings.dark = options.theme == "dark";
  if (!options.units.empty()) settings.units = options.units == "si" ? UnitSystem::kSi : UnitSystem::kKes;
  if (options.bare) settings.fabric_panel = settings.plots = false;
  if (options.weave || options.no_weave) settings.yarns = options.weave;
  if (options.scale > 0) settings.letters = options.scale;
  settings.heat_map = heat_map_of(options.heat_map);
  return settings;
}

/// Reads what was kept the last time; scripts neither read nor write it.
void take_kept_settings(const Console& console, const ViewOptions& options, ViewerOptions& viewer) {
  if (options.headless || !options.seconds.empty()) return;
  viewer.settings_file = kept_settings_path();
  try {
    viewer.kept = read_kept_settings(viewer.settings_file);
  } catch (const Error& e) {
    console.warn(std::string(e.what()) + " (the settings start anew)");
  }
}

int run_view(const Console& console, const ViewOptions& options) {
  named_scene(options.scene);
  find_device_driver(options.device.substr(0, options.device.find(':')));
  ViewerOptions viewer;
  viewer.scene = options.scene;
  viewer.fabrics = options.fabrics.empty() ? std::vector<std::string>{kFirstFabric} : options.fabrics;
  viewer.size = scene_options(options.size, options.spacing);
  take_kept_settings(console, options, viewer);
  viewer.settings = settings_of(options, viewer.kept.settings);
  viewer.texture = options.texture;
  viewer.texture_width = picture_width_value(options.texture_width, "--texture-width");
  viewer.zoom = options.zoom;
  viewer.width = options.width;
  viewer.height = options.height;
  viewer.window = !options.headless;
  viewer.scene_moves = options.moves;
  if (!options.seconds.empty()) {
    viewer.seconds = time_value(options.seconds, "--seconds", true);
    steps_of(viewer.seconds, kViewStep, "--seconds");
    if (!(viewer.seconds > 0.0))
      throw Error(ErrorKind::kUsage, "--seconds: '" + options.seconds + "' is not above zero", {},
                  "take e.g. 2s, or leave it out");
  }
  viewer.device = options.device;
  viewer.rumble = options.rumble;
  viewer.sound = options.sound;
  viewer.felt = static_cast<std::size_t>(options.felt) - 1;
  viewer.screenshot = options.screenshot;
  viewer.record = options.record;
  viewer.replay = options.replay;
  viewer.folder = options.folder;
  viewer.version = program_version();
  viewer.say = [&console](const std::string& text) { console.warn(text); };
  check_input_survives(options.record, options.replay, "give --record another name");
  check_input_survives(options.screenshot, options.replay, "give --screenshot another name");
  if (options.headless && options.seconds.empty() && options.replay.empty()) {
    throw Error(ErrorKind::kUsage, "without a window there is nobody to close it", {},
                "add --seconds, e.g. --seconds 2s --screenshot cloth.png");
  }
  if (!options.headless && !has_display()) {
    throw Error(ErrorKind::kNoDevice, "there is no display", {},
                "set DISPLAY, or add --headless --seconds 2s --screenshot cloth.png");
  }
  // Ctrl-C closes a window as a click does: the force of a device goes first. Without one there is a script.
  std::optional<InterruptFlag> interrupt;
  if (viewer.window) viewer.stop = &interrupt.emplace().flag();
  const ViewerResult result = run_viewer(viewer);
  JsonValue json;
  json.set("seconds", result.seconds)
      .set("pictures", result.pictures)
      .set("paused_pictures", result.paused_pictures)
      .set("picture_ms", result.picture_ms)
      .set("paint_ms", result.paint_ms)
      .set("renderer", result.renderer)
      .set("state_hash", hash_text(result.state_hash));
  JsonValue::Array forces;
  for (const ShownForce& force : result.forces)
    forces.push_back(JsonValue()
                         .set("cloth", static_cast<std::int64_t>(force.cloth) + 1)
                         .set("hand", force.hand)
                         .set("shown", force.text));
  json.set("forces", std::move(forces));
  JsonValue::Array messages;
  for (const SaidMessage& message : result.messages)
    messages.push_back(JsonValue().set("text", message.text).set("bad", message.bad));
  json.set("messages", std::move(messages));
  if (!result.device.empty())
    json.set("device", result.device)
        .set("overruns", static_cast<std::int64_t>(result.overruns))
        .set("device_force_peak_N", result.device_force);
  if (result.replay_hashes > 0)
    json.set("replay_hashes", result.replay_hashes).set("replay_matches", result.replay_matches);
  if (!options.screenshot.empty()) {
    json.set("file", options.screenshot);
    console.say("wrote " + options.screenshot);
  }
  console.result(json);
  return 0;
}

}  // namespace

void declare_view(const Command& parent) {
  const auto options = std::make_shared<ViewOptions>();
  constexpr int kLeastPixels = 320, kMostPixels = 8192, kMostZoom = 100;
  const Command command =
      parent.command("view", "The viewer: grab cloth, see newtons, compare one to four fabrics");
  command.option(
      "FABRIC", options->fabrics,
      "Bundled names or paths, measured curves behind them as in 'wool-tropical + my.csv'; default: " +
          std::string(kFirstFabric));
  command.option("--scene", options->scene, "A name that `fuai scenes` lists");
  declare_size(command, options->size, options->spacing);
  command.flag("--moves", options->moves, "The scene's own hands and pins move");
  command.option(
      "--device", options->device,
      "Driver, or driver:model, as `fuai haptics devices --diagnose` lists them: a hand beside the mouse");
  command
      .option("--feel", options->felt,
              "Which of several fabrics the device feels; in the window the keys 1 to 4")
      .range(1, static_cast<int>(kMostViewFabrics));
  command.flag("--rumble", options->rumble, "A gamepad rumbles with the force on your hand");
  command.flag("--sound", options->sound, "A tone rises with the force on your hand");
  command.option("--language", options->language, "en or ja").among({"en", "ja"});
  command.option("--theme", options->theme, "dark or light").among({"dark", "light"});
  command.option("--units", options->units, "kes or si").among({"kes", "si"});
  command.option("--heat-map", options->heat_map, "Show a quantity in colour, e.g. warp-curvature");
  command.flag("--weave", options->weave,
               "Show the yarns at their true size, as when nothing was chosen yet");
  command.flag("--no-weave", options->no_weave, "Do not");
  command.option("--texture", options->texture, "PNG that lies on the cloths, repeated");
  command.option("--texture-width", options->texture_width, "What its width is on the cloth, with unit");
  command
      .option("--scale", options->scale,
              "Size of letters and panels in percent; default: what was chosen last, else 100")
      .range(kLeastLetters, kMostLetters);
  command.option("--zoom", options->zoom, "How many times nearer to begin").range(1, kMostZoom);
  command.flag("--bare", options->bare, "Without the panels at the sides");
  command.option("--seconds", options->seconds,
                 "Simulated time after which it ends, e.g. 2s; default: never");
  command.option("--screenshot", options->screenshot, "PNG of the window, written at the end").file();
  command.option("--record", options->record, "Recording of everything that is done").file();
  command.option("--replay", options->replay,
                 "Recording that is done again in the window, and its hashes compared");
  command.option("--out", options->folder, "Folder of pictures, videos and logs that are made by keys");
  command.option("--width", options->width, "Pixels").range(kLeastPixels, kMostPixels);
  command.option("--height", options->height, "Pixels").range(kLeastPixels, kMostPixels);
  command.flag("--headless", options->headless, "Without a window, for scripts");
  command.examples({"fuai view", "fuai view wool-tropical graded-10 --scene corner_drape",
                    "fuai view --device simulated:touch",
                    "fuai view cupro-woven-su1098 --headless --seconds 2s --screenshot cloth.png"});
  command.body([options](const Console& console) { return run_view(console, *options); });
}

}  // namespace fuai_app
