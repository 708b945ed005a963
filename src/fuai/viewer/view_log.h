// A recording of a session of the viewer: the setup, then every event with its tick, a line each.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "Recordings".
//
//   fuai-view/1 recordings are text; each line is handed to the system as soon as it is known, so that a
//   killed program loses at most the frame it was in. A torn last line is left out at reading.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "fuai/viewer/view_session.h"

namespace fuai {

/// Writes a recording while it happens. Thread class: set-up (file).
class ViewLogWriter {
 public:
  /// @throws Error (kBadInput) when the file cannot be written. @param laws_hashes one a fabric
  ViewLogWriter(const std::string& path, const ViewSetup& setup);
  ~ViewLogWriter();
  /// @param rewound_to as ViewSession::take_events() says
  void write(const std::vector<ViewEvent>& events, std::int64_t rewound_to);
  /// A change of the setup at a tick (fabric, factor, scene): a new part of the recording.
  void write_setup(std::int64_t tick, const ViewSetup& setup, bool keep_shape);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// A part of a recording: a setup, and the events that followed.
struct ViewLogPart {
  std::int64_t tick = 0;
  ViewSetup setup;
  bool keep_shape = false;
  std::vector<ViewEvent> events;
};

/// @throws Error (kBadInput) with file and line. Thread class: set-up.
std::vector<ViewLogPart> read_view_log(const std::string& path);

/// What a replay found.
struct ViewReplay {
  std::int64_t ticks = 0;
  std::uint64_t state_hash = 0;  ///< at the last hash of the recording
  std::uint64_t recorded_hash = 0;
  std::int64_t hashes = 0;             ///< compared
  std::int64_t first_difference = -1;  ///< tick; -1: none
  bool matches() const noexcept { return hashes > 0 && first_difference < 0; }
};
/// Runs a recording again. @throws Error as ViewCloths. Thread class: set-up.
ViewReplay replay_view_log(const std::vector<ViewLogPart>& parts);

}  // namespace fuai
