// Takes records from real-time threads and hands them to a writer on a thread of its own.
// SPDX-License-Identifier: Apache-2.0
//
//   force loop --ring of ticks--> .                        sink.take(ticks, steps), every kRecorderPause or
//                                 | writer's thread ----->  more often while there is much;
//   cloth -----ring of steps----> '                        sink.flush() every kRecorderFlush
//
//   The rings hold what comes in some seconds; a record that finds its ring full is lost and counted, and
//   nobody waits. Who is not in real time sets `patient`: then the caller waits for room instead.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <span>
#include <thread>
#include <vector>

#include "fuai/core/spsc_queue_rt.h"
#include "fuai/haptics/session_record.h"

namespace fuai {

inline constexpr double kRecorderPause = 0.02;  ///< between two looks at empty rings [s]
/// A block is on its way to the disk after this time even when it is not full [s]: with the pause and one
/// write well below the second that a killed process may lose.
inline constexpr double kRecorderFlush = 0.25;

/// Where records go. Called by one thread; may throw Error, which finish() passes on.
class RecordSink {
 public:
  RecordSink() = default;
  RecordSink(const RecordSink&) = delete;
  RecordSink& operator=(const RecordSink&) = delete;
  virtual ~RecordSink() = default;
  virtual void take(std::span<const TickRecord> ticks, std::span<const ClothStepRecord> steps) = 0;
  /// What was taken must outlive the process from now on.
  virtual void flush() = 0;
};

/// The rings and the thread.
class Recorder final : public SessionListener {
 public:
  /// @param sink must outlive it @param room ticks (and steps) that the rings hold
  /// @param patient on_tick() and on_step() wait for room. Thread class: set-up.
  Recorder(RecordSink& sink, std::size_t room, bool patient);
  ~Recorder() override;

  void on_tick(const TickRecord& record) noexcept override;
  void on_step(const ClothStepRecord& record) noexcept override;

  /// Writes what is in the rings and ends the thread; nobody may record any more.
  /// @throws what the sink threw. Thread class: set-up.
  void finish();
  /// Records that found no room so far. Thread class: any.
  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  template <class T>
  void put(SpscQueue<T>& ring, const T& record) noexcept;
  void serve() noexcept;
  bool drain();

  RecordSink& sink_;
  bool patient_;
  SpscQueue<TickRecord> ticks_;
  SpscQueue<ClothStepRecord> steps_;
  std::vector<TickRecord> some_ticks_;
  std::vector<ClothStepRecord> some_steps_;
  std::atomic<std::uint64_t> lost_{0};
  std::atomic<bool> ending_{false}, broken_{false};
  std::exception_ptr failure_;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace fuai
