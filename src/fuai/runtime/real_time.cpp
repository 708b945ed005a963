// Priority and locked memory.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/real_time.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>

namespace fuai {

std::string claim_priority(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  if (error == 0) return {};
  return "no real-time priority: " + std::string(std::strerror(error)) +
         "; allow it with 'rtprio 90' in /etc/security/limits.d, or run as root";
}

LockedMemory::LockedMemory() {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return;
  why_not_ = "memory is not locked: " + std::string(std::strerror(errno)) +
             "; allow it with 'memlock unlimited' in /etc/security/limits.d, or run as root";
}

LockedMemory::~LockedMemory() {
  if (why_not_.empty()) munlockall();
}

}  // namespace fuai
