// Runs a session on a thread of its own.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/running_session.h"

namespace fuai {

RunningSession::RunningSession(std::span<const SessionHand> hands, HapticEnvironment& environment,
                               const RealtimeOptions& options, HoldRule* holds, SessionListener* listener)
    : session_(hands, environment, options, holds, listener) {
  thread_ = std::jthread([this] { report_ = session_.run(force_clock_, cloth_clock_, stop_); });
}

RunningSession::~RunningSession() { end(); }

const RealtimeReport& RunningSession::end() {
  stop_.store(true);
  if (thread_.joinable()) thread_.join();
  return report_;
}

}  // namespace fuai
