// Scenes and records between commands and files.
// SPDX-License-Identifier: Apache-2.0
#include "session_files.h"

#include "command_line.h"
#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"
#include "fuai/laboratory/fabric_report.h"
#include "scene_options.h"

namespace fuai_app {

using namespace fuai;

namespace {

/// Ticks that wait for the writer: four seconds at 1 kHz, far longer than a disk is busy.
constexpr std::size_t kRoom = 4096;

}  // namespace

BuiltScene build_scene(const Console& console, const SceneSetup& setup) {
  const SceneOptions size = scene_options(setup.size, setup.spacing);
  BuiltScene built{load_fabric(setup.fabric), {}};
  for (const std::string& warning : built.fabric.warnings) console.warn(warning);
  built.scene = make_engine_scene(setup.scene, make_fabric_laws(built.fabric), size);
  const SolverKind kind = named_solver(setup.solver, setup.precision).kind;
  if (setup.iterations > 0 && (kind == SolverKind::kImplicit || kind == SolverKind::kDouble))
    built.scene.options.implicit.iterations = setup.iterations;
  return built;
}

SessionLogInfo begin_info(const std::string& kind, const SceneSetup& setup, const Fabric& fabric) {
  SessionLogInfo info{"fuai " + program_version(), kind};
  info.words = {{"scene", setup.scene},     {"fabric", setup.fabric}, {"fabric_hash", fabric_hash(fabric)},
                {"spacing", setup.spacing}, {"solver", setup.solver}, {"precision", setup.precision}};
  info.numbers = {{"size", setup.size}, {"iterations", setup.iterations}};
  return info;
}

SceneSetup scene_setup_of(const SessionLogInfo& info) {
  SceneSetup setup;
  setup.scene = info.word("scene");
  setup.fabric = info.word("fabric");
  setup.spacing = info.word("spacing");
  setup.solver = info.word("solver");
  setup.precision = info.word("precision");
  // Both are whole and small, or somebody wrote the file by hand.
  const auto whole = [&](const char* key) {
    const double value = info.number(key);
    if (!(value >= 0.0 && value <= 1e6)) {
      throw Error(ErrorKind::kBadInput, std::string("the recording's '") + key + "' is out of range", {},
                  "record the session again");
    }
    return static_cast<int>(value);
  };
  setup.size = whole("size");
  setup.iterations = whole("iterations");
  return setup;
}

void check_fabric(const Console& console, const SessionLogInfo& info, const Fabric& fabric) {
  if (info.word("fabric_hash") != fabric_hash(fabric))
    console.warn("the fabric '" + fabric.id + "' is not as it was when the session was recorded");
}

LogTick to_log(const TickRecord& record) {
  LogTick t;
  t.number = record.number;
  t.hand = record.hand;
  t.holds = record.holds ? 1 : 0;
  t.time = record.time;
  t.dt = record.dt;
  t.sample_time = record.sample.time;
  t.position = record.sample.position;
  t.velocity = record.sample.velocity;
  t.orientation = record.sample.orientation;
  t.pinch = record.sample.pinch;
  t.buttons = record.sample.buttons;
  t.device_status = record.sample.status;
  t.tool = record.tool;
  t.force = record.tick.force;
  t.model_force = record.tick.model_force;
  t.speed = record.speed;
  t.energy = record.tick.energy;
  t.model_age = record.tick.model_age;
  t.gain = record.tick.gain;
  t.model = record.tick.model;
  t.arrived = record.arrived;
  t.status = record.tick.status;
  return t;
}

TickRecord from_log(const LogTick& tick) {
  TickRecord r;
  r.number = tick.number;
  r.hand = tick.hand;
  r.holds = tick.holds != 0;
  r.time = tick.time;
  r.dt = tick.dt;
  r.sample = {tick.sample_time, tick.position, tick.velocity,     tick.orientation,
              tick.buttons,     tick.pinch,    tick.device_status};
  r.tool = tick.tool;
  r.speed = tick.speed;
  r.arrived = tick.arrived;
  r.tick = {tick.force, tick.model_force, tick.energy, tick.model_age, tick.gain, tick.model, tick.status};
  return r;
}

LogStep to_log(const ClothStepRecord& r) { return {r.number, r.tick, r.dt, r.next, r.hash}; }
ClothStepRecord from_log(const LogStep& s) { return {s.number, s.tick, s.dt, s.next, s.hash}; }

RecordForm record_form(const std::string& path) {
  if (path.empty()) return RecordForm::kNone;
  const bool table = path.ends_with(".csv");
  if (!table && !path.ends_with(".fuailog")) {
    throw Error(ErrorKind::kUsage, "--record: '" + path + "' is neither a table nor a recording", {},
                "end the name in .csv for a table, or in .fuailog for what `fuai replay` takes");
  }
  check_can_write(path);
  return table ? RecordForm::kTable : RecordForm::kLog;
}

LogRecorder::LogRecorder(const std::string& path, const SessionLogInfo& info, bool patient)
    : writer_(path, info), recorder_(*this, kRoom, patient) {}

void LogRecorder::take(std::span<const TickRecord> ticks, std::span<const ClothStepRecord> steps) {
  for (const ClothStepRecord& step : steps) writer_.append(to_log(step));
  for (const TickRecord& tick : ticks) writer_.append(to_log(tick));
}

std::uint64_t LogRecorder::finish(std::uint64_t state_hash) {
  recorder_.finish();
  writer_.finish({state_hash, 0, 0, recorder_.lost()});
  return recorder_.lost();
}

}  // namespace fuai_app
