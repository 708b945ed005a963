// Tells where the program was when it broke down: calls that are safe in a signal handler only.
// SPDX-License-Identifier: Apache-2.0
#include "crash_report.h"

#include <execinfo.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

namespace fuai_app {
namespace {

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr int kMostFrames = 64;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

const char* told_version = "";

void tell(const char* text) {
  // Nothing could be done about a stderr that is gone.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
}

const char* name_of(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "SIGSEGV";
    case SIGBUS:
      return "SIGBUS";
    case SIGFPE:
      return "SIGFPE";
    case SIGILL:
      return "SIGILL";
    default:
      return "SIGABRT";
  }
}

/// The handler is gone when it is called (SA_RESETHAND): what goes wrong in here ends the program at once.
void report(int signal) {
  tell("fuai: the program broke down (");
  tell(name_of(signal));
  tell(
      "). That is a defect of fuai or of a library or driver it uses; recordings (.fuai-view, .fuailog) are "
      "kept "
      "up to the last second. Please report it with what you did and these lines:\nfuai ");
  tell(told_version);
  tell("\n");
  std::array<void*, kMostFrames> frames;
  backtrace_symbols_fd(frames.data(), backtrace(frames.data(), kMostFrames), STDERR_FILENO);
  // Comes back to the instruction that failed; SIGABRT and signals from outside do not.
  raise(signal);
}

}  // namespace

void report_crashes(const char* version) {
  if (kSanitized) return;
  told_version = version;
  // The first call loads a library, which allocates: not to be done in a handler.
  std::array<void*, 1> frame;
  backtrace(frame.data(), 1);
  // Of its own, for a stack that has run over.
  static std::array<char, 1 << 16> stack;
  stack_t other{};
  other.ss_sp = stack.data();
  other.ss_size = stack.size();
  sigaltstack(&other, nullptr);
  for (const int signal : kSignals) {
    struct sigaction action {};
    action.sa_handler = report;
    action.sa_flags = SA_RESETHAND | SA_ONSTACK;
    sigaction(signal, &action, nullptr);
  }
}

}  // namespace fuai_app
