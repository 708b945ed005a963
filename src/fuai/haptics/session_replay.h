// Does a recorded session again: the same samples at the same ticks, the same steps of the cloth, so the same
// bits, whoever's clock drove the recording.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Recording".
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "fuai/core/progress.h"
#include "fuai/haptics/environment.h"
#include "fuai/haptics/session_record.h"

namespace fuai {

/// Equal to the last bit, not-a-numbers included. Thread class: any.
inline bool same_bits(double a, double b) noexcept {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
inline bool same_bits(const Vec3& a, const Vec3& b) noexcept {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}

/// What a replay found.
struct ReplayResult {
  std::uint64_t ticks = 0, steps = 0;  ///< done again
  std::uint64_t checkpoints = 0;       ///< hashes of the state that were compared
  std::uint64_t wrong_ticks = 0;       ///< in which force, energy or status of a hand has other bits
  std::uint64_t wrong_checkpoints = 0;
  std::uint64_t first_wrong_tick = 0;  ///< when there is a wrong one
  std::uint64_t state_hash = 0;        ///< after the last step
  bool matches() const noexcept { return wrong_ticks == 0 && wrong_checkpoints == 0; }
};

/// Replays on paths and an environment as new as they were when the recording began.
/// @param paths one a hand, in the order of the records @param ticks whole ticks in their order, hand by hand
/// @param steps in their order; those whose poses lie beyond the last tick are left out
/// @throws Error (kBadInput) when a tick needs a model that no step made, or hands and records do not fit.
/// Thread class: set-up.
ReplayResult replay_session(std::span<ForcePath* const> paths, HapticEnvironment& environment,
                            std::span<const TickRecord> ticks, std::span<const ClothStepRecord> steps,
                            const Progress& progress = {});

}  // namespace fuai
