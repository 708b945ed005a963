// The cloth's side of the session.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/view_session.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "fuai/viewer/view_session_parts.h"

namespace fuai {
namespace {

using namespace view_orders;

constexpr int kStepsARound = 32;          ///< of a seek: the cloth's thread listens between
constexpr double kEnergyPeriod_us = 1e5;  ///< energies are for reading, and cost as much as a step
constexpr double kSnapshotPeriod_us = 1e6 * kSnapshotPeriod;

double clock_us() noexcept {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

void ViewSession::Parts::note(const ViewEvent& event, bool is_rewind) noexcept {
  if (!notes.push({is_rewind, event})) lost.fetch_add(1, std::memory_order_relaxed);
}

/// What came after this tick has not happened.
void ViewSession::Parts::forget_newer() noexcept {
  if (tick == newest) return;
  newest = tick;
  begun = std::min(begun, tick);
  scripted = std::min(scripted, tick);
  if (!history->forget_after(tick)) return;
  ViewEvent rewind;
  rewind.tick = tick + 1;
  note(rewind, true);
}

void ViewSession::Parts::done(const ViewEvent& event) noexcept {
  history->add(event);
  note(event);
}

/// Before the first command of a tick, or its step.
void ViewSession::Parts::begin_tick() {
  if (tick <= begun) return;
  begun = tick;
  if (history->empty() || tick - history->last_kept_tick() >= kKeptTicks) history->keep(*stage, tick);
  if (tick % kHashTicks != 0) return;
  ViewEvent event;
  event.kind = ViewEvent::Kind::kHash;
  event.tick = tick;
  event.hash = stage->hash();
  done(event);
}

void ViewSession::Parts::step() noexcept {
  if (stage->is_driven()) ++disturbances;
  const double before = clock_us();
  stage->step(team);
  busy_us += clock_us() - before;
  ++busy_ticks;
  ++tick;
  now.store(tick, std::memory_order_relaxed);
}

void ViewSession::Parts::adopt() {
  Delivery* delivery = incoming.exchange(nullptr, std::memory_order_acq_rel);
  if (delivery == nullptr) return;
  forget_newer();
  ++disturbances;
  target = -1;
  if (delivery->keep_shape) delivery->stage->take_shape_of(*stage);
  stage.swap(delivery->stage);
  if (delivery->history) history.swap(delivery->history);
  history->clear();
  build = delivery->build;
  begun = tick - 1;
  ViewEvent event;
  event.kind = ViewEvent::Kind::kReplaced;
  event.tick = tick;
  event.build = build;
  event.kept_shape = delivery->keep_shape;
  note(event);
  begin_script(delivery->script);
  must_show = true;
  // Handed back; only this thread puts anything there but null.
  delivery->next = retired.exchange(nullptr, std::memory_order_acq_rel);
  retired.store(delivery, std::memory_order_release);
}

void ViewSession::Parts::obey() {
  while (const Order* order = orders.front()) {
    // While it seeks, only another aim of the seek is taken: the rest waits until it is there.
    const bool seeks = order->kind == Order::Kind::kSeek || order->kind == Order::Kind::kBack;
    if (target >= 0 && !seeks) return;
    const Order taken = *order;
    orders.pop();
    take(taken);
  }
}

void ViewSession::Parts::take(const Order& order) {
  switch (order.kind) {
    case Order::Kind::kCommand:
      if (script_view.follows && order.build < build) return;  // meant for the cloths before
      end_script();
      return command(order.command);
    case Order::Kind::kPlay:
      playing = order.number != 0;
      steps = 0;
      dirty = true;
      return;
    case Order::Kind::kSteps:
      steps += order.number;
      return;
    case Order::Kind::kSeek:
      return start_seek(order.number);
    case Order::Kind::kBack:
      return step_back(order.number);
  }
}

void ViewSession::Parts::command(const ViewCommand& command) {
  if (!stage->makes_sense(command)) return;
  forget_newer();
  begin_tick();
  if (command.hand != kDeviceHand) ++disturbances;  // commands of no hand have hand 0
  stage->apply(command);
  ViewEvent event;
  event.tick = tick;
  event.command = command;
  done(event);
  dirty = true;
}

void ViewSession::Parts::start_seek(std::int64_t to) {
  playing = false;
  steps = 0;
  dirty = true;
  if (history->empty()) return;
  ++disturbances;
  target = std::clamp(to, history->first_tick(), newest);
  // From a state before it, so that at least one step is done and forces are known; or from here, where that
  // is on the way.
  const KeptStage& kept = history->kept_before(target - 1);
  if (tick <= target && tick >= kept.tick) return;
  stage->restore(kept);
  tick = kept.tick;
  redo_events();
}

/// Steps that are still to be done are the first that it takes back.
void ViewSession::Parts::step_back(std::int64_t ticks) {
  if (target < 0 && steps >= ticks)
    steps -= ticks;
  else
    start_seek((target >= 0 ? target : tick + steps) - ticks);
}

/// The commands of the tick that the stage has come to again.
void ViewSession::Parts::redo_events() noexcept {
  history->each_event(tick, [this](const ViewEvent& event) {
    if (event.kind == ViewEvent::Kind::kCommand) stage->apply(event.command);
  });
}

void ViewSession::Parts::go_on_seeking() {
  for (int i = 0; i < kStepsARound && tick < target; ++i) {
    step();
    redo_events();
  }
  if (tick < target) return;
  target = -1;
  must_show = true;
  now.store(tick, std::memory_order_relaxed);
}

void ViewSession::Parts::begin_script(std::shared_ptr<const ViewScript>& next) noexcept {
  script.swap(next);  // the old one goes back to the screen's thread, which frees it
  script_start = tick;
  scripted = hashed = tick - 1;
  script_view = {};
  script_view.follows = script != nullptr;
}

void ViewSession::Parts::end_script() noexcept {
  if (script_view.follows) script_view.tick = script_tick();
  script_view.follows = false;
}

/// The events of the script at this tick. @return whether it goes on
bool ViewSession::Parts::follow_script() {
  const std::int64_t at = script_tick();
  if (tick > scripted) {
    scripted = tick;
    auto next = std::ranges::lower_bound(script->events, at, {}, &ViewEvent::tick);
    for (; next != script->events.end() && next->tick == at; ++next) {
      const ViewEvent& event = *next;
      if (event.kind == ViewEvent::Kind::kCommand) command(event.command);
      if (event.kind != ViewEvent::Kind::kHash || tick <= hashed) continue;
      hashed = tick;
      ++script_view.hashes;
      if (stage->hash() != event.hash && script_view.first_difference < 0) script_view.first_difference = at;
    }
  }
  if (at < script->last_tick) return true;
  if (script->more) return false;
  end_script();
  playing = false;
  steps = 0;
  dirty = true;
  return false;
}

void ViewSession::Parts::follow_feeling() noexcept {
  const std::size_t wanted = std::min(felt.load(std::memory_order_relaxed), stage->size() - 1);
  if (std::exchange(felt_now, wanted) != wanted) ++disturbances;
}

/// @return whether a new tick was done
bool ViewSession::Parts::advance(const DevicePose* device) {
  if (!playing && steps == 0) return false;
  if (!playing) {
    --steps;
    dirty = true;
    if (tick < newest) {  // once more what was done before
      step();
      redo_events();
      return false;
    }
  }
  forget_newer();
  if (script_view.follows && !follow_script()) return false;
  if (device != nullptr && !script_view.follows)
    if (const std::optional<ViewCommand> wish = stage->command_of(*device, felt_now)) command(*wish);
  begin_tick();
  step();
  newest = tick;
  return true;
}

void ViewSession::Parts::fill_draft(bool energies) {
  draft.tick = tick;
  draft.build = build;
  draft.first_tick = history->empty() ? tick : history->first_tick();
  draft.newest_tick = newest;
  draft.playing = playing;
  draft.script = script_view;
  if (script_view.follows) draft.script.tick = script_tick();
  if (busy_ticks > 0) draft.step_us = busy_us / busy_ticks;
  busy_us = 0.0;
  busy_ticks = 0;
  shown_field = field.load(std::memory_order_relaxed);
  stage->show(shown_field, energies, draft);
  shown_tick = tick;
  dirty = must_show = false;
}

void ViewSession::Parts::show(double wall_us) {
  dirty = dirty || field.load(std::memory_order_relaxed) != shown_field;
  const bool moved = static_cast<double>(tick - shown_tick) * kViewStep >= kSnapshotPeriod ||
                     (!playing && target < 0 && tick != shown_tick);
  const bool due = (dirty || moved) && wall_us - shown_at >= kSnapshotPeriod_us && target < 0;
  if (!due && !must_show) return;
  const bool energies = must_show || !playing || wall_us - energies_at >= kEnergyPeriod_us;
  if (energies) energies_at = wall_us;
  fill_draft(energies);
  box->put(draft);
  shown_at = wall_us;
}

ViewSession::ViewSession(std::shared_ptr<ViewCloths> cloths, Team* team)
    : parts_(std::make_unique<Parts>(std::make_unique<ViewStage>(std::move(cloths)), team)) {
  Parts& p = *parts_;
  p.begin_tick();
  // All copies in the mailbox get room for everything that a snapshot may hold, so that none is made later.
  p.field.store(static_cast<int>(ClothField::kSpeed));
  p.fill_draft(true);
  p.box = std::make_unique<Mailbox<ViewSnapshot>>(p.draft);
  p.field.store(-1);
  p.fill_draft(true);
  for (int copy = 0; copy < 3; ++copy) {
    p.box->put(p.draft);
    p.box->fetch();
  }
}

ViewSession::~ViewSession() = default;

bool ViewSession::tick(double wall_us, const DevicePose* device) {
  Parts& p = *parts_;
  p.adopt();
  p.follow_feeling();
  p.obey();
  bool did = false;
  if (p.target >= 0) {
    p.go_on_seeking();
  } else {
    did = p.advance(device);
  }
  p.show(wall_us);
  return did;
}

std::int64_t ViewSession::ticks() const noexcept { return parts_->now.load(std::memory_order_relaxed); }

DeviceTouch ViewSession::device_touch() const noexcept {
  return {parts_->stage->device_reading(parts_->felt_now), parts_->disturbances};
}

double ViewSession::stored_energy() const { return parts_->stage->stored_energy(parts_->felt_now); }

std::uint64_t ViewSession::state_hash() const { return parts_->stage->hash(); }

}  // namespace fuai
