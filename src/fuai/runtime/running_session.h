// A session in real time beside the caller, such as a window that has pictures to draw.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <span>
#include <thread>

#include "fuai/runtime/realtime_session.h"

namespace fuai {

/// It runs from construction until end() or destruction, by the system's clock. What it is given must outlive
/// it.
class RunningSession {
 public:
  /// As RealtimeSession. @throws Error as it does. Thread class: set-up.
  RunningSession(std::span<const SessionHand> hands, HapticEnvironment& environment,
                 const RealtimeOptions& options, HoldRule* holds = nullptr,
                 SessionListener* listener = nullptr);
  ~RunningSession();
  RunningSession(const RunningSession&) = delete;
  RunningSession& operator=(const RunningSession&) = delete;

  /// Ends it, and waits until no force was written to the devices. @return what it was. Thread class: set-up.
  const RealtimeReport& end();
  /// As RealtimeSession::overruns(). Thread class: any.
  std::uint64_t overruns() const noexcept { return session_.overruns(); }

 private:
  RealtimeSession session_;
  MonotonicClock force_clock_, cloth_clock_;
  std::atomic<bool> stop_{false};
  RealtimeReport report_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace fuai
