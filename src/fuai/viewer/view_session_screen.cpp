// The screen's side of the session: orders, new cloths, snapshots, events.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "fuai/viewer/view_session_parts.h"

namespace fuai {

using namespace view_orders;

bool ViewSession::send(const ViewCommand& command) noexcept {
  Order order;
  order.command = command;
  order.build = parts_->builds;
  return parts_->orders.push(order);
}

void ViewSession::play(bool plays) noexcept {
  parts_->orders.push({Order::Kind::kPlay, {}, 0, plays ? 1 : 0});
}

void ViewSession::single_steps(int ticks) noexcept {
  parts_->orders.push({Order::Kind::kSteps, {}, 0, std::max(ticks, 0)});
}

void ViewSession::seek(std::int64_t tick) noexcept {
  parts_->orders.push({Order::Kind::kSeek, {}, 0, std::max<std::int64_t>(tick, 0)});
}

void ViewSession::step_back(int ticks) noexcept {
  parts_->orders.push({Order::Kind::kBack, {}, 0, std::max(ticks, 0)});
}

void ViewSession::feel(std::size_t cloth) noexcept { parts_->felt.store(cloth, std::memory_order_relaxed); }

void ViewSession::show_field(int field) noexcept {
  parts_->field.store(field >= 0 && field < kClothFieldCount ? field : -1, std::memory_order_relaxed);
}

std::uint64_t ViewSession::replace(std::shared_ptr<ViewCloths> cloths, bool keep_shape,
                                   std::shared_ptr<const ViewScript> script) {
  Parts& p = *parts_;
  auto delivery = std::make_unique<Delivery>();
  delivery->stage = std::make_unique<ViewStage>(std::move(cloths));
  delivery->build = ++p.builds;
  delivery->keep_shape = keep_shape;
  delivery->script = std::move(script);
  const std::vector<std::size_t> slots = delivery->stage->slot_counts();
  if (slots != p.slots) delivery->history = std::make_unique<ViewHistory>(*delivery->stage);
  p.slots = slots;
  // What was not taken yet is never seen: its memory goes on, and its start where it was to begin anew.
  const std::unique_ptr<Delivery> missed(p.incoming.exchange(nullptr, std::memory_order_acq_rel));
  if (missed) {
    if (!delivery->history) delivery->history = std::move(missed->history);
    delivery->keep_shape = delivery->keep_shape && missed->keep_shape;
  }
  const std::uint64_t build = delivery->build;
  p.incoming.store(delivery.release(), std::memory_order_release);
  free_all(p.retired.exchange(nullptr, std::memory_order_acq_rel));
  return build;
}

std::uint64_t ViewSession::newest_build() const noexcept { return parts_->builds; }

bool ViewSession::fetch() noexcept { return parts_->box->fetch(); }

const ViewSnapshot& ViewSession::snapshot() const noexcept { return parts_->box->value(); }

std::vector<ViewEvent> ViewSession::take_events(std::int64_t& rewound_to) {
  free_all(parts_->retired.exchange(nullptr, std::memory_order_acq_rel));
  rewound_to = -1;
  std::vector<ViewEvent> events;
  Note note;
  while (parts_->notes.take(note)) {
    if (!note.is_rewind) {
      events.push_back(note.event);
      continue;
    }
    const std::int64_t from = note.event.tick;
    rewound_to = rewound_to < 0 ? from : std::min(rewound_to, from);
    while (!events.empty() && events.back().tick >= from) events.pop_back();
  }
  return events;
}

std::uint64_t ViewSession::lost_events() const noexcept {
  return parts_->lost.load(std::memory_order_relaxed);
}

}  // namespace fuai
