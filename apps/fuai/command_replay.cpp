// `fuai replay`: does a recording again and says whether it comes out the same; all ticks as CSV.
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "felt_setup.h"
#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/haptics/session_replay.h"
#include "fuai/io/text_file.h"
#include "fuai/viewer/view_log.h"
#include "scene_options.h"
#include "scene_recording.h"

namespace fuai_app {

using namespace fuai;

namespace {

struct ReplayOptions {
  std::string file;
  std::string csv;  ///< empty: none
};

/// The recording in the terms of a session.
struct Records {
  std::vector<TickRecord> ticks;
  std::vector<ClothStepRecord> steps;
};

Records records_of(const SessionLog& log) {
  Records records;
  records.ticks.reserve(log.ticks.size());
  for (const LogTick& tick : log.ticks) records.ticks.push_back(from_log(tick));
  for (const LogStep& step : log.steps) records.steps.push_back(from_log(step));
  return records;
}

ReplayResult replay_felt(const Console& console, const SessionLog& log, const Records& records) {
  const FeltSetup setup = felt_setup_of(log.info);
  const auto [fabric, scene] = build_scene(console, setup.scene);
  check_fabric(console, log.info, fabric);
  if (scene.hands.size() != setup.device_centres.size())
    throw Error(ErrorKind::kBadInput, "the recording has another number of hands than its scene", {},
                "record the session again");
  const std::unique_ptr<ClothHand> cloth = make_cloth(scene, setup);
  std::vector<std::unique_ptr<ForcePath>> paths;
  std::vector<ForcePath*> views;
  for (std::size_t i = 0; i < scene.hands.size(); ++i) {
    paths.push_back(std::make_unique<ForcePath>(make_path_options(setup, *cloth, i)));
    views.push_back(paths.back().get());
  }
  return replay_session(views, *cloth, records.ticks, records.steps, console.progress());
}

ReplayResult replay_simulated(const Console& console, const SessionLog& log, const Records& records) {
  const SceneSetup setup = scene_setup_of(log.info);
  const auto [fabric, scene] = build_scene(console, setup);
  check_fabric(console, log.info, fabric);
  const SolverEntry& solver = named_solver(setup.solver, setup.precision);
  const bool implicit = solver.kind == SolverKind::kImplicit || solver.kind == SolverKind::kDouble;
  SceneRun run(scene, solver.kind, implicit ? 0 : setup.iterations);
  return replay_scene(run, records.ticks, records.steps, console.progress());
}

/// A recording of the viewer.
int replay_viewed(const Console& console, const ReplayOptions& options) {
  if (!options.csv.empty()) {
    throw Error(ErrorKind::kUsage, "--csv is for recordings of `simulate` and `haptics run`", {},
                "log the forces in the viewer: File menu, or leave it out");
  }
  const std::vector<ViewLogPart> parts = read_view_log(options.file);
  const ViewReplay replay = replay_view_log(parts);
  console.line("viewer, recorded to tick " + std::to_string(replay.ticks) + ", compared " +
               std::to_string(replay.hashes) + " hashes");
  console.line("state hash    " + hash_text(replay.state_hash) +
               (replay.matches() ? ", matches" : ", does not match"));
  JsonValue json;
  json.set("state_hash", hash_text(replay.state_hash)).set("matches", replay.matches());
  json.set("ticks", replay.ticks).set("checkpoints", replay.hashes);
  json.set("first_wrong_tick",
           replay.first_difference < 0 ? JsonValue() : JsonValue(replay.first_difference));
  JsonValue::Array forces;
  for (const ViewReplayForce& force : replay.forces)
    forces.push_back(JsonValue()
                         .set("cloth", static_cast<std::int64_t>(force.cloth) + 1)
                         .set("hand", static_cast<std::int64_t>(force.hand))
                         .set("force_N", force.newtons));
  json.set("forces", std::move(forces));
  console.result(json.set("kind", "view"));
  if (replay.matches()) return 0;
  console.warn("the replay does not match: another program or another processor");
  return kExitCheckFailed;
}

int run_replay(const Console& console, const ReplayOptions& options) {
  if (options.file.ends_with(kViewLogEnding)) return replay_viewed(console, options);
  if (!options.csv.empty()) {
    check_input_survives(options.csv, options.file, "give --csv another name");
    check_can_write(options.csv);
  }
  const SessionLog log = read_session_log(options.file);
  if (!log.damage.empty()) console.warn(options.file + ": " + log.damage + "; what is whole is replayed");
  if (log.ticks.empty()) {
    throw Error(ErrorKind::kBadInput, "there is no whole tick in the recording", {options.file, 0, 0, {}},
                "record the session again");
  }
  if (!options.csv.empty()) {
    write_atomically(options.csv, format_session_csv(log.ticks));
    console.say("wrote " + options.csv);
  }
  const Records records = records_of(log);
  const bool felt = log.info.kind == "haptics";
  if (!felt && log.info.kind != "simulate") {
    throw Error(ErrorKind::kBadInput, "the recording is of '" + log.info.kind + "', which is not known",
                {options.file, 0, 0, {}}, "take the program that recorded it");
  }
  const ReplayResult result =
      felt ? replay_felt(console, log, records) : replay_simulated(console, log, records);
  // The hash of the end stands for the whole run; a torn recording has the checkpoints alone.
  const bool whole = log.end && log.damage.empty() && log.end->lost == 0;
  const bool matches = result.matches() && (!whole || log.end->state_hash == result.state_hash);
  console.line(log.info.word("scene") + " of " + log.info.word("fabric") + ", recorded by " +
               log.info.program + ": " + std::to_string(result.ticks) + " ticks" +
               (whole ? "" : ", cut off before its end"));
  console.line("compared      " + std::to_string(result.ticks) + " forces, " +
               std::to_string(result.checkpoints + (whole ? 1 : 0)) + " hashes");
  console.line("state hash    " + hash_text(result.state_hash) +
               (matches ? ", matches" : ", does not match"));
  JsonValue json;
  json.set("state_hash", hash_text(result.state_hash)).set("matches", matches).set("complete", whole);
  json.set("ticks", static_cast<std::int64_t>(result.ticks))
      .set("cloth_steps", static_cast<std::int64_t>(result.steps))
      .set("checkpoints", static_cast<std::int64_t>(result.checkpoints))
      .set("wrong_ticks", static_cast<std::int64_t>(result.wrong_ticks))
      .set("wrong_checkpoints", static_cast<std::int64_t>(result.wrong_checkpoints))
      .set("first_wrong_tick", result.wrong_ticks > 0
                                   ? JsonValue(static_cast<std::int64_t>(result.first_wrong_tick))
                                   : JsonValue());
  json.set("kind", log.info.kind).set("scene", log.info.word("scene")).set("fabric", log.info.word("fabric"));
  console.result(json.set("program", log.info.program));
  if (matches) return 0;
  console.warn("the replay does not match: another program, another processor or another fabric");
  return kExitCheckFailed;
}

}  // namespace

void declare_replay(const Command& parent) {
  const auto options = std::make_shared<ReplayOptions>();
  const Command command =
      parent.command("replay", "Do a recorded run again, bit for bit, and say whether it comes out the same");
  command
      .option("FILE", options->file,
              "What --record of `simulate` or `haptics run` wrote (.fuailog), or of `view` (.fuai-view)")
      .required();
  command.option("--csv", options->csv, "Also write all ticks as CSV, SI units").file();
  command.examples({"fuai replay pull.fuailog", "fuai --json replay pull.fuailog --csv pull.csv"});
  command.body([options](const Console& console) { return run_replay(console, *options); });
}

}  // namespace fuai_app
