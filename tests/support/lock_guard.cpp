// Stands before the C library's locks in the test programs, counts, and passes on.
// SPDX-License-Identifier: Apache-2.0
#include "support/lock_guard.h"

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>

// The thread sanitizer has functions of its own in their place; gcc and clang say so each in its way.
#if defined(__SANITIZE_THREAD__)
#define FUAI_COUNTS_LOCKS 0
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define FUAI_COUNTS_LOCKS 0
#endif
#endif
#ifndef FUAI_COUNTS_LOCKS
#define FUAI_COUNTS_LOCKS 1
#endif

namespace {

thread_local std::size_t t_locks = 0;

#if FUAI_COUNTS_LOCKS
/// The C library's own function of a name, counted. @param real where it is kept once it is found
template <class... Arguments>
int pass_on(std::atomic<int (*)(Arguments...)>& real, const char* name, Arguments... arguments) {
  ++t_locks;
  auto* function = real.load(std::memory_order_relaxed);
  if (function == nullptr) {
    function = reinterpret_cast<int (*)(Arguments...)>(dlsym(RTLD_NEXT, name));
    real.store(function, std::memory_order_relaxed);
  }
  return function(arguments...);
}
#endif

}  // namespace

namespace fuai_test {
std::size_t lock_count() noexcept { return t_locks; }
bool counts_locks() noexcept { return FUAI_COUNTS_LOCKS != 0; }
}  // namespace fuai_test

#if FUAI_COUNTS_LOCKS
extern "C" int pthread_mutex_lock(pthread_mutex_t* lock) noexcept {
  static std::atomic<int (*)(pthread_mutex_t*)> real{};
  return pass_on(real, "pthread_mutex_lock", lock);
}
extern "C" int pthread_mutex_trylock(pthread_mutex_t* lock) noexcept {
  static std::atomic<int (*)(pthread_mutex_t*)> real{};
  return pass_on(real, "pthread_mutex_trylock", lock);
}
extern "C" int pthread_rwlock_rdlock(pthread_rwlock_t* lock) noexcept {
  static std::atomic<int (*)(pthread_rwlock_t*)> real{};
  return pass_on(real, "pthread_rwlock_rdlock", lock);
}
extern "C" int pthread_rwlock_wrlock(pthread_rwlock_t* lock) noexcept {
  static std::atomic<int (*)(pthread_rwlock_t*)> real{};
  return pass_on(real, "pthread_rwlock_wrlock", lock);
}
#endif
