// `fuai haptics devices` and `fuai haptics run`.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "felt_setup.h"
#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/device/registry.h"
#include "fuai/haptics/force_error.h"
#include "fuai/haptics/virtual_session.h"
#include "fuai/io/text_file.h"
#include "scene_options.h"
#include "session_files.h"

namespace fuai_app {

using namespace fuai;

namespace {

struct RunOptions {
  RunOptions() { setup.scene = "grasp_and_lift"; }
  std::string device = "simulated";
  SceneSetup setup;
  std::string hand = "arm";
  std::string seconds;    ///< with unit or bare; empty: the scene's own and the ramp
  int cloth_rate = 1000;  ///< [Hz]
  std::string force_gain = "1";
  std::string record;
  bool no_reference = false, no_controller = false, virtual_time = false;
};

/// Rest before the scene's motion begins, so that it is felt at full force: the ramp [s].
const double kRest = SafetyOptions{}.ramp;
/// Part of the device's workspace that the hand's way is to fill.
constexpr double kFill = 0.8;
constexpr const char* kRecordHead =
    "time_s,dt_s,device_x_m,device_y_m,device_z_m,tool_x_m,tool_y_m,tool_z_m,force_x_N,force_y_N,force_z_N,"
    "model_force_x_N,model_force_y_N,model_force_z_N,energy_J,model,model_age_s,gain,status\n";

int run_devices(const Console& console, bool diagnose) {
  JsonValue list{JsonValue::Array{}};
  for (const DeviceDriver& driver : device_drivers()) {
    const DriverReport report = driver.probe();
    const std::string name(driver.name), description(driver.description);
    console.line(name + (report.available ? "  available: " : "  unavailable: ") +
                 (report.available ? description : report.why_not));
    if (!report.available) console.line("    " + report.cure);
    JsonValue findings{JsonValue::Array{}}, models{JsonValue::Array{}};
    for (const DriverFinding& finding : report.findings) {
      if (diagnose)
        console.line("    " + std::string(finding.fine ? "ok   " : "no   ") + finding.what + ": " +
                     finding.found);
      findings.push(
          JsonValue().set("what", finding.what).set("found", finding.found).set("fine", finding.fine));
    }
    for (const std::string& model : report.models) models.push(model);
    JsonValue entry;
    entry.set("name", name).set("description", description).set("force", driver.force);
    entry.set("available", report.available).set("why_not", report.why_not).set("cure", report.cure);
    entry.set("models", std::move(models));
    if (diagnose) entry.set("findings", std::move(findings));
    list.push(std::move(entry));
  }
  console.result(JsonValue().set("drivers", std::move(list)));
  return 0;
}

/// "simulated:touch" -> the preset. @throws Error (kUsage).
const SimulatedDeviceSpec& simulated_spec(const std::string& device) {
  const std::size_t colon = device.find(':');
  const DeviceDriver& driver = find_device_driver(device.substr(0, colon));
  if (driver.name != "simulated") {
    throw Error(ErrorKind::kUsage, "virtual time is for the simulated device, not '" + device + "'", {},
                "take --device simulated");
  }
  if (colon == std::string::npos) return device_presets().front().spec;
  return find_device_preset(device.substr(colon + 1));
}

/// The way of a scene's hand, from where it begins [m] (ticks), after a rest.
std::vector<Vec3> hand_way(const EngineScene& scene, std::size_t hand, std::int64_t ticks) {
  std::vector<Vec3> way;
  const Vec3 start = scene.motion->hand(hand, 0.0).position;
  for (std::int64_t i = 0; i <= ticks; ++i) {
    const double time = std::max(0.0, static_cast<double>(i) * kTick - kRest);
    way.push_back(scene.motion->hand(hand, time).position - start);
  }
  return way;
}

/// Centre of a way, and metres of it to a metre of the device so that it fits; at least 1: nobody wants a
/// small motion of the hand made smaller.
struct Fit {
  Vec3 middle = Vec3::Zero();
  double scale = 1.0;
};
Fit fit_way(const std::vector<Vec3>& way, const DeviceInfo& info) {
  Vec3 low = way.front(), high = way.front();
  for (const Vec3& place : way) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const Vec3 room = kFill * (info.workspace_high - info.workspace_low);
  return {0.5 * (low + high), std::max(1.0, (high - low).cwiseQuotient(room).maxCoeff())};
}

/// What a run was.
struct Result {
  std::vector<TickRecord> records;
  ForceCounters counters;
  WorkspaceMap map;
  std::uint64_t cloth_steps = 0, failed_steps = 0, state_hash = 0;
  std::optional<ForceError> error;
};

/// A run to be done.
struct Plan {
  FeltSetup setup;
  std::int64_t ticks = 0;
  std::vector<std::vector<Vec3>> ways;  ///< of the hands' devices [m] (hands, ticks)
  RecordForm record = RecordForm::kNone;
};

/// Devices, hands and paths of a run.
struct FeltHands {
  std::vector<std::unique_ptr<SimulatedDevice>> devices;
  std::vector<std::unique_ptr<ForcePath>> paths;
  std::vector<SessionHand> views;
};

FeltHands make_hands(const RunOptions& options, const Plan& plan, const ClothHand& cloth) {
  FeltHands hands;
  SimulatedDeviceSpec spec = simulated_spec(options.device);
  spec.info = plan.setup.device;
  for (std::size_t i = 0; i < plan.ways.size(); ++i) {
    hands.devices.push_back(std::make_unique<SimulatedDevice>(spec, find_hand_model(options.hand),
                                                              make_path_motion(plan.ways[i], kTick)));
    hands.paths.push_back(std::make_unique<ForcePath>(make_path_options(plan.setup, cloth, i)));
    hands.views.push_back({hands.devices.back().get(), hands.paths.back().get()});
  }
  return hands;
}

/// @param listener hears of everything; may be null
Result run_plan(const Console& console, const RunOptions& options, const EngineScene& scene, const Plan& plan,
                SessionListener* listener) {
  const std::unique_ptr<ClothHand> cloth = make_cloth(scene, plan.setup);
  const FeltHands hands = make_hands(options, plan, *cloth);
  const double period = plan.setup.cloth_period;
  VirtualSession session(hands.views, *cloth,
                         {period, period, static_cast<std::size_t>(plan.ticks), listener});
  const Progress progress = console.progress();
  for (std::int64_t i = 0; i < plan.ticks; ++i) {
    const double time = std::max(0.0, static_cast<double>(i + 1) * kTick - kRest);
    for (std::size_t hand = 0; hand < hands.paths.size(); ++hand)
      hands.paths[hand]->hold(scene.motion->hand(hand, time).holds);
    session.tick(kTick);
    if (progress && i % 16 == 0)
      progress("hand in " + scene.name, static_cast<double>(i) / static_cast<double>(plan.ticks));
  }
  const ForcePath& first = *hands.paths.front();
  Result result{session.records(),     first.counters(),      first.map(),
                session.cloth_steps(), cloth->failed_steps(), cloth->simulation().read().state_hash,
                std::nullopt};
  if (options.no_reference || hands.paths.size() > 1) return result;
  const std::vector<Vec3> reference = converged_forces(
      {&scene.model, &scene.material, scene.options.implicit, &scene.start, make_grasp(scene, plan.setup, 0)},
      result.records, progress);
  result.error = compare_forces(result.records, reference, result.map);
  return result;
}

void add_row(std::string& text, const TickRecord& record) {
  const auto cell = [&](double value) {
    char number[40];
    std::snprintf(number, sizeof number, "%.9g,", value);
    text += number;
  };
  cell(record.time);
  cell(record.dt);
  for (const Vec3& v : {record.sample.position, record.tool, record.tick.force, record.tick.model_force})
    for (int i = 0; i < 3; ++i) cell(v[i]);
  cell(record.tick.energy);
  text += std::to_string(record.tick.model) + ",";
  cell(record.tick.model_age);
  cell(record.tick.gain);
  text += std::to_string(record.tick.status) + "\n";
}

JsonValue report_of(const RunOptions& options, const Plan& plan, const Result& result) {
  const SessionFigures figures = read_figures(result.records);
  JsonValue json;
  json.set("ticks", plan.ticks).set("overruns", static_cast<std::int64_t>(result.counters.late));
  json.set("force_rms_N", figures.force_rms).set("force_peak_N", figures.force_peak);
  JsonValue error;
  if (result.error) error.set("rms", 100.0 * result.error->rms).set("peak", 100.0 * result.error->peak);
  json.set("force_error_percent", std::move(error)).set("energy_min_J", figures.energy_min);
  json.set("model_age_ms", JsonValue()
                               .set("p50", 1e3 * figures.model_age[0])
                               .set("p99", 1e3 * figures.model_age[1])
                               .set("max", 1e3 * figures.model_age[2]));
  json.set("force_step_N", figures.largest_step).set("changed_percent", 100.0 * figures.changed_share);
  json.set("scale", result.map.scale).set("force_gain", result.map.force_gain);
  json.set("braked_ticks", static_cast<std::int64_t>(result.counters.braked));
  json.set("untrusted_ticks", static_cast<std::int64_t>(result.counters.untrusted));
  json.set("cloth_steps", static_cast<std::int64_t>(result.cloth_steps));
  json.set("failed_steps", static_cast<std::int64_t>(result.failed_steps));
  json.set("state_hash", hash_text(result.state_hash));
  json.set("device", simulated_spec(options.device).info.model).set("hand", options.hand);
  return json.set("scene", options.setup.scene).set("virtual_time", true);
}

void print_report(const Console& console, const RunOptions& options, const Plan& plan, const Result& result) {
  const SessionFigures figures = read_figures(result.records);
  console.line(options.setup.scene + " felt with " + simulated_spec(options.device).info.model +
               " in hand '" + options.hand + "': " + std::to_string(plan.ticks) + " ticks in virtual time");
  console.line("workspace     " + format_number(result.map.scale) +
               " m of cloth to a metre of the device, force times " + format_number(result.map.force_gain));
  console.line("force         " + format_number(figures.force_rms) + " N rms, " +
               format_number(figures.force_peak) + " N at most, " + format_number(figures.largest_step) +
               " N from tick to tick");
  if (result.error) {
    console.line("force error   " + format_number(100.0 * result.error->rms) + " % rms, " +
                 format_number(100.0 * result.error->peak) + " % at most, against the converged solve");
  }
  console.line("energy        " + format_number(1e3 * figures.energy_min) + " mJ at least, braked in " +
               std::to_string(result.counters.braked) + " ticks");
  console.line("model age     " + format_number(1e3 * figures.model_age[0]) + " ms median, " +
               format_number(1e3 * figures.model_age[2]) + " ms at most");
}

double force_gain_of(const RunOptions& options) {
  double gain = 1.0;
  const char *begin = options.force_gain.data(), *end = begin + options.force_gain.size();
  const std::from_chars_result read = std::from_chars(begin, end, gain);
  if (read.ec == std::errc{} && read.ptr == end && gain >= 0.01 && gain <= 100.0) return gain;
  throw Error(ErrorKind::kUsage, "--force-gain: '" + options.force_gain + "' is no gain", {},
              "take 0.01 to 100");
}

Plan make_plan(const RunOptions& options, const EngineScene& scene) {
  Plan plan;
  const double seconds =
      options.seconds.empty() ? scene.seconds + kRest : time_value(options.seconds, "--seconds", true);
  if (!(seconds > 0.0))
    throw Error(ErrorKind::kUsage, "--seconds must be more than 0", {}, "give a time such as 2s");
  plan.ticks = steps_of(seconds, kTick, "--seconds");
  plan.record = record_form(options.record);
  FeltSetup& setup = plan.setup;
  setup.scene = options.setup;
  setup.force_gain = force_gain_of(options);
  setup.cloth_period = options.cloth_rate >= 1000 ? 0.0 : 1.0 / options.cloth_rate;
  setup.control = !options.no_controller;
  setup.device = simulated_spec(options.device).info;
  setup.device.rate = 1.0 / kTick;
  std::vector<Fit> fits;
  for (std::size_t hand = 0; hand < scene.hands.size(); ++hand) {
    plan.ways.push_back(hand_way(scene, hand, plan.ticks));
    fits.push_back(fit_way(plan.ways.back(), setup.device));
    setup.scale = std::max(setup.scale, fits.back().scale);
  }
  for (std::size_t hand = 0; hand < scene.hands.size(); ++hand) {
    for (Vec3& place : plan.ways[hand]) place = (place - fits[hand].middle) / setup.scale;
    setup.device_centres.push_back(plan.ways[hand].front());
  }
  // The hold is the coupling: felt gain times scale stiffer than it is, and the device must render that.
  setup.hold_stiffness = setup.device.stable_stiffness / (setup.force_gain * setup.scale);
  return plan;
}

int run_run(const Console& console, const RunOptions& options) {
  if (!options.virtual_time) {
    throw Error(ErrorKind::kUsage,
                "haptics run knows virtual time only so far: a force loop in real time needs a "
                "driver and its thread",
                {}, "add --virtual-time");
  }
  simulated_spec(options.device);
  find_hand_model(options.hand);
  if (named_scene(options.setup.scene).kind == SceneKind::kPaper)
    throw Error(ErrorKind::kUsage,
                "'" + options.setup.scene + "' is a scene of the paper, which has no time to be felt in", {},
                "take grasp_and_lift, taut_patch or bending");
  record_form(options.record);
  const auto [fabric, scene] = build_scene(console, options.setup);
  if (scene.hands.empty() || !scene.motion)
    throw Error(ErrorKind::kUsage, "nobody holds the cloth of '" + options.setup.scene + "'", {},
                "take grasp_and_lift, taut_patch or bending");
  const Plan plan = make_plan(options, scene);
  std::unique_ptr<LogRecorder> log;
  if (plan.record == RecordForm::kLog)
    log = std::make_unique<LogRecorder>(options.record, felt_info(plan.setup, fabric), true);
  const Result result = run_plan(console, options, scene, plan, log ? &log->listener() : nullptr);
  if (log) log->finish(result.state_hash);
  if (plan.record == RecordForm::kTable) {
    std::string text = kRecordHead;
    for (const TickRecord& record : result.records) add_row(text, record);
    write_atomically(options.record, text);
  }
  if (plan.record != RecordForm::kNone) console.say("wrote " + options.record);
  print_report(console, options, plan, result);
  JsonValue json = report_of(options, plan, result);
  console.result(json.set("fabric", fabric.id));
  if (result.failed_steps == 0) return 0;
  throw Error(ErrorKind::kCheckFailed,
              "a number went wrong in " + std::to_string(result.failed_steps) + " steps of the cloth", {},
              "take another --spacing or --fabric, and report the command line");
}

void declare_run(const Command& parent) {
  const auto options = std::make_shared<RunOptions>();
  const Command command = parent.command(
      "run",
      "Feel a scene: a device's hand goes the way of the scene's; force, error, energy, age of the model");
  command.option("--device", options->device,
                 "Driver, or driver:model, as `fuai haptics devices --diagnose` lists them");
  command.option("--scene", options->setup.scene, "A scene in which somebody holds the cloth");
  command.option("--fabric", options->setup.fabric, "Bundled name or path of a fabric file");
  std::string hands = "Who holds the simulated device:";
  for (const HandModel& hand : hand_models()) hands.append(" ").append(hand.name);
  command.option("--hand", options->hand, hands);
  command.option("--seconds", options->seconds,
                 "How long; a number of seconds or a time such as 500ms. Default: the scene's own and 0.5 s");
  declare_size(command, options->setup.size, options->setup.spacing);
  command
      .option("--cloth-rate", options->cloth_rate,
              "Steps of the cloth a second; below 1000 a tangent serves in between")
      .range(30, 1000);
  command.option("--force-gain", options->force_gain, "Newtons of the device to a newton of the cloth");
  command.option("--record", options->record,
                 "CSV file with a row a tick; or, in .fuailog, a recording that `fuai replay` runs again");
  command.flag("--no-reference", options->no_reference,
               "Leave out the converged solve, which takes most of the time, and with it the force error");
  command.flag("--no-controller", options->no_controller, "Let the passivity controller only observe");
  command.flag("--virtual-time", options->virtual_time, "Deterministic, as fast as it goes");
  command.examples(
      {"fuai haptics run --virtual-time",
       "fuai haptics run --virtual-time --scene taut_patch --device simulated:touch --fabric wool-tropical",
       "fuai --json haptics run --virtual-time --scene bending --cloth-rate 60 --record felt.csv"});
  command.body([options](const Console& console) { return run_run(console, *options); });
}

}  // namespace

void declare_haptics(const Command& parent) {
  const Command haptics = parent.group("haptics", "Feel cloth: devices, and the force path in virtual time");
  const auto diagnose = std::make_shared<bool>(false);
  const Command devices = haptics.command("devices", "Every driver: available or why not");
  devices.flag("--diagnose", *diagnose, "Everything that was looked at");
  devices.examples({"fuai haptics devices", "fuai haptics devices --diagnose"});
  devices.body([diagnose](const Console& console) { return run_devices(console, *diagnose); });
  declare_run(haptics);
  haptics.examples({"fuai haptics devices --diagnose", "fuai haptics run --virtual-time"});
}

}  // namespace fuai_app
