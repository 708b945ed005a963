// Records a scene that runs, and runs a recorded one again.
// SPDX-License-Identifier: Apache-2.0
//
//   tick 0   where the hands are before the first step; of a scene without hands one that never holds
//   tick n   where they are after step n, and what they feel
#pragma once

#include <array>
#include <span>

#include "fuai/core/progress.h"
#include "fuai/haptics/session_replay.h"
#include "fuai/scenes/engine_scene.h"
#include "session_files.h"

namespace fuai_app {

/// Tells a listener of every step of a run.
class SceneRecording {
 public:
  /// Tells of tick 0.
  SceneRecording(const fuai::SceneRun& run, fuai::SessionListener& listener);
  /// After a step of dt.
  void note(const fuai::StepReport& report, double dt);

 private:
  void tell(std::uint32_t status, double dt);
  const fuai::SceneRun& run_;
  fuai::SessionListener& listener_;
  std::uint64_t ticks_ = 0;
  fuai::ClothState scratch_;
};

/// Runs a scene with the hands of a recording and compares every force and every hash.
/// @throws fuai::Error (kBadInput) when hands and records do not fit.
fuai::ReplayResult replay_scene(fuai::SceneRun& run, std::span<const fuai::TickRecord> ticks,
                                std::span<const fuai::ClothStepRecord> steps, const fuai::Progress& progress);

}  // namespace fuai_app
