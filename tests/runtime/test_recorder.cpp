// The recorder: what is told arrives in order on the writer's thread; nobody is kept waiting in real time.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/recorder.h"

#include <doctest/doctest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "fuai/core/error.h"
#include "support/allocation_guard.h"

using namespace fuai;

namespace {

/// Keeps the numbers; may hold the writer up, and may fail.
class Keeper final : public RecordSink {
 public:
  void take(std::span<const TickRecord> some_ticks, std::span<const ClothStepRecord> some_steps) override {
    while (held_up.load()) std::this_thread::yield();
    if (fails) throw Error(ErrorKind::kBadInput, "the disk is full");
    for (const TickRecord& tick : some_ticks) ticks.push_back(tick.number);
    for (const ClothStepRecord& step : some_steps) steps.push_back(step.number);
  }
  void flush() override { flushed = ticks.size(); }

  std::atomic<bool> held_up{false};
  bool fails = false;
  std::vector<std::uint64_t> ticks, steps;
  std::size_t flushed = 0;
};

TickRecord tick_of(std::uint64_t number) {
  TickRecord record;
  record.number = number;
  return record;
}

bool counts_up(const std::vector<std::uint64_t>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] != i) return false;
  return true;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("two threads tell a patient recorder: everything arrives, in order, and is flushed") {
    Keeper keeper;
    Recorder recorder(keeper, 1024, true);  // fills, and is waited for, some twenty times
    std::thread cloth([&] {
      for (std::uint64_t i = 0; i < 3000; ++i) {
        ClothStepRecord step;
        step.number = i;
        recorder.on_step(step);
      }
    });
    for (std::uint64_t i = 0; i < 20'000; ++i) recorder.on_tick(tick_of(i));
    cloth.join();
    recorder.finish();
    CHECK(keeper.ticks.size() == 20'000);
    CHECK(keeper.steps.size() == 3000);
    CHECK(counts_up(keeper.ticks));
    CHECK(counts_up(keeper.steps));
    CHECK(keeper.flushed == keeper.ticks.size());
    CHECK(recorder.lost() == 0);
  }
  TEST_CASE("what a full disk says comes out at the end, and a patient caller is not left waiting") {
    Keeper keeper;
    keeper.fails = true;
    Recorder recorder(keeper, 16, true);
    for (std::uint64_t i = 0; i < 1000; ++i) recorder.on_tick(tick_of(i));
    CHECK_THROWS_AS(recorder.finish(), Error);
    CHECK(recorder.lost() > 0);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("while the writer is held up nobody waits or allocates: what finds no room is lost and counted") {
    Keeper keeper;
    keeper.held_up = true;
    Recorder recorder(keeper, 64, false);
    const fuai_test::AllocationGuard guard;
    for (std::uint64_t i = 0; i < 10'000; ++i) recorder.on_tick(tick_of(i));
    CHECK(guard.count() == 0);
    const std::uint64_t lost = recorder.lost();
    // 64 in the ring, and one handful of the writer (512, recorder.cpp) before it was held up.
    CHECK(lost >= 10'000 - 64 - 512);
    keeper.held_up = false;
    recorder.finish();
    CHECK(keeper.ticks.size() == 10'000 - lost);
  }
}
