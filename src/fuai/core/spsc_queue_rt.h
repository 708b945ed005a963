// A queue between two threads that never wait: one puts in, the other takes out, in order.
// SPDX-License-Identifier: Apache-2.0
//
//   writer: push(value)          reader: front(), pop()
//
//      [ . . c b a . . ]         a ring; `head_` is where the reader takes, `tail_` where the writer puts.
//            ^     ^             Both only ever grow; each is written by one thread and read by the other.
//          tail_  head_
//
//   A full queue refuses; nothing that is in it is lost.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <vector>

namespace fuai {

/// A queue of T, whose copying must not throw or allocate. One writer and one reader.
template <class T>
class SpscQueue {
 public:
  /// @param capacity at least so many fit. Thread class: set-up.
  explicit SpscQueue(std::size_t capacity) : ring_(std::bit_ceil(capacity < 1 ? 1 : capacity)) {}
  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  std::size_t capacity() const noexcept { return ring_.size(); }

  /// The writer's. @return false when it is full: the value is not in it. Thread class: real-time.
  bool push(const T& value) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    // Acquire: the reader is done with the place before it is written again.
    if (tail - head_.load(std::memory_order_acquire) == ring_.size()) return false;
    ring_[tail & (ring_.size() - 1)] = value;
    tail_.store(tail + 1, std::memory_order_release);  // the value is written before it may be seen
    return true;
  }

  /// The reader's: the oldest value, null when there is none; valid until pop(). Thread class: real-time.
  const T* front() const noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return nullptr;
    return &ring_[head & (ring_.size() - 1)];
  }

  /// The reader's: takes out what front() showed; only when there was something. Thread class: real-time.
  void pop() noexcept { head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  /// The reader's: front() and pop(). @return whether there was something. Thread class: real-time.
  bool take(T& value) noexcept {
    const T* first = front();
    if (first == nullptr) return false;
    value = *first;
    pop();
    return true;
  }

 private:
  std::vector<T> ring_;
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace fuai
