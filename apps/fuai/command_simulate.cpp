// `fuai simulate`: a scene of the engine in time, its figures, and a record of every tick.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/io/text_file.h"
#include "fuai/runtime/spin_team.h"
#include "fuai/solver/explicit.h"
#include "scene_options.h"
#include "scene_recording.h"
#include "session_files.h"

namespace fuai_app {

using namespace fuai;

namespace {

struct SimulateOptions {
  SceneSetup setup;
  std::string dt = "1ms";  ///< with unit
  std::string seconds;     ///< a number of seconds, or a time with unit; empty: the scene's own
  std::string record;      ///< CSV or recording; empty: none
};

constexpr double kLeastStep = 1e-6, kMostStep = 1.0;  // [s]
constexpr const char* kRecordHead =
    "time_s,hand_x_m,hand_y_m,hand_z_m,force_x_N,force_y_N,force_z_N,moment_x_Nm,moment_y_Nm,moment_z_Nm,"
    "status,residual_N\n";

struct StatusWord {
  std::uint32_t bit;
  const char* word;
  const char* key;
};
constexpr std::array kStatusWords{
    StatusWord{StepReport::kNotFinite, "not finite", "not_finite"},
    StatusWord{StepReport::kStartedBack, "started back", "started_back"},
    StatusWord{StepReport::kShortened, "shortened", "shortened"},
};

/// "fine", or the words of all bits joined by "+".
std::string status_words(std::uint32_t status) {
  std::string words;
  for (const StatusWord& s : kStatusWords)
    if ((status & s.bit) != 0) words += (words.empty() ? "" : "+") + std::string(s.word);
  return words.empty() ? "fine" : words;
}

/// What a run is to be.
struct Plan {
  double dt = 0.0;
  std::int64_t steps = 0;
  RecordForm record = RecordForm::kNone;
  int threads = 1;
  const SolverEntry* solver = nullptr;
  int inner_steps = 0;  ///< asked for; 0: the solver's own
};

bool is_implicit(const SolverEntry& solver) {
  return solver.kind == SolverKind::kImplicit || solver.kind == SolverKind::kDouble;
}

/// Slots from which a second thread pays: below, handing over costs as much as it brings (bench_engine).
constexpr int kSlotsForTwo = 5000;

/// Threads of the solver: what was asked for, else two where they pay and the machine has them.
int threads_for(int asked, const EngineScene& scene, const SolverEntry& solver) {
  if (!is_implicit(solver)) return 1;
  if (asked > 0) return std::min(asked, 64);
  return scene.model.slot_count() >= kSlotsForTwo && std::thread::hardware_concurrency() > 1 ? 2 : 1;
}

/// What a run was.
struct Run {
  SimulationReading reading;
  GraspReading hand;           ///< the first, after the last step
  double most_force = 0.0;     ///< of the first hand [N]
  std::int64_t saturated = 0;  ///< ticks in which a hand slipped
  std::uint32_t status = 0;    ///< all bits of all ticks
  std::array<std::int64_t, kStatusWords.size()> status_ticks{};
  double residual = 0.0;       ///< after the last step [N]
  std::vector<float> step_us;  ///< sorted
  std::string record;
  std::string target;   ///< empty: no vector kernels
  int inner_steps = 1;  ///< of the last tick
};

void note(Run& run, const StepReport& report) {
  run.status |= report.status;
  run.residual = report.residual;
  for (std::size_t i = 0; i < kStatusWords.size(); ++i)
    run.status_ticks[i] += (report.status & kStatusWords[i].bit) != 0 ? 1 : 0;
}

/// One line of the record; cells of a hand that does not hold stay empty.
void add_row(std::string& record, double time, const Vec3& hand, const GraspReading& reading,
             const StepReport& report) {
  char text[400];
  if (reading.holds) {
    std::snprintf(text, sizeof text, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,", time, hand.x(),
                  hand.y(), hand.z(), reading.force.x(), reading.force.y(), reading.force.z(),
                  reading.moment.x(), reading.moment.y(), reading.moment.z());
  } else {
    std::snprintf(text, sizeof text, "%.9g,,,,,,,,,,", time);
  }
  record += text;
  std::snprintf(text, sizeof text, "%s,%.9g\n", status_words(report.status).c_str(), report.residual);
  record += text;
}

/// @param listener hears of every step; may be null
Run run_plan(const EngineScene& scene, const Plan& plan, SessionListener* listener,
             const Progress& progress) {
  using Clock = std::chrono::steady_clock;
  SceneRun runner(scene, plan.solver->kind, plan.inner_steps);
  SpinTeam team(plan.threads);
  runner.simulation().any_solver().set_team(&team);
  Run run;
  run.step_us.reserve(static_cast<std::size_t>(plan.steps));
  const bool table = plan.record == RecordForm::kTable;
  if (table) run.record = kRecordHead;
  std::optional<SceneRecording> recording;
  if (listener != nullptr) recording.emplace(runner, *listener);
  for (std::int64_t i = 0; i < plan.steps; ++i) {
    const Clock::time_point begin = Clock::now();
    const StepReport report = runner.step(plan.dt);
    run.step_us.push_back(std::chrono::duration<float, std::micro>(Clock::now() - begin).count());
    note(run, report);
    run.hand = runner.hand_reading(0);
    run.most_force = std::max(run.most_force, run.hand.force.norm());
    bool slipped = false;
    for (std::size_t hand = 0; hand < scene.hands.size(); ++hand)
      slipped = slipped || runner.hand_reading(hand).saturated;
    run.saturated += slipped ? 1 : 0;
    if (recording) recording->note(report, plan.dt);
    if (table) add_row(run.record, runner.simulation().time(), runner.hand(0).position, run.hand, report);
    if (progress && i % 16 == 0)
      progress(scene.name, static_cast<double>(i) / static_cast<double>(plan.steps));
  }
  run.reading = runner.simulation().read();
  run.target = runner.simulation().any_solver().target();
  run.inner_steps = runner.simulation().any_solver().inner_steps(plan.dt);
  std::sort(run.step_us.begin(), run.step_us.end());
  return run;
}

/// The value below which that share of the steps lies. @param sorted not empty
double quantile(const std::vector<float>& sorted, double share) {
  const double at = std::ceil(share * static_cast<double>(sorted.size())) - 1.0;
  return static_cast<double>(sorted[static_cast<std::size_t>(std::max(at, 0.0))]);
}

JsonValue energies(const SimulationReading& reading) {
  const ClothEnergy& e = reading.energy;
  return JsonValue()
      .set("stretch", e.stretch)
      .set("shear", e.shear)
      .set("bending", e.bending)
      .set("twist", e.twist)
      .set("weight", e.weight)
      .set("kinetic", reading.kinetic_energy)
      .set("total", reading.total_energy());
}

JsonValue vector_of(const Vec3& v) { return JsonValue().push(v.x()).push(v.y()).push(v.z()); }

JsonValue report_of(const EngineScene& scene, const Plan& plan, const Run& run) {
  JsonValue json;
  json.set("state_hash", hash_text(run.reading.state_hash)).set("max_strain", run.reading.max_strain);
  json.set("energy_J", energies(run.reading));
  json.set("grasp_force_N", run.hand.holds ? vector_of(run.hand.force) : JsonValue());
  json.set("grasp_force_norm_N", run.hand.holds ? JsonValue(run.hand.force.norm()) : JsonValue());
  json.set("grasp_force_peak_N", scene.hands.empty() ? JsonValue() : JsonValue(run.most_force));
  json.set("grasp_moment_Nm", run.hand.holds ? vector_of(run.hand.moment) : JsonValue());
  json.set("step_us", JsonValue()
                          .set("p50", quantile(run.step_us, 0.5))
                          .set("p99", quantile(run.step_us, 0.99))
                          .set("max", static_cast<double>(run.step_us.back())));
  json.set("status", status_words(run.status));
  JsonValue ticks;
  for (std::size_t i = 0; i < kStatusWords.size(); ++i) ticks.set(kStatusWords[i].key, run.status_ticks[i]);
  json.set("status_ticks", ticks.set("saturated", run.saturated));
  const auto live = std::count(scene.model.live.begin(), scene.model.live.end(), 1);
  json.set("residual_N", plan.solver->solves_equation ? JsonValue(run.residual) : JsonValue())
      .set("steps", plan.steps)
      .set("seconds", static_cast<double>(plan.steps) * plan.dt)
      .set("nodes", std::int64_t{live})
      .set("spacing_m", scene.model.spacing)
      .set("target", run.target.empty() ? JsonValue() : JsonValue(run.target))
      .set("solver", std::string(plan.solver->name))
      .set("precision", std::string(plan.solver->precision))
      .set("has_time", plan.solver->has_time)
      .set("inner_steps", run.inner_steps);
  return json;
}

/// How the steps were done.
std::string solver_words(const Plan& plan, const Run& run) {
  if (is_implicit(*plan.solver)) return " on " + run.target;
  const std::string inner = std::to_string(run.inner_steps);
  if (plan.solver->has_time) return ", each of " + inner + " explicit substeps";
  return ", each " + inner + " steps of the paper's descent, which has no time";
}

void print_report(const Console& console, const EngineScene& scene, const Plan& plan, const Run& run) {
  const auto micro = [&](double share) { return format_number(quantile(run.step_us, share)); };
  console.line(scene.name + ": " + std::to_string(plan.steps) + " steps of " + format_number(1e3 * plan.dt) +
               " ms" + solver_words(plan, run) + ", status " + status_words(run.status));
  console.line("step          " + micro(0.5) + " us median, " + micro(0.99) + " us at 99 %, " +
               format_number(static_cast<double>(run.step_us.back())) + " us at most");
  console.line("max strain    " + format_number(100.0 * run.reading.max_strain) + " %");
  console.line("energy        " + format_number(run.reading.total_energy()) + " J, of it kinetic " +
               format_number(run.reading.kinetic_energy) + " J");
  if (run.hand.holds) {
    console.line("grasp force   " + format_number(run.hand.force.norm()) + " N on the hand, at most " +
                 format_number(run.most_force) + " N, slipped in " + std::to_string(run.saturated) +
                 " steps");
  }
  if (plan.solver->solves_equation) console.line("residual      " + format_number(run.residual) + " N");
  console.line("state hash    " + hash_text(run.reading.state_hash));
}

/// Substeps that are not stable are refused before the run.
void check_substeps(const EngineScene& scene, double dt, int substeps) {
  const double bound = stable_substep(scene.model, scene.material);
  if (dt / substeps <= bound) return;
  throw Error(ErrorKind::kUsage,
              "--iterations: " + std::to_string(substeps) + " explicit substeps of " +
                  format_number(1e6 * dt / substeps) + " us are not stable",
              {}, "take at least " + format_number(std::ceil(dt / bound)) + ", or leave it out");
}

Plan make_plan(const SimulateOptions& options, const EngineScene& scene, const SolverEntry& solver) {
  Plan plan;
  plan.solver = &solver;
  plan.dt = time_value(options.dt, "--dt", false);
  if (!(plan.dt >= kLeastStep && plan.dt <= kMostStep)) {
    throw Error(ErrorKind::kUsage, "--dt: '" + options.dt + "' is no step of a scene", {},
                "take 1us to 1s; 1ms is usual");
  }
  const double seconds =
      options.seconds.empty() ? scene.seconds : time_value(options.seconds, "--seconds", true);
  if (!(seconds > 0.0))
    throw Error(ErrorKind::kUsage, "--seconds must be more than 0", {}, "give a time such as 2s");
  plan.steps = steps_of(seconds, plan.dt, "--seconds");
  if (!is_implicit(solver)) plan.inner_steps = options.setup.iterations;
  if (solver.kind == SolverKind::kExplicit && plan.inner_steps > 0)
    check_substeps(scene, plan.dt, plan.inner_steps);
  plan.record = record_form(options.record);
  if (plan.record == RecordForm::kTable && plan.steps > kMostRecorded) {
    throw Error(ErrorKind::kUsage,
                "--record: " + std::to_string(plan.steps) + " steps are more than a million rows", {},
                "take a larger --dt or fewer --seconds");
  }
  return plan;
}

int run_simulate(const Console& console, const SimulateOptions& options) {
  if (named_scene(options.setup.scene).kind == SceneKind::kPaper) {
    throw Error(
        ErrorKind::kUsage,
        "'" + options.setup.scene + "' is a scene of the paper, whose descent has no time to simulate", {},
        "run it with `fuai paper` or `fuai render`, or take corner_drape or bending, which --solver paper "
        "runs by the paper's descent");
  }
  const SolverEntry& solver = named_solver(options.setup.solver, options.setup.precision);
  record_form(options.record);
  const auto [fabric, scene] = build_scene(console, options.setup);
  Plan plan = make_plan(options, scene, solver);
  plan.threads = threads_for(console.options().threads, scene, solver);
  std::unique_ptr<LogRecorder> log;
  if (plan.record == RecordForm::kLog)
    log = std::make_unique<LogRecorder>(options.record, begin_info("simulate", options.setup, fabric), true);
  const Run run = run_plan(scene, plan, log ? &log->listener() : nullptr, console.progress());
  if (log) log->finish(run.reading.state_hash);
  if (plan.record == RecordForm::kTable) write_atomically(options.record, run.record);
  if (plan.record != RecordForm::kNone) console.say("wrote " + options.record);
  print_report(console, scene, plan, run);
  JsonValue json = report_of(scene, plan, run);
  json.set("scene", scene.name).set("fabric", fabric.id).set("threads", plan.threads);
  console.result(json);
  if ((run.status & StepReport::kNotFinite) == 0) return 0;
  throw Error(ErrorKind::kCheckFailed,
              "a number went wrong in " + std::to_string(run.status_ticks.front()) + " steps", {},
              "take a smaller --dt or more --iterations");
}

}  // namespace

void declare_simulate(const Command& parent) {
  const auto options = std::make_shared<SimulateOptions>();
  constexpr int kMostIterations = 1000;
  const Command command = parent.command(
      "simulate", "A scene in time on the cloth engine or another solver: state, force, energy, time a step");
  command.option("SCENE", options->setup.scene, "A name that `fuai scenes` lists, not one of the paper's")
      .required();
  command.option("--fabric", options->setup.fabric, "Bundled name or path of a fabric file");
  declare_size(command, options->setup.size, options->setup.spacing);
  command.option("--dt", options->dt, "Length of a step with unit, 1us to 1s");
  command.option(
      "--seconds", options->seconds,
      "How long, up to 3600; a number of seconds or a time such as 500ms. Default: the scene's own");
  std::string solvers = "Who computes:";
  for (const SolverEntry& entry : solver_entries())
    solvers.append("\n").append(entry.name).append(" - ").append(entry.description);
  command.option("--solver", options->setup.solver, solvers);
  command
      .option("--iterations", options->setup.iterations,
              "Conjugate gradients a linearisation, default 8; substeps of the explicit solver, default as "
              "many as are safe; steps of the paper's in a tick, default 100")
      .range(1, kMostIterations);
  command
      .option("--precision", options->setup.precision,
              "Of the implicit solver: float, as at run time, or double, as --solver double")
      .among({"float", "double"});
  command
      .option("--record", options->record,
              "CSV file with a row a step: time, hand, force, moment, status, residual; or, in .fuailog, a "
              "recording that `fuai replay` runs again")
      .file();
  command.examples({"fuai simulate hanging_sheet",
                    "fuai simulate taut_patch --fabric wool-tropical --seconds 1 --record pull.csv",
                    "fuai --json simulate corner_drape --spacing 5mm --dt 500us --solver double",
                    "fuai simulate corner_drape --solver paper"});
  command.body([options](const Console& console) { return run_simulate(console, *options); });
}

}  // namespace fuai_app
