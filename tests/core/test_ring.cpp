// The ring: every value arrives once and in its order, and a full ring takes nothing.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <thread>

#include "fuai/core/ring_rt.h"
#include "support/allocation_guard.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("values come out in their order, round and round, and a full ring refuses") {
    Ring<int> ring(5);
    CHECK(ring.room() == 8);
    int next_in = 0, next_out = 0, value = -1;
    CHECK(!ring.pop(value));
    for (int round = 0; round < 10; ++round) {
      for (int i = 0; i < 8; ++i) REQUIRE(ring.push(next_in++));
      CHECK(!ring.push(99));
      for (int i = 0; i < 5; ++i) {
        REQUIRE(ring.pop(value));
        CHECK(value == next_out++);
      }
      for (int i = 0; i < 5; ++i) REQUIRE(ring.push(next_in++));
      while (ring.pop(value)) CHECK(value == next_out++);
      CHECK(next_out == next_in);
    }
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("two threads: all values arrive whole and in order, and nobody allocates") {
    using Value = std::array<std::uint64_t, 30>;
    constexpr std::uint64_t kValues = 100'000;
    Ring<Value> ring(64);
    std::thread writer([&] {
      Value value{};
      const fuai_test::AllocationGuard guard;
      for (std::uint64_t i = 0; i < kValues; ++i) {
        value.fill(i);
        while (!ring.push(value)) std::this_thread::yield();
      }
      CHECK(guard.count() == 0);
    });
    std::uint64_t wrong = 0;
    Value value{};
    for (std::uint64_t i = 0; i < kValues;) {
      if (!ring.pop(value)) {
        std::this_thread::yield();
        continue;
      }
      for (std::uint64_t n : value) wrong += n != i ? 1 : 0;
      ++i;
    }
    writer.join();
    CHECK(wrong == 0);
    CHECK(!ring.pop(value));
  }
}
