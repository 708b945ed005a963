// A team whose members wait for work by watching a number, so that handing over costs well under a
// microsecond.
// SPDX-License-Identifier: Apache-2.0
//
//   caller   writes the task, raises `round`, does its own part, waits until `left` is zero
//   member   sees the round rise, does its part, lowers `left`; after a while without work it goes to sleep,
//   and
//            the next round wakes it
#pragma once

#include <atomic>
#include <thread>
#include <vector>

#include "fuai/core/team.h"

namespace fuai {

/// Threads live as long as the team. run() is called by one thread at a time.
class SpinTeam final : public Team {
 public:
  /// @param size members, the caller included, 1 to 64. @throws Error (kUsage) outside. Thread class: set-up.
  explicit SpinTeam(int size);
  ~SpinTeam() override;

  int size() const noexcept override { return size_; }
  void run(void (*work)(void* context, int member), void* context) noexcept override;

 private:
  void serve(int member) noexcept;

  const int size_;
  void (*work_)(void*, int) = nullptr;
  void* context_ = nullptr;
  alignas(64) std::atomic<unsigned> round_{0};
  alignas(64) std::atomic<int> left_{0};
  alignas(64) std::atomic<int> asleep_{0};
  std::atomic<bool> ending_{false};
  std::vector<std::jthread> members_;
};

}  // namespace fuai
