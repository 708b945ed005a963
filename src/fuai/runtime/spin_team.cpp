// Members of a spinning team.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/spin_team.h"

#include <string>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Looks at the round this often before going to sleep: some tens of microseconds. Between two kernels of a
/// step it is never reached; between two steps of a sheet at rest it may be.
constexpr int kPatience = 20000;

void pause() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

}  // namespace

SpinTeam::SpinTeam(int size) : size_(size) {
  if (size < 1 || size > 64)
    throw Error(ErrorKind::kUsage, "a team has 1 to 64 members, got " + std::to_string(size));
  for (int member = 1; member < size; ++member) members_.emplace_back([this, member] { serve(member); });
}

SpinTeam::~SpinTeam() {
  ending_.store(true);
  round_.fetch_add(1);
  round_.notify_all();
}

void SpinTeam::run(void (*work)(void* context, int member), void* context) noexcept {
  work_ = work;
  context_ = context;
  left_.store(size_ - 1, std::memory_order_relaxed);
  round_.fetch_add(1);  // also publishes the task
  if (asleep_.load() > 0) round_.notify_all();
  work(context, 0);
  // A member that lost its processor may take long: then yield ours to it.
  for (int i = 0; left_.load(std::memory_order_acquire) > 0; ++i) {
    if (i < kPatience) {
      pause();
    } else {
      std::this_thread::yield();
    }
  }
}

void SpinTeam::serve(int member) noexcept {
  unsigned seen = 0;
  while (true) {
    int i = 0;
    while (round_.load(std::memory_order_acquire) == seen) {
      if (++i < kPatience) {
        pause();
      } else {
        asleep_.fetch_add(1);
        round_.wait(seen);
        asleep_.fetch_sub(1);
      }
    }
    ++seen;
    if (ending_.load()) return;
    work_(context_, member);
    left_.fetch_sub(1, std::memory_order_release);
  }
}

}  // namespace fuai
