// FUAI_ASSERT: a precondition of our own calls, checked in debug and sanitizer builds.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>

#if !defined(FUAI_ASSERTIONS) && !defined(NDEBUG)
#define FUAI_ASSERTIONS 1
#endif

namespace fuai {

/// Prints the failed condition and aborts. Thread class: any.
[[noreturn]] inline void assertion_failed(const char* condition, const char* file, int line) noexcept {
  std::fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, condition);
  std::abort();
}

}  // namespace fuai

#ifdef FUAI_ASSERTIONS
#define FUAI_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : ::fuai::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define FUAI_ASSERT(condition) static_cast<void>(0)
#endif
