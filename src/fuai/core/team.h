// A few threads that do one piece of work together; made in runtime/, used by solvers that know no thread.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

namespace fuai {

/// Members work on the same task at the same time. A task must not depend on how it is shared out.
class Team {
 public:
  Team() = default;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  virtual ~Team() = default;

  /// Members, the caller included. Thread class: real-time.
  virtual int size() const noexcept = 0;
  /// Calls work(context, member) once for every member, at the same time, and returns when all are done.
  /// Not to be nested. Thread class: real-time.
  virtual void run(void (*work)(void* context, int member), void* context) noexcept = 0;
};

/// team->run() of anything callable with a member's number; without a team the caller is the only member.
template <class Work>
void run_together(Team* team, Work&& work) noexcept {
  if (team == nullptr) {
    work(0);
    return;
  }
  using Plain = std::remove_reference_t<Work>;
  team->run([](void* context, int member) { (*static_cast<Plain*>(context))(member); }, &work);
}

/// Share of a member: [begin, end) of `count` things.
struct Share {
  int begin = 0, end = 0;
};
constexpr Share share_of(int count, int member, int members) noexcept {
  return {count * member / members, count * (member + 1) / members};
}

}  // namespace fuai
