// Between a scene in time and its records.
// SPDX-License-Identifier: Apache-2.0
#include "scene_recording.h"

#include <algorithm>
#include <cmath>

#include "fuai/core/error.h"

namespace fuai_app {

using namespace fuai;

namespace {

/// Hands of a record's tick: a scene without hands has one that never holds.
std::size_t hands_of(const EngineScene& scene) { return std::max<std::size_t>(1, scene.hands.size()); }

HandMoment moment_of(const TickRecord& record) {
  return {record.holds, record.sample.position, record.sample.orientation};
}

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorKind::kBadInput, what, {}, "record the run again");
}

}  // namespace

SceneRecording::SceneRecording(const SceneRun& run, SessionListener& listener)
    : run_(run), listener_(listener) {
  tell(0, 0.0);
}

void SceneRecording::tell(std::uint32_t status, double dt) {
  for (std::size_t i = 0; i < hands_of(run_.scene()); ++i) {
    const HandMoment hand = run_.hand(i);
    const GraspReading reading = run_.hand_reading(i);
    TickRecord record;
    record.number = ticks_;
    record.hand = static_cast<std::uint32_t>(i);
    record.time = record.sample.time = run_.simulation().time();
    record.dt = dt;
    record.sample.position = record.tool = hand.position;
    record.sample.orientation = hand.rotation;
    record.holds = hand.holds;
    record.tick.force = record.tick.model_force = reading.force;
    record.tick.model = ticks_;
    record.tick.gain = 1.0;
    record.tick.status = status;
    listener_.on_tick(record);
  }
  ++ticks_;
}

void SceneRecording::note(const StepReport& report, double dt) {
  ClothStepRecord step{ticks_, ticks_, dt, dt, 0};
  if (step.number % kCheckpointSteps == 0) {
    run_.simulation().snapshot(scratch_);
    step.hash = state_hash(scratch_);
  }
  listener_.on_step(step);
  tell(report.status, dt);
}

ReplayResult replay_scene(SceneRun& run, std::span<const TickRecord> ticks,
                          std::span<const ClothStepRecord> steps, const Progress& progress) {
  const std::size_t records = hands_of(run.scene()), hands = run.scene().hands.size();
  std::array<HandMoment, kMostHands> now, then;
  ReplayResult result;
  ClothState scratch;
  const std::size_t whole = ticks.size() / records;
  for (std::size_t n = 0; n < whole; ++n, now = then) {
    const std::span<const TickRecord> tick = ticks.subspan(n * records, records);
    for (std::size_t i = 0; i < records; ++i) {
      if (tick[i].hand != i || tick[i].number != n) refuse("the recording's ticks and hands do not fit");
      if (i < hands) then[i] = moment_of(tick[i]);
    }
    if (n == 0) continue;
    const double dt = tick[0].dt;
    if (!(dt > 0.0 && dt <= 1.0)) refuse("tick " + std::to_string(n) + " of the recording takes no time");
    run.step({now.data(), hands}, {then.data(), hands}, dt);
    bool same = true;
    for (std::size_t i = 0; i < hands; ++i)
      same = same_bits(run.hand_reading(i).force, tick[i].tick.force) && same;
    if (!same && result.wrong_ticks++ == 0) result.first_wrong_tick = n;
    ++result.ticks;
    ++result.steps;
    if (n <= steps.size() && steps[n - 1].hash != 0) {
      run.simulation().snapshot(scratch);
      ++result.checkpoints;
      result.wrong_checkpoints += state_hash(scratch) != steps[n - 1].hash ? 1 : 0;
    }
    if (progress && n % 16 == 0) progress("replay", static_cast<double>(n) / static_cast<double>(whole));
  }
  result.state_hash = run.simulation().read().state_hash;
  return result;
}

}  // namespace fuai_app
