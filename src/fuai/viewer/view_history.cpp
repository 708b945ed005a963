// Two rings: kept states and events.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/view_history.h"

#include <algorithm>

#include "fuai/core/assertion.h"

namespace fuai {
namespace {

/// What a kept stage takes, holds included [bytes].
std::size_t bytes_of(const ViewStage& stage) {
  constexpr std::size_t kOfSlot = 2 * sizeof(Vec3) + 5 * sizeof(PlayState);
  std::size_t bytes = 0;
  for (const std::size_t slots : stage.slot_counts()) bytes += slots * kOfSlot + sizeof(KeptStage::Cloth);
  return bytes;
}

constexpr auto kWanted = static_cast<std::size_t>(kKeptSeconds * (1.0 / kViewStep)) / kKeptTicks + 1;

}  // namespace

ViewHistory::ViewHistory(const ViewStage& stage) : events_(kMostKeptEvents) {
  kept_.resize(std::clamp(kMostKeptBytes / bytes_of(stage), std::size_t{2}, kWanted));
  for (KeptStage& kept : kept_) {
    stage.keep(kept);
    for (KeptStage::Cloth& cloth : kept.cloths) cloth.state.carried.reserve(64);
  }
}

void ViewHistory::clear() noexcept { kept_first_ = kept_count_ = event_first_ = event_count_ = 0; }

void ViewHistory::drop_first_kept() noexcept {
  kept_first_ = (kept_first_ + 1) % kept_.size();
  --kept_count_;
  // Events before the oldest state are of no use.
  const std::size_t useless = empty() ? event_count_ : first_event_at(first_tick());
  event_first_ = (event_first_ + useless) % events_.size();
  event_count_ -= useless;
}

void ViewHistory::keep(const ViewStage& stage, std::int64_t tick) {
  if (kept_count_ == kept_.size()) drop_first_kept();
  KeptStage& kept = kept_[(kept_first_ + kept_count_) % kept_.size()];
  stage.keep(kept);
  kept.tick = tick;
  ++kept_count_;
}

void ViewHistory::add(const ViewEvent& event) noexcept {
  // So many events that they do not fit go with the states before them; without any state, seek() has nowhere
  // to go until the next one is kept.
  while (event_count_ == events_.size() && !empty()) drop_first_kept();
  if (empty()) return;
  events_[(event_first_ + event_count_) % events_.size()] = event;
  ++event_count_;
}

std::size_t ViewHistory::first_event_at(std::int64_t tick) const noexcept {
  std::size_t low = 0, high = event_count_;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (event(middle).tick < tick) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

bool ViewHistory::forget_after(std::int64_t tick) noexcept {
  while (!empty() && last_kept_tick() > tick) --kept_count_;
  const std::size_t keep = first_event_at(tick + 1);
  const bool any = keep < event_count_;
  event_count_ = keep;
  return any;
}

const KeptStage& ViewHistory::kept_before(std::int64_t tick) const noexcept {
  FUAI_ASSERT(!empty());
  std::size_t i = kept_count_ - 1;
  while (i > 0 && kept(i).tick > tick) --i;
  return kept(i);
}

}  // namespace fuai
