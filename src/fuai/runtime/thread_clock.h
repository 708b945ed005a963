// Time that a thread spends on its core, for reports: no computation depends on it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>

namespace fuai {

/// Time this thread has spent on a core [s]: what other programs take does not count. Thread class: any.
inline double thread_seconds() noexcept {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace fuai
