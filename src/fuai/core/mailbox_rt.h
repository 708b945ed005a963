// A mailbox between two threads that never wait: the newest value wins, no read is torn.
// SPDX-License-Identifier: Apache-2.0
//
//   writer: put(value)               reader: fetch(), then value()
//
//      [ back ]  --put-->  [ middle ]  --fetch-->  [ front ]
//      writer's           nobody's, fresh or not    reader's
//
//   Three copies. put() fills the back one and swaps it with the middle one, fetch() swaps the front one with
//   the middle one if that is fresh: one atomic exchange each, no loop. One writer and one reader.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace fuai {

/// The newest value of T, whose copying must not throw or allocate (matrices of fixed size do not).
template <class T>
class Mailbox {
 public:
  /// All three copies hold `first`, which counts as read. Thread class: set-up.
  explicit Mailbox(const T& first = T{}) : copies_{first, first, first} {}
  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;

  /// The writer's. What was put and not fetched is forgotten. Thread class: real-time.
  void put(const T& value) noexcept {
    copies_[back_] = value;
    // Release: the copy is written before the reader may see its number. Acquire: the reader is done with
    // the copy that comes back.
    back_ = middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) & kNumber;
  }

  /// The reader's: takes what is fresh. @return whether there was something. Thread class: real-time.
  bool fetch() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kNumber;
    return true;
  }

  /// The reader's: what the last fetch() took. Thread class: real-time.
  const T& value() const noexcept { return copies_[front_]; }

 private:
  static constexpr std::uint8_t kNumber = 3, kFresh = 4;
  std::array<T, 3> copies_;
  std::uint8_t back_ = 0, front_ = 1;  // each touched by its own thread only
  std::atomic<std::uint8_t> middle_{2};
};

}  // namespace fuai
