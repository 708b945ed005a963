// A recording of a session of the viewer: the setup, then every event with its tick, a line each.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "Recordings".
//
//   fuai-view/1 recordings are text; each line is handed to the system as soon as it is known, so that a
//   killed program loses at most the picture it was in. A torn last line is left out at reading.
//
//   A recording begins where the cloths are as their scene starts: at tick 0 of a session, at a reset, or at
//   a replace() without keeping the shape. What comes before is left out.
//
//   ViewLogWriter log(path, setup)             then a reset, or replace(), unless the session has just begun
//   with every replace(): log.announce(session.newest_build(), its setup), before the next take_events()
//   with every picture: events = session.take_events(rewound_to); log.write(events, rewound_to)
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fuai/viewer/view_session.h"

namespace fuai {

/// Writes a recording while it happens. Thread class: set-up (file).
class ViewLogWriter {
 public:
  /// @param setup of the cloths that are there
  /// @throws Error (kBadInput) when the file cannot be written.
  ViewLogWriter(const std::string& path, const ViewSetup& setup);
  ~ViewLogWriter();

  /// @param events, rewound_to as ViewSession::take_events() gave them
  /// @throws Error (kBadInput) when the file cannot be written; (kUsage) for a build nobody announced.
  void write(const std::vector<ViewEvent>& events, std::int64_t rewound_to);
  /// The setup behind a build of ViewSession, to be told before the events are written that say it took over.
  void announce(std::uint64_t build, const ViewSetup& setup);
  /// Whether what it waits for has come: before that there is nothing to be done again.
  bool begun() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// A part of a recording: a setup, and the events that followed.
struct ViewLogPart {
  std::int64_t tick = 0;
  ViewSetup setup;
  bool keep_shape = false;
  std::vector<ViewEvent> events;  ///< commands and hashes
};

/// Reads a recording and loads its fabrics. @throws Error (kBadInput) with file and line, also where a fabric
/// is not the one that was recorded. Thread class: set-up.
std::vector<ViewLogPart> read_view_log(const std::string& path);

/// One of the parts as a script for ViewSession::replace(). Thread class: any.
ViewScript view_script(const std::vector<ViewLogPart>& parts, std::size_t part);

/// What the name of a recording ends with.
inline constexpr const char* kViewLogEnding = ".fuai-view";

/// The cloth's reaction on a hand of the user.
struct ViewReplayForce {
  std::size_t cloth = 0, hand = 0;
  double newtons = 0.0;  ///< [N]
};

/// What a replay found.
struct ViewReplay {
  std::int64_t ticks = 0;
  std::uint64_t state_hash = 0;  ///< at the last hash of the recording
  std::uint64_t recorded_hash = 0;
  std::int64_t hashes = 0;              ///< compared
  std::int64_t first_difference = -1;   ///< tick; -1: none
  std::vector<ViewReplayForce> forces;  ///< on the hands that hold after the last event
  bool matches() const noexcept { return hashes > 0 && first_difference < 0; }
};
/// Runs a recording again. @throws Error as ViewCloths. Thread class: set-up.
ViewReplay replay_view_log(const std::vector<ViewLogPart>& parts);

}  // namespace fuai
