// Replays a session.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/session_replay.h"

#include <array>
#include <string>
#include <vector>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Models that may be on their way at once: a cloth is seldom two steps ahead of a tick; far more are kept.
constexpr std::size_t kKept = 64;

constexpr const char* kCure = "record the session again";

bool same_bits(const ForceTick& a, const ForceTick& b) noexcept {
  return fuai::same_bits(a.force, b.force) && fuai::same_bits(a.model_force, b.model_force) &&
         fuai::same_bits(a.energy, b.energy) && fuai::same_bits(a.gain, b.gain) && a.model == b.model &&
         a.status == b.status;
}

/// A replay on its way.
class Replay {
 public:
  Replay(std::span<ForcePath* const> paths, HapticEnvironment& environment,
         std::span<const ClothStepRecord> steps)
      : paths_(paths), environment_(environment), steps_(steps), kept_(kKept) {}

  /// One tick. @param records one a hand
  void tick(std::span<const TickRecord> records) {
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      const TickRecord& record = records[i];
      if (record.hand != i || record.number != records[0].number)
        throw Error(ErrorKind::kBadInput, "the recording's ticks and hands do not fit", {}, kCure);
      paths_[i]->hold(record.holds);
      paths_[i]->open_clutch((record.tick.status & kForceClutched) != 0);
      poses_[i] = paths_[i]->follow(record.sample, record.dt);
    }
    step(records[0].number);
    bool same = true;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      deliver(i, records[i]);
      same = same_bits(paths_[i]->render(), records[i].tick) && same;
    }
    if (!same && result_.wrong_ticks++ == 0) result_.first_wrong_tick = records[0].number;
    ++result_.ticks;
  }
  ReplayResult finish() {
    result_.state_hash = environment_.state_hash();
    return result_;
  }

 private:
  struct Models {
    std::uint64_t number = 0;
    std::array<LocalModel, kMostSessionHands> models;
  };

  void step(std::uint64_t tick) {
    for (; next_ < steps_.size() && steps_[next_].tick <= tick; ++next_) {
      const ClothStepRecord& step = steps_[next_];
      if (step.tick != tick || step.number != next_ + 1)
        throw Error(ErrorKind::kBadInput, "the recording's steps of the cloth have a gap", {}, kCure);
      Models& kept = kept_[step.number % kKept];
      kept.number = step.number;
      environment_.update_all({poses_.data(), paths_.size()}, step.dt, step.next,
                              {kept.models.data(), paths_.size()});
      ++result_.steps;
      if (step.hash == 0) continue;
      ++result_.checkpoints;
      result_.wrong_checkpoints += environment_.state_hash() != step.hash ? 1 : 0;
    }
  }
  void deliver(std::size_t hand, const TickRecord& record) {
    if (record.arrived == paths_[hand]->arrived()) return;
    const Models& kept = kept_[record.arrived % kKept];
    if (kept.number != record.arrived) {
      throw Error(ErrorKind::kBadInput,
                  "tick " + std::to_string(record.number) + " felt step " + std::to_string(record.arrived) +
                      " of the cloth, which the recording does not have",
                  {}, kCure);
    }
    paths_[hand]->models().put(kept.models[hand]);
  }

  std::span<ForcePath* const> paths_;
  HapticEnvironment& environment_;
  std::span<const ClothStepRecord> steps_;
  std::vector<Models> kept_;
  std::array<ToolPose, kMostSessionHands> poses_;
  std::size_t next_ = 0;
  ReplayResult result_;
};

}  // namespace

ReplayResult replay_session(std::span<ForcePath* const> paths, HapticEnvironment& environment,
                            std::span<const TickRecord> ticks, std::span<const ClothStepRecord> steps,
                            const Progress& progress) {
  if (paths.empty() || paths.size() > kMostSessionHands || paths.size() != environment.hands())
    throw Error(ErrorKind::kUsage, "a replay needs a force path for each hand that holds the cloth");
  Replay replay(paths, environment, steps);
  const std::size_t whole = ticks.size() / paths.size();
  for (std::size_t i = 0; i < whole; ++i) {
    replay.tick(ticks.subspan(i * paths.size(), paths.size()));
    if (progress && i % 64 == 0) progress("replay", static_cast<double>(i) / static_cast<double>(whole));
  }
  return replay.finish();
}

}  // namespace fuai
