// A session in real time: the force loop on one thread, the cloth on another, each by its own clock.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Real time".
//
//   force loop, every tick                              cloth, every period
//   1  sleep to the next tick; dt = what passed         1  sleep to the next period
//   2  poses = read(dt)       --mailbox of poses-->     2  newest poses; the step is the time between them
//   3  forces = write()       <--mailboxes of models--  3  update_all(), put()
//   4  listener.on_tick()                               4  listener.on_step()
//
//   Nobody waits for anybody. A tick that is missed is not made up for: dt grows, and the force path treats
//   it as late beyond its limit. However the session ends, the last thing written to each device is no force.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fuai/core/mailbox_rt.h"
#include "fuai/haptics/virtual_session.h"
#include "fuai/runtime/session_clock.h"

namespace fuai {

/// Whether a hand wants to hold cloth; asked before every tick.
class HoldRule {
 public:
  HoldRule() = default;
  HoldRule(const HoldRule&) = delete;
  HoldRule& operator=(const HoldRule&) = delete;
  virtual ~HoldRule() = default;
  /// @param time of the tick that comes, about [s] @param last what the device read last. Thread class:
  /// real-time.
  virtual bool holds(std::size_t hand, double time, const DeviceSample& last) noexcept = 0;
};

/// How a session runs.
struct RealtimeOptions {
  double tick = 1e-3;          ///< of the force loop [s]
  double cloth_period = 1e-3;  ///< [s]
  /// Longest step of the cloth [s]: what it missed beyond that is not made up for, so that a stall does not
  /// end in one huge step.
  double longest_step = 0.1;
  std::int64_t ticks = 0;   ///< 0: until it is told to stop
  bool claim = true;        ///< ask the system for priority and locked memory
  bool claim_cloth = true;  ///< priority for the cloth too, which may want a whole core of its own
};

/// How late ticks woke: from 0 on in octaves of a microsecond, <1, <2, <4 ... <2^(n-1), and the rest.
inline constexpr std::size_t kLatenessBins = 18;
using LatenessHistogram = std::array<std::uint64_t, kLatenessBins>;
/// The bin of a lateness [s]. Thread class: real-time.
std::size_t lateness_bin(double lateness) noexcept;
/// Upper end of a bin [s]; the last one's is infinite. Thread class: any.
double lateness_bound(std::size_t bin) noexcept;

/// What a session was.
struct RealtimeReport {
  std::int64_t ticks = 0;
  std::uint64_t overruns = 0;  ///< ticks that were missed: the loop woke after the next one was due
  std::uint64_t cloth_steps = 0;
  std::uint64_t cloth_overruns = 0;  ///< periods that the cloth missed
  LatenessHistogram lateness{};
  double worst_lateness = 0.0;       ///< [s]
  double busy_worst = 0.0;           ///< longest that a tick took, from waking to its end [s]
  std::vector<std::string> refused;  ///< what the system would not give, one line each
};

/// The session. What it is given must outlive it; run() is called once.
class RealtimeSession {
 public:
  /// @param hands as many as the environment answers @param holds may be null: they always hold
  /// @param listener may be null; hears ticks on one thread and steps on the other
  /// @throws Error (kUsage) for options out of range. Thread class: set-up.
  RealtimeSession(std::span<const SessionHand> hands, HapticEnvironment& environment,
                  const RealtimeOptions& options, HoldRule* holds = nullptr,
                  SessionListener* listener = nullptr);

  /// Runs until all ticks are done or `stop`. @param force_clock, cloth_clock one each, their threads' own
  /// @param on_wait called on this thread about ten times a second with the ticks done; may be empty
  /// Thread class: set-up.
  RealtimeReport run(SessionClock& force_clock, SessionClock& cloth_clock, const std::atomic<bool>& stop,
                     const std::function<void(std::int64_t)>& on_wait = {});
  /// RealtimeReport::overruns so far. Thread class: any.
  std::uint64_t overruns() const noexcept { return overruns_.load(std::memory_order_relaxed); }

 private:
  struct Poses {
    std::uint64_t tick = 0;
    std::array<ToolPose, kMostSessionHands> poses;
  };
  void run_forces(SessionClock& clock, const std::atomic<bool>& stop) noexcept;
  void run_cloth(SessionClock& clock) noexcept;
  void tick(double dt) noexcept;
  void step(const Poses& poses) noexcept;
  std::uint64_t note_lateness(double lateness) noexcept;

  std::vector<HapticLoop> loops_;
  HapticEnvironment& environment_;
  RealtimeOptions options_;
  HoldRule* holds_;
  SessionListener* listener_;
  Mailbox<Poses> poses_;
  std::atomic<bool> cloth_ends_{false}, done_{false};
  std::atomic<std::int64_t> ticks_{0};
  std::atomic<std::uint64_t> overruns_{0};
  // Of the force loop alone:
  Poses sent_;
  // Of the cloth alone:
  std::array<LocalModel, kMostSessionHands> models_;
  double cloth_time_ = 0.0;
  RealtimeReport report_;  // each thread writes its own fields
};

}  // namespace fuai
