// The two sides of the session and what goes between them.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/view_session.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "fuai/core/mailbox_rt.h"
#include "fuai/core/spsc_queue_rt.h"
#include "fuai/viewer/view_history.h"
#include "fuai/viewer/view_orders.h"
#include "fuai/viewer/view_stage.h"

namespace fuai {
namespace {

using namespace view_orders;

constexpr std::size_t kMostOrders = 4096, kMostNotes = std::size_t{1} << 14;
constexpr int kStepsARound = 32;          ///< of a seek: the cloth's thread listens between
constexpr double kEnergyPeriod_us = 1e5;  ///< energies are for reading, and cost as much as a step
constexpr double kSnapshotPeriod_us = 1e6 * kSnapshotPeriod;

double clock_us() noexcept {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

struct ViewSession::Parts {
  Parts(std::unique_ptr<ViewStage> first, Team* shared_team)
      : team(shared_team), stage(std::move(first)), history(std::make_unique<ViewHistory>(*stage)) {
    slots = stage->slot_counts();
  }
  ~Parts() {
    free_all(incoming.load());
    free_all(retired.load());
  }

  // ---- between the threads ----
  SpscQueue<Order> orders{kMostOrders};
  SpscQueue<Note> notes{kMostNotes};
  std::unique_ptr<Mailbox<ViewSnapshot>> box;
  std::atomic<Delivery*> incoming{nullptr}, retired{nullptr};
  std::atomic<int> field{-1};
  std::atomic<std::int64_t> now{0};
  std::atomic<std::uint64_t> lost{0};

  // ---- the screen's ----
  std::uint64_t builds = 0;
  std::vector<std::size_t> slots;  ///< of the cloths that were delivered last

  // ---- the cloth's ----
  Team* team;
  std::unique_ptr<ViewStage> stage;
  std::unique_ptr<ViewHistory> history;
  std::uint64_t build = 0;
  std::int64_t tick = 0, newest = 0;
  std::int64_t begun = -1;   ///< last tick whose beginning was seen to: state kept, hash noted
  std::int64_t target = -1;  ///< of a seek that is under way
  std::int64_t steps = 0;    ///< asked for while paused
  bool playing = false;
  ViewSnapshot draft;
  bool dirty = false, must_show = false;  ///< something changed without a tick; at once
  std::int64_t shown_tick = 0;
  int shown_field = -1;
  double shown_at = -std::numeric_limits<double>::infinity(), energies_at = shown_at;
  double busy_us = 0.0;
  int busy_ticks = 0;
  std::uint64_t disturbances = 0;

  void note(const ViewEvent& event, bool is_rewind = false) noexcept;
  void forget_newer() noexcept;
  void begin_tick();
  void done(const ViewEvent& event) noexcept;
  void step() noexcept;
  void adopt();
  void obey();
  void take(const Order& order);
  void command(const ViewCommand& command);
  void start_seek(std::int64_t to);
  void go_on_seeking();
  void redo_events() noexcept;
  bool advance(const DevicePose* device);
  void show(double wall_us);
  void fill_draft(bool energies);
};

void ViewSession::Parts::note(const ViewEvent& event, bool is_rewind) noexcept {
  if (!notes.push({is_rewind, event})) lost.fetch_add(1, std::memory_order_relaxed);
}

/// What came after this tick has not happened.
void ViewSession::Parts::forget_newer() noexcept {
  if (tick == newest) return;
  newest = tick;
  begun = std::min(begun, tick);
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
  must_show = true;
  // Handed back; only this thread puts anything there but null.
  delivery->next = retired.exchange(nullptr, std::memory_order_acq_rel);
  retired.store(delivery, std::memory_order_release);
}

void ViewSession::Parts::obey() {
  while (const Order* order = orders.front()) {
    // While it seeks, only another aim of the seek is taken: the rest waits until it is there.
    if (target >= 0 && order->kind != Order::Kind::kSeek) return;
    const Order taken = *order;
    orders.pop();
    take(taken);
  }
}

void ViewSession::Parts::take(const Order& order) {
  switch (order.kind) {
    case Order::Kind::kCommand:
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
  if (device != nullptr)
    if (const std::optional<ViewCommand> wish = stage->command_of(*device)) command(*wish);
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

bool ViewSession::send(const ViewCommand& command) noexcept {
  return parts_->orders.push({Order::Kind::kCommand, command, 0});
}

void ViewSession::play(bool plays) noexcept { parts_->orders.push({Order::Kind::kPlay, {}, plays ? 1 : 0}); }

void ViewSession::single_steps(int ticks) noexcept {
  parts_->orders.push({Order::Kind::kSteps, {}, std::max(ticks, 0)});
}

void ViewSession::seek(std::int64_t tick) noexcept {
  parts_->orders.push({Order::Kind::kSeek, {}, std::max<std::int64_t>(tick, 0)});
}

void ViewSession::show_field(int field) noexcept {
  parts_->field.store(field >= 0 && field < kClothFieldCount ? field : -1, std::memory_order_relaxed);
}

std::uint64_t ViewSession::replace(std::shared_ptr<ViewCloths> cloths, bool keep_shape) {
  Parts& p = *parts_;
  auto delivery = std::make_unique<Delivery>();
  delivery->stage = std::make_unique<ViewStage>(std::move(cloths));
  delivery->build = ++p.builds;
  delivery->keep_shape = keep_shape;
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

bool ViewSession::tick(double wall_us, const DevicePose* device) {
  Parts& p = *parts_;
  p.adopt();
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
  return {parts_->stage->device_reading(), parts_->disturbances};
}

double ViewSession::stored_energy() const { return parts_->stage->stored_energy(); }

std::uint64_t ViewSession::state_hash() const { return parts_->stage->hash(); }

}  // namespace fuai
