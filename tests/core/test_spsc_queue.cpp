// The queue between two threads: in order, nothing lost, full is full.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include "fuai/core/spsc_queue_rt.h"
#include "support/allocation_guard.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("in order, full at its capacity, round and round") {
    SpscQueue<int> queue(3);
    CHECK(queue.capacity() == 4);
    CHECK(queue.front() == nullptr);
    int next_in = 0, next_out = 0;
    for (int round = 0; round < 5; ++round) {
      while (queue.push(next_in)) ++next_in;
      CHECK(next_in - next_out == 4);
      REQUIRE(queue.front() != nullptr);
      CHECK(*queue.front() == next_out);
      int value = -1;
      for (int i = 0; i < 3; ++i) {
        CHECK(queue.take(value));
        CHECK(value == next_out++);
      }
    }
    int value = -1;
    CHECK(queue.take(value));
    CHECK(!queue.take(value));
    CHECK(value == next_in - 1);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("two threads: everything arrives whole and in order") {
    using Parcel = std::array<std::uint64_t, 12>;
    constexpr std::uint64_t kParcels = 200'000;
    SpscQueue<Parcel> queue(64);
    std::thread writer([&] {
      for (std::uint64_t i = 1; i <= kParcels; ++i) {
        Parcel parcel;
        parcel.fill(i);
        while (!queue.push(parcel)) std::this_thread::yield();
      }
    });
    std::uint64_t wrong = 0;
    for (std::uint64_t i = 1; i <= kParcels; ++i) {
      Parcel parcel;
      while (!queue.take(parcel)) std::this_thread::yield();
      for (const std::uint64_t number : parcel) wrong += number == i ? 0 : 1;
    }
    writer.join();
    CHECK(wrong == 0);
    CHECK(queue.front() == nullptr);
  }

  TEST_CASE("no allocation") {
    SpscQueue<std::array<double, 8>> queue(16);
    std::array<double, 8> value{};
    const fuai_test::AllocationGuard guard;
    for (int i = 0; i < 100; ++i) {
      queue.push(value);
      queue.take(value);
    }
    CHECK(guard.count() == 0);
  }
}
