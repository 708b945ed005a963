// What the session of the viewer is made of: the screen's side, the cloth's side and what lies between.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "How it works".
#pragma once

#include <atomic>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "fuai/core/mailbox_rt.h"
#include "fuai/core/spsc_queue_rt.h"
#include "fuai/viewer/view_history.h"
#include "fuai/viewer/view_orders.h"
#include "fuai/viewer/view_session.h"
#include "fuai/viewer/view_stage.h"

namespace fuai {

struct ViewSession::Parts {
  Parts(std::unique_ptr<ViewStage> first, Team* shared_team)
      : team(shared_team), stage(std::move(first)), history(std::make_unique<ViewHistory>(*stage)) {
    slots = stage->slot_counts();
  }
  ~Parts() {
    view_orders::free_all(incoming.load());
    view_orders::free_all(retired.load());
  }

  // ---- between the threads ----
  SpscQueue<view_orders::Order> orders{view_orders::kMostOrders};
  SpscQueue<view_orders::Note> notes{view_orders::kMostNotes};
  std::unique_ptr<Mailbox<ViewSnapshot>> box;
  std::atomic<view_orders::Delivery*> incoming{nullptr}, retired{nullptr};
  std::atomic<int> field{-1};
  std::atomic<std::size_t> felt{0};
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
  std::size_t felt_now = 0;
  std::shared_ptr<const ViewScript> script;
  std::int64_t script_start = 0;  ///< tick at which its first tick is
  std::int64_t scripted = -1;     ///< last tick whose events of the script are done
  std::int64_t hashed = -1;       ///< last tick of a hash that was compared
  ScriptView script_view;

  void note(const ViewEvent& event, bool is_rewind = false) noexcept;
  void forget_newer() noexcept;
  void begin_tick();
  void done(const ViewEvent& event) noexcept;
  void step() noexcept;
  void adopt();
  void obey();
  void take(const view_orders::Order& order);
  void command(const ViewCommand& command);
  void start_seek(std::int64_t to);
  void step_back(std::int64_t ticks);
  void go_on_seeking();
  void redo_events() noexcept;
  void begin_script(std::shared_ptr<const ViewScript>& next) noexcept;
  std::int64_t script_tick() const noexcept { return tick - script_start + script->first_tick; }
  void end_script() noexcept;
  bool follow_script();
  void follow_feeling() noexcept;
  bool advance(const DevicePose* device);
  void show(double wall_us);
  void fill_draft(bool energies);
};

}  // namespace fuai
