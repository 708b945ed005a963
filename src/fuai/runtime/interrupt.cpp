// Signals as a flag.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/interrupt.h"

#include <signal.h>

namespace fuai {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not lock");

}  // namespace

extern "C" {
static void note_interrupt(int /*signal*/) { interrupted.store(true); }
}

InterruptFlag::InterruptFlag() {
  interrupted.store(false);
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the second time it ends the process
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &before_interrupt_);
  sigaction(SIGTERM, &action, &before_terminate_);
}

InterruptFlag::~InterruptFlag() {
  sigaction(SIGINT, &before_interrupt_, nullptr);
  sigaction(SIGTERM, &before_terminate_, nullptr);
}

const std::atomic<bool>& InterruptFlag::flag() const noexcept { return interrupted; }

}  // namespace fuai
