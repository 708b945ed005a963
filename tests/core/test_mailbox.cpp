// The mailbox: the newest value wins, and no read is torn.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include "fuai/core/mailbox_rt.h"
#include "support/allocation_guard.h"

using namespace fuai;

namespace {

/// Larger than a cache line, and whole only if all numbers agree.
struct Letter {
  std::array<std::uint64_t, 40> numbers{};
  static Letter of(std::uint64_t number) {
    Letter letter;
    letter.numbers.fill(number);
    return letter;
  }
  bool whole() const {
    for (std::uint64_t n : numbers)
      if (n != numbers.front()) return false;
    return true;
  }
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the newest value wins, and is fetched once") {
    Mailbox<int> box(7);
    CHECK(!box.fetch());
    CHECK(box.value() == 7);
    box.put(1);
    box.put(2);
    box.put(3);
    CHECK(box.value() == 7);
    CHECK(box.fetch());
    CHECK(box.value() == 3);
    CHECK(!box.fetch());
    for (int i = 0; i < 20; ++i) {
      box.put(i);
      CHECK(box.fetch());
      CHECK(box.value() == i);
    }
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("two threads: every letter is whole, in order, and the last one arrives") {
    // Fewer under sanitizers would do as well; what counts is that both threads run at once.
    constexpr std::uint64_t kLetters = 200'000;
    Mailbox<Letter> box;
    std::atomic<bool> ready{false};
    std::thread writer([&] {
      while (!ready.load()) std::this_thread::yield();
      for (std::uint64_t i = 1; i <= kLetters; ++i) box.put(Letter::of(i));
    });
    std::uint64_t last = 0, torn = 0, backward = 0;
    ready.store(true);
    while (last != kLetters) {
      if (!box.fetch()) {
        std::this_thread::yield();
        continue;
      }
      torn += box.value().whole() ? 0 : 1;
      backward += box.value().numbers.front() <= last ? 1 : 0;
      last = box.value().numbers.front();
    }
    writer.join();
    CHECK(torn == 0);
    CHECK(backward == 0);
  }

  TEST_CASE("no allocation") {
    Mailbox<Letter> box;
    const fuai_test::AllocationGuard guard;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      box.put(Letter::of(i));
      box.fetch();
    }
    CHECK(guard.count() == 0);
  }
}
