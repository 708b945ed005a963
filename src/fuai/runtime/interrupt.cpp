// Signals as a flag.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/interrupt.h"

#include <signal.h>

#include <cstdint>
#include <ctime>

namespace fuai {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> interrupted{false};
std::atomic<std::int64_t> first_at{0};  // [ns]; 0: none yet
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler must not lock");

std::int64_t now_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

extern "C" {
// Everything that it calls may be called from a handler.
static void note_interrupt(int number) {
  const std::int64_t now = now_ns();
  std::int64_t first = 0;
  if (first_at.compare_exchange_strong(first, now)) {
    interrupted.store(true);
    return;
  }
  if (static_cast<double>(now - first) < 1e9 * kInterruptGrace) return;
  signal(number, SIG_DFL);
  raise(number);
}
}

InterruptFlag::InterruptFlag() {
  first_at.store(0);
  interrupted.store(false);
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    const bool nohup = kSignals[i] == SIGHUP && before_[i].sa_handler == SIG_IGN;
    if (!nohup) sigaction(kSignals[i], &action, nullptr);
  }
}

InterruptFlag::~InterruptFlag() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

const std::atomic<bool>& InterruptFlag::flag() const noexcept { return interrupted; }

}  // namespace fuai
