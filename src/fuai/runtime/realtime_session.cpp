// The two threads of a session.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/realtime_session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>

#include "fuai/core/error.h"
#include "fuai/runtime/real_time.h"

namespace fuai {
namespace {

/// Of SCHED_FIFO: the force loop before the cloth, both below the kernel's own threads at 99.
constexpr int kForcePriority = 80, kClothPriority = 70;
/// Between two looks at whether the session has ended [s].
constexpr double kLook = 0.1;

}  // namespace

std::size_t lateness_bin(double lateness) noexcept {
  double bound = 1e-6;
  for (std::size_t bin = 0; bin + 1 < kLatenessBins; ++bin, bound *= 2.0)
    if (lateness < bound) return bin;
  return kLatenessBins - 1;
}

double lateness_bound(std::size_t bin) noexcept {
  if (bin + 1 >= kLatenessBins) return std::numeric_limits<double>::infinity();
  return 1e-6 * static_cast<double>(std::uint64_t{1} << bin);
}

RealtimeSession::RealtimeSession(std::span<const SessionHand> hands, HapticEnvironment& environment,
                                 const RealtimeOptions& options, HoldRule* holds, SessionListener* listener)
    : environment_(environment), options_(options), holds_(holds), listener_(listener) {
  if (hands.size() != environment.hands() || hands.empty() || hands.size() > kMostSessionHands)
    throw Error(ErrorKind::kUsage, "a session needs a device for each hand that holds the cloth");
  if (!(options.tick >= 1e-4 && options.tick <= 0.01) ||
      !(options.cloth_period >= options.tick && options.cloth_period <= 0.1) ||
      !(options.longest_step >= options.cloth_period) || options.ticks < 0) {
    throw Error(ErrorKind::kUsage,
                "a session in real time ticks at 100 Hz to 10 kHz, its cloth at 10 Hz to that", {},
                "take ticks of 1 ms");
  }
  for (std::size_t i = 0; i < hands.size(); ++i)
    loops_.emplace_back(*hands[i].device, *hands[i].path, static_cast<std::uint32_t>(i));
}

std::uint64_t RealtimeSession::note_lateness(double lateness) noexcept {
  ++report_.lateness[lateness_bin(lateness)];
  report_.worst_lateness = std::max(report_.worst_lateness, lateness);
  const double missed = std::floor(std::max(0.0, lateness) / options_.tick);
  const auto count = static_cast<std::uint64_t>(std::min(missed, 1e15));
  report_.overruns += count;
  overruns_.store(report_.overruns, std::memory_order_relaxed);
  return count;
}

void RealtimeSession::tick(double dt) noexcept {
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    HapticLoop& loop = loops_[i];
    if (holds_ != nullptr) loop.path().hold(holds_->holds(i, loop.path().time() + dt, loop.record().sample));
    sent_.poses[i] = loop.read(dt);
    sent_.tick = loop.record().number;
  }
  poses_.put(sent_);
  for (HapticLoop& loop : loops_) {
    const TickRecord& record = loop.write();
    if (dt > 0.0) loop.device().advance(dt);
    if (listener_ != nullptr) listener_->on_tick(record);
  }
}

void RealtimeSession::run_forces(SessionClock& clock, const std::atomic<bool>& stop) noexcept {
  double last = clock.now(), next = last + options_.tick;
  while (!stop.load(std::memory_order_relaxed) && (options_.ticks == 0 || report_.ticks < options_.ticks)) {
    clock.sleep_until(next);
    const double now = clock.now();
    next += static_cast<double>(1 + note_lateness(now - next)) * options_.tick;
    tick(now - last);
    last = now;
    report_.busy_worst = std::max(report_.busy_worst, clock.now() - now);
    ticks_.store(++report_.ticks, std::memory_order_relaxed);
  }
  for (HapticLoop& loop : loops_) loop.let_go();
}

void RealtimeSession::step(const Poses& poses) noexcept {
  ClothStepRecord record;
  record.tick = poses.tick;
  record.dt = std::min(poses.poses[0].time - cloth_time_, options_.longest_step);
  // A pose of the same moment, from a tick that took no time, is answered with the next.
  if (!(record.dt > 0.0)) return;
  record.number = ++report_.cloth_steps;
  record.next = options_.cloth_period;
  cloth_time_ = poses.poses[0].time;
  environment_.update_all({poses.poses.data(), loops_.size()}, record.dt, record.next,
                          {models_.data(), loops_.size()});
  if (listener_ != nullptr) {
    // Before the models go out, so that no tick is recorded ahead of the step that it felt.
    if (record.number % kCheckpointSteps == 0) record.hash = environment_.state_hash();
    listener_->on_step(record);
  }
  for (std::size_t i = 0; i < loops_.size(); ++i) loops_[i].path().models().put(models_[i]);
}

void RealtimeSession::run_cloth(SessionClock& clock) noexcept {
  double next = clock.now() + options_.cloth_period;
  while (!cloth_ends_.load(std::memory_order_relaxed)) {
    clock.sleep_until(next);
    next += options_.cloth_period;
    const double late = clock.now() - next;
    if (late > 0.0) {
      const double missed = std::ceil(late / options_.cloth_period);
      report_.cloth_overruns += static_cast<std::uint64_t>(std::min(missed, 1e15));
      next += missed * options_.cloth_period;
    }
    if (poses_.fetch()) step(poses_.value());
  }
}

RealtimeReport RealtimeSession::run(SessionClock& force_clock, SessionClock& cloth_clock,
                                    const std::atomic<bool>& stop,
                                    const std::function<void(std::int64_t)>& on_wait) {
  std::unique_ptr<LockedMemory> memory;
  if (options_.claim) memory = std::make_unique<LockedMemory>();
  std::string force_refused, cloth_refused;
  {
    std::jthread cloth([&] {
      if (options_.claim && options_.claim_cloth) cloth_refused = claim_priority(kClothPriority);
      run_cloth(cloth_clock);
    });
    // Whatever ends this block, the cloth's thread is told before it is waited for.
    struct EndCloth {
      explicit EndCloth(std::atomic<bool>& ends) : flag(ends) {}
      EndCloth(const EndCloth&) = delete;
      EndCloth& operator=(const EndCloth&) = delete;
      ~EndCloth() { flag.store(true); }
      std::atomic<bool>& flag;
    } const end_cloth(cloth_ends_);
    std::jthread forces([&] {
      if (options_.claim) force_refused = claim_priority(kForcePriority);
      run_forces(force_clock, stop);
      cloth_ends_.store(true);
      done_.store(true);
    });
    while (on_wait && !done_.load()) {
      std::this_thread::sleep_for(std::chrono::duration<double>(kLook));
      on_wait(ticks_.load(std::memory_order_relaxed));
    }
  }
  if (memory && !memory->why_not().empty()) report_.refused.push_back(memory->why_not());
  for (const std::string* line : {&force_refused, &cloth_refused})
    if (!line->empty() && (report_.refused.empty() || report_.refused.back() != *line))
      report_.refused.push_back(*line);
  return report_;
}

}  // namespace fuai
