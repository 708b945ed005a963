// The recorder's thread.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/recorder.h"

#include <chrono>

namespace fuai {
namespace {

/// Records that are handed over at once.
constexpr std::size_t kSome = 512;

template <class T>
void pop_some(SpscQueue<T>& ring, std::vector<T>& some) {
  some.clear();
  T record;
  while (some.size() < kSome && ring.take(record)) some.push_back(record);
}

}  // namespace

Recorder::Recorder(RecordSink& sink, std::size_t room, bool patient)
    : sink_(sink), patient_(patient), ticks_(room), steps_(room), thread_([this] { serve(); }) {}

Recorder::~Recorder() {
  ending_.store(true);
  if (thread_.joinable()) thread_.join();
}

template <class T>
void Recorder::put(SpscQueue<T>& ring, const T& record) noexcept {
  while (!ring.push(record)) {
    if (!patient_ || broken_.load(std::memory_order_relaxed)) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    // The writer looks seldom; to spin until then would take the core that it needs.
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void Recorder::on_tick(const TickRecord& record) noexcept { put(ticks_, record); }
void Recorder::on_step(const ClothStepRecord& record) noexcept { put(steps_, record); }

// Ticks are popped before steps: a tick's steps are then among these steps or were written before, so that
// what the disk has last is felt steps, not steps that nobody felt.
bool Recorder::drain() {
  pop_some(ticks_, some_ticks_);
  pop_some(steps_, some_steps_);
  if (some_ticks_.empty() && some_steps_.empty()) return false;
  sink_.take(some_ticks_, some_steps_);
  return true;
}

void Recorder::serve() noexcept {
  using Clock = std::chrono::steady_clock;
  try {
    some_ticks_.reserve(kSome);
    some_steps_.reserve(kSome);
    Clock::time_point flushed = Clock::now();
    while (true) {
      const bool ending = ending_.load();  // before the rings are looked at: what came until then is written
      const bool busy = drain();
      if (std::chrono::duration<double>(Clock::now() - flushed).count() >= kRecorderFlush) {
        sink_.flush();
        flushed = Clock::now();
      }
      if (busy) continue;
      if (ending) break;
      std::this_thread::sleep_for(std::chrono::duration<double>(kRecorderPause));
    }
    sink_.flush();
  } catch (...) {
    failure_ = std::current_exception();
    broken_.store(true);
  }
}

void Recorder::finish() {
  ending_.store(true);
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace fuai
