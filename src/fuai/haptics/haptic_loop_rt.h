// One tick of a device's force loop, in two halves with the cloth's turn between them.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md.
//
//   read(dt)   device -> force path -> pose     write()   newest model -> force path -> device
//
//   Who calls it decides what time is: VirtualSession, or a thread of RealtimeSession.
#pragma once

#include <cstdint>

#include "fuai/haptics/session_record.h"

namespace fuai {

/// The loop of one hand. One thread calls all of it. Device and path must outlive it.
class HapticLoop {
 public:
  /// Thread class: set-up.
  HapticLoop(Device& device, ForcePath& path, std::uint32_t hand = 0) noexcept
      : device_(&device), path_(&path) {
    record_.hand = hand;
  }

  /// Where the hand is. @param dt since the last tick [s]. Thread class: real-time.
  const ToolPose& read(double dt) noexcept;
  /// The force on the hand, written to the device. @return all of the tick. Thread class: real-time.
  const TickRecord& write() noexcept;
  /// Writes no force. Thread class: real-time.
  void let_go() noexcept { device_->write({}); }

  Device& device() noexcept { return *device_; }
  ForcePath& path() noexcept { return *path_; }
  const ToolPose& pose() const noexcept { return pose_; }
  const TickRecord& record() const noexcept { return record_; }

 private:
  Device* device_;
  ForcePath* path_;
  std::uint64_t ticks_ = 0;
  ToolPose pose_;
  TickRecord record_;
};

}  // namespace fuai
