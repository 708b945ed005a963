// A ring between two threads that never wait: every value arrives, in its order, while there is room.
// SPDX-License-Identifier: Apache-2.0
//
//   writer: push(value), false when full          reader: pop(value), false when empty
//
//   Two counters that only rise, each written by one thread; a slot is written before `written_` says so and
//   read before `read_` gives it back.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <vector>

namespace fuai {

/// Values of T, whose copying must not throw or allocate. One writer and one reader.
template <class T>
class Ring {
 public:
  /// @param room at least so many values; rounded up to a power of two. Thread class: set-up.
  explicit Ring(std::size_t room) : slots_(std::bit_ceil(room < 2 ? std::size_t{2} : room)) {}
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  /// The writer's. @return false when there is no room: the value is not taken. Thread class: real-time.
  bool push(const T& value) noexcept {
    const std::size_t at = written_.load(std::memory_order_relaxed);
    // Acquire: the reader is done with the slot.
    if (at - read_.load(std::memory_order_acquire) == slots_.size()) return false;
    slots_[at & (slots_.size() - 1)] = value;
    written_.store(at + 1, std::memory_order_release);
    return true;
  }

  /// The reader's. @return whether there was a value. Thread class: real-time.
  bool pop(T& value) noexcept {
    const std::size_t at = read_.load(std::memory_order_relaxed);
    // Acquire: the slot is written.
    if (at == written_.load(std::memory_order_acquire)) return false;
    value = slots_[at & (slots_.size() - 1)];
    read_.store(at + 1, std::memory_order_release);
    return true;
  }

  std::size_t room() const noexcept { return slots_.size(); }  ///< Thread class: any.

 private:
  std::vector<T> slots_;
  alignas(64) std::atomic<std::size_t> written_{0};
  alignas(64) std::atomic<std::size_t> read_{0};
};

}  // namespace fuai
