// What the window writes: pictures, videos, shapes, fabrics, recordings.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "fuai/picture/cloth_painter.h"
#include "fuai/viewer/force_log.h"
#include "fuai/viewer/view_log.h"
#include "fuai/window/screen_target.h"
#include "fuai/window/viewer_state.h"

namespace fuai {

/// Writes files into a folder; each error is told in the window and ends nothing. Thread class: the window's.
class ViewerFiles {
 public:
  /// @param version of the program, for captions
  ViewerFiles(std::string folder, std::string version);
  ~ViewerFiles();

  /// Does what the wishes of the state ask for in files. @param target as the frame left it
  void serve(ViewerState& state, ScreenTarget& target, ClothPainter& painter);
  /// Once a frame: what happened goes into the recording, forces into their log, a picture into the video.
  void follow(ViewerState& state, const ScreenTarget& target);
  /// Starts a recording of everything from here on. @throws Error (kBadInput) when it cannot be written
  void start_recording(ViewerState& state, const std::string& path);
  /// The cloths alone, as they are seen. @param transparent without background and floor
  Image cloths_image(const ViewerState& state, ScreenTarget& target, ClothPainter& painter, bool caption,
                     bool transparent) const;
  /// Other cloths took over: goes into the recording.
  void setup_changed(ViewerState& state);

 private:
  void screenshot(ViewerState& state, ScreenTarget& target, ClothPainter& painter);
  void toggle_video(ViewerState& state);
  void toggle_recording(ViewerState& state);
  void toggle_force_log(ViewerState& state);
  void save_fabric(ViewerState& state);
  void follow_events(ViewerState& state);
  void follow_forces(const ViewerState& state);
  std::string free_name(const std::string& stem, const std::string& ending) const;

  std::string folder_, version_;
  std::string recording_path_, forces_path_;  // of the newest ones
  std::unique_ptr<ViewLogWriter> recording_;
  std::uint64_t lost_before_ = 0;  // events that were lost before it began
  std::unique_ptr<ForceLog> forces_;
  class Video;
  std::unique_ptr<Video> video_;
};

}  // namespace fuai
