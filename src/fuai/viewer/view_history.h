// What happened on a stage: states kept now and then, and every event since the oldest of them.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "How it works".
//
//   ticks    first          last kept        newest
//   kept     K    K    K    K
//   events   ..e..ee...e.e.....e..e.e..ee.
//
//   Both are rings of a fixed size: the oldest goes when a new one finds no room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fuai/viewer/view_stage.h"

namespace fuai {

/// The history of one build of cloths. One thread calls all of it.
class ViewHistory {
 public:
  /// Allocates for stages of this size: kKeptSeconds, or fewer where that would take more than
  /// kMostKeptBytes. Thread class: set-up.
  explicit ViewHistory(const ViewStage& stage);

  /// Forgets everything; to be used for another stage of the same size. Thread class: real-time.
  void clear() noexcept;
  bool empty() const noexcept { return kept_count_ == 0; }
  /// Oldest state; 0 when it is empty. Thread class: real-time.
  std::int64_t first_tick() const noexcept { return empty() ? 0 : kept(0).tick; }
  std::int64_t last_kept_tick() const noexcept { return empty() ? -1 : kept(kept_count_ - 1).tick; }

  /// Keeps the stage as it is before the events of a tick. Thread class: real-time.
  void keep(const ViewStage& stage, std::int64_t tick);
  /// Thread class: real-time.
  void add(const ViewEvent& event) noexcept;
  /// Forgets all events and states after a tick. @return whether there was any event. Thread class:
  /// real-time.
  bool forget_after(std::int64_t tick) noexcept;
  /// The newest state at or before a tick, or the oldest. Not when it is empty. Thread class: real-time.
  const KeptStage& kept_before(std::int64_t tick) const noexcept;
  /// Calls use(event) for the events of a tick in order. Thread class: real-time.
  template <class Use>
  void each_event(std::int64_t tick, const Use& use) const noexcept;

 private:
  const KeptStage& kept(std::size_t i) const noexcept { return kept_[(kept_first_ + i) % kept_.size()]; }
  const ViewEvent& event(std::size_t i) const noexcept {
    return events_[(event_first_ + i) % events_.size()];
  }
  void drop_first_kept() noexcept;
  std::size_t first_event_at(std::int64_t tick) const noexcept;

  std::vector<KeptStage> kept_;
  std::size_t kept_first_ = 0, kept_count_ = 0;
  std::vector<ViewEvent> events_;
  std::size_t event_first_ = 0, event_count_ = 0;
};

inline constexpr std::size_t kMostKeptBytes = std::size_t{256} << 20;
inline constexpr std::size_t kMostKeptEvents = std::size_t{1} << 15;  ///< a mouse of 1 kHz for half a minute

template <class Use>
void ViewHistory::each_event(std::int64_t tick, const Use& use) const noexcept {
  for (std::size_t i = first_event_at(tick); i < event_count_ && event(i).tick == tick; ++i) use(event(i));
}

}  // namespace fuai
