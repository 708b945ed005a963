// Hands the pictures of a video to ffmpeg, a process of its own.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>
#include <cstdint>
#include <span>
#include <string>

namespace fuai {

/// A running ffmpeg. Thread class: set-up, one thread.
class FramePipe {
 public:
  /// Whether ffmpeg is on the PATH.
  static bool available();
  /// @param path of the video; its ending says the format @param width, height even [pixel]
  /// @throws Error (kNoDevice) when there is no ffmpeg, (kBadInput) when it cannot be started
  FramePipe(const std::string& path, int width, int height, int frames_a_second);
  FramePipe(const FramePipe&) = delete;
  FramePipe& operator=(const FramePipe&) = delete;
  /// Ends the video and waits for ffmpeg.
  ~FramePipe();

  /// A picture, rows from the top, red green blue alpha. Waits while ffmpeg is busy.
  /// @return false when ffmpeg has ended: the video is over
  bool write(std::span<const std::uint8_t> rgba) noexcept;

 private:
  int pipe_ = -1;
  pid_t process_ = -1;
};

}  // namespace fuai
