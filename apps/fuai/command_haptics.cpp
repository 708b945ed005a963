// `fuai haptics devices` and `fuai haptics run`.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "felt_run.h"
#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/device/registry.h"
#include "fuai/haptics/force_error.h"
#include "fuai/haptics/hand_rules.h"
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
  std::string hold;  ///< empty: the scene with a simulated hand, else the device's buttons
  bool no_reference = false, no_controller = false, virtual_time = false;
};

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

/// What the clock did; null in virtual time.
JsonValue clock_of(const std::optional<RealtimeReport>& report) {
  if (!report) return {};
  JsonValue bins{JsonValue::Array{}}, refused{JsonValue::Array{}};
  for (std::size_t i = 0; i < kLatenessBins; ++i) {
    const double bound = lateness_bound(i);
    bins.push(JsonValue()
                  .set("below_us", std::isfinite(bound) ? JsonValue(1e6 * bound) : JsonValue())
                  .set("ticks", static_cast<std::int64_t>(report->lateness[i])));
  }
  for (const std::string& line : report->refused) refused.push(line);
  JsonValue json;
  json.set("lateness", std::move(bins)).set("worst_lateness_us", 1e6 * report->worst_lateness);
  json.set("longest_tick_us", 1e6 * report->busy_worst);
  json.set("cloth_overruns", static_cast<std::int64_t>(report->cloth_overruns));
  return json.set("refused", std::move(refused));
}

/// What a device can say of itself that keeps force from the hand.
struct DeviceTrouble {
  std::uint32_t bit;
  const char *key, *words;
};
constexpr std::array kTroubles{
    DeviceTrouble{kDeviceDisconnected, "disconnected", "unplugged or silent"},
    DeviceTrouble{kDeviceUncalibrated, "uncalibrated", "not calibrated"},
    DeviceTrouble{kDeviceForceOff, "force_off", "with its force switched off"},
    DeviceTrouble{kDeviceWarm, "warm", "with motors too warm"},
    DeviceTrouble{kDeviceSaturated, "saturated", "asked for more than it gives"},
};

std::int64_t ticks_with(const FeltResult& result, const DeviceTrouble& trouble) {
  return std::ranges::count_if(
      result.records, [&](const TickRecord& record) { return (record.sample.status & trouble.bit) != 0; });
}

std::int64_t faulted_ticks(const FeltResult& result) {
  return std::ranges::count_if(
      result.records, [](const TickRecord& record) { return (record.tick.status & kForceFaults) != 0; });
}

/// Says what the figures are silent about: force that was not given.
void print_troubles(const Console& console, const FeltResult& result) {
  std::string text;
  for (const DeviceTrouble& trouble : kTroubles) {
    const std::int64_t ticks = ticks_with(result, trouble);
    if (ticks > 0)
      text += (text.empty() ? "" : ", ") + (trouble.words + (" in " + std::to_string(ticks))) + " ticks";
  }
  if (!text.empty()) console.line("device        " + text);
  const std::int64_t faulted = faulted_ticks(result);
  if (faulted > 0) console.line("fault         latched: no force in " + std::to_string(faulted) + " ticks");
}

JsonValue report_of(const FeltPlan& plan, const FeltResult& result) {
  const SessionFigures figures = read_figures(result.records);
  JsonValue json;
  const std::uint64_t overruns = result.realtime ? result.realtime->overruns : result.counters.late;
  json.set("ticks", static_cast<std::int64_t>(result.counters.ticks));
  json.set("overruns", static_cast<std::int64_t>(overruns));
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
  JsonValue device_ticks;
  for (const DeviceTrouble& trouble : kTroubles) device_ticks.set(trouble.key, ticks_with(result, trouble));
  json.set("device_ticks", std::move(device_ticks)).set("faulted_ticks", faulted_ticks(result));
  json.set("cloth_steps", static_cast<std::int64_t>(result.cloth_steps));
  json.set("failed_steps", static_cast<std::int64_t>(result.failed_steps));
  json.set("state_hash", hash_text(result.state_hash)).set("clock", clock_of(result.realtime));
  json.set("device", plan.setup.device.model).set("hand", plan.hand).set("stopped", result.stopped);
  return json.set("scene", plan.setup.scene.scene).set("virtual_time", plan.virtual_time);
}

void print_clock(const Console& console, const RealtimeReport& report) {
  console.line("clock         " + std::to_string(report.overruns) + " ticks missed, woken at most " +
               format_number(1e6 * report.worst_lateness) + " us late, " +
               std::to_string(report.cloth_overruns) + " periods of the cloth missed");
  std::string late;
  for (std::size_t i = 0; i < kLatenessBins; ++i) {
    if (report.lateness[i] == 0) continue;
    const double bound = lateness_bound(i);
    late += "  " + (std::isfinite(bound) ? "<" + format_number(1e6 * bound) : std::string("more")) + ": " +
            std::to_string(report.lateness[i]);
  }
  console.line("late, us    " + late);
  for (const std::string& line : report.refused) console.warn(line);
}

void print_report(const Console& console, const FeltPlan& plan, const FeltResult& result) {
  const SessionFigures figures = read_figures(result.records);
  console.line(plan.setup.scene.scene + " felt with " + plan.setup.device.model +
               (is_simulated(plan.device) ? " in hand '" + plan.hand + "'" : "") + ": " +
               std::to_string(result.counters.ticks) + " ticks in " +
               (plan.virtual_time ? "virtual" : "real") + " time" +
               (result.stopped ? ", stopped before the end" : ""));
  console.line("workspace     " + format_number(result.map.scale) +
               " m of cloth to a metre of the device, force times " + format_number(result.map.force_gain));
  console.line("force         " + format_number(figures.force_rms) + " N rms, " +
               format_number(figures.force_peak) + " N at most, " + format_number(figures.largest_step) +
               " N from tick to tick");
  print_troubles(console, result);
  if (result.error) {
    console.line("force error   " + format_number(100.0 * result.error->rms) + " % rms, " +
                 format_number(100.0 * result.error->peak) + " % at most, against the converged solve");
  }
  console.line("energy        " + format_number(1e3 * figures.energy_min) + " mJ at least, braked in " +
               std::to_string(result.counters.braked) + " ticks");
  console.line("model age     " + format_number(1e3 * figures.model_age[0]) + " ms median, " +
               format_number(1e3 * figures.model_age[2]) + " ms at most");
  if (result.realtime) print_clock(console, *result.realtime);
}

double force_gain_of(const RunOptions& options) {
  double gain = 1.0;
  const char *begin = options.force_gain.data(), *end = begin + options.force_gain.size();
  const std::from_chars_result read = std::from_chars(begin, end, gain);
  if (read.ec == std::errc{} && read.ptr == end && gain >= 0.01 && gain <= 100.0) return gain;
  throw Error(ErrorKind::kUsage, "--force-gain: '" + options.force_gain + "' is no gain", {},
              "take 0.01 to 100");
}

HoldBy hold_of(const RunOptions& options) {
  if (options.hold == "always") return HoldBy::kAlways;
  const bool simulated = is_simulated(options.device);
  if (options.hold == "button" && simulated) {
    throw Error(ErrorKind::kUsage, "--hold: a simulated device has no button", {},
                "take --hold scene or --hold always");
  }
  const bool scene = options.hold.empty() ? simulated : options.hold == "scene";
  return scene ? HoldBy::kScene : HoldBy::kButton;
}

/// What the device says of itself; a real one is opened for that.
DeviceInfo info_of(const RunOptions& options) {
  if (options.virtual_time || is_simulated(options.device)) return simulated_spec(options.device).info;
  return open_device(options.device)->info();
}

FeltPlan make_plan(const RunOptions& options, const EngineScene& scene) {
  FeltPlan plan;
  const double seconds =
      options.seconds.empty() ? scene.seconds + rest_time() : time_value(options.seconds, "--seconds", true);
  if (!(seconds > 0.0))
    throw Error(ErrorKind::kUsage, "--seconds must be more than 0", {}, "give a time such as 2s");
  plan.ticks = steps_of(seconds, kTick, "--seconds");
  plan.device = options.device;
  plan.hand = options.hand;
  plan.hold = hold_of(options);
  plan.virtual_time = options.virtual_time;
  plan.reference = !options.no_reference;
  FeltSetup& setup = plan.setup;
  setup.scene = options.setup;
  setup.force_gain = force_gain_of(options);
  setup.cloth_period = options.cloth_rate >= 1000 ? 0.0 : 1.0 / options.cloth_rate;
  setup.control = !options.no_controller;
  setup.device = info_of(options);
  setup.device.rate = 1.0 / kTick;
  // A hand of flesh takes the cloth where it is; a simulated one goes the scene's way with the scene's patch.
  if (!is_simulated(options.device)) setup.reach = kHandReach;
  fit_plan(plan, scene);
  return plan;
}

int run_run(const Console& console, const RunOptions& options) {
  if (options.virtual_time || is_simulated(options.device)) simulated_spec(options.device);
  find_hand_model(options.hand);
  if (named_scene(options.setup.scene).kind == SceneKind::kPaper)
    throw Error(ErrorKind::kUsage,
                "'" + options.setup.scene + "' is a scene of the paper, which has no time to be felt in", {},
                "take grasp_and_lift, taut_patch or bending");
  const RecordForm form = record_form(options.record);
  const auto [fabric, scene] = build_scene(console, options.setup);
  if (scene.hands.empty() || !scene.motion)
    throw Error(ErrorKind::kUsage, "nobody holds the cloth of '" + options.setup.scene + "'", {},
                "take grasp_and_lift, taut_patch or bending");
  const FeltPlan plan = make_plan(options, scene);
  std::unique_ptr<LogRecorder> log;
  if (form == RecordForm::kLog)
    log = std::make_unique<LogRecorder>(options.record, felt_info(plan.setup, fabric), plan.virtual_time);
  const FeltResult result = run_felt(console, scene, plan, log ? &log->listener() : nullptr);
  const std::uint64_t lost = log ? log->finish(result.state_hash) : 0;
  if (lost > 0)
    console.warn(std::to_string(lost) + " records found no room: the replay ends before the first");
  if (form == RecordForm::kTable) {
    std::string text = kRecordHead;
    for (const TickRecord& record : result.records)
      if (record.hand == 0) add_row(text, record);
    write_atomically(options.record, text);
  }
  if (form != RecordForm::kNone) console.say("wrote " + options.record);
  print_report(console, plan, result);
  JsonValue json = report_of(plan, result);
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
  command
      .option("--hold", options->hold,
              "Who holds the cloth: the scene by time, always, or a button of the device; default: the scene "
              "with a simulated hand, else a button")
      .among({"scene", "always", "button"});
  command.flag("--virtual-time", options->virtual_time,
               "Deterministic, as fast as it goes; without it in real time, at 1 kHz, until done or Ctrl-C");
  command.examples(
      {"fuai haptics run --no-reference", "fuai haptics run --virtual-time",
       "fuai haptics run --virtual-time --scene taut_patch --device simulated:touch --fabric wool-tropical",
       "fuai --json haptics run --virtual-time --scene bending --cloth-rate 60 --record felt.csv"});
  command.body([options](const Console& console) { return run_run(console, *options); });
}

}  // namespace

void declare_haptics(const Command& parent) {
  const Command haptics =
      parent.group("haptics", "Feel cloth: devices, and the force path in real or virtual time");
  const auto diagnose = std::make_shared<bool>(false);
  const Command devices = haptics.command("devices", "Every driver: available or why not");
  devices.flag("--diagnose", *diagnose, "Everything that was looked at");
  devices.examples({"fuai haptics devices", "fuai haptics devices --diagnose"});
  devices.body([diagnose](const Console& console) { return run_devices(console, *diagnose); });
  declare_run(haptics);
  declare_haptics_paper(haptics);
  haptics.examples({"fuai haptics devices --diagnose", "fuai haptics run --virtual-time"});
}

}  // namespace fuai_app
