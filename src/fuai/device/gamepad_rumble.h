// Rumble of a gamepad by the kernel's force feedback: something to feel for people without a device.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/devices.md, "Gamepad".
#pragma once

#include <string>

namespace fuai {

/// The motors of a gamepad. They stop by themselves kRumbleLasts_ms after the last set(), and with the
/// program.
class GamepadRumble {
 public:
  /// ioctl() of the system; tests bring their own.
  using Call = int (*)(int descriptor, unsigned long request, void* argument);

  /// @param path of its node, "/dev/input/event5"; empty: the first that rumbles and may be opened
  /// @throws Error (kNoDevice) with the system's words. Thread class: set-up.
  explicit GamepadRumble(const std::string& path = {}, Call call = nullptr);
  ~GamepadRumble();
  GamepadRumble(const GamepadRumble&) = delete;
  GamepadRumble& operator=(const GamepadRumble&) = delete;

  /// @param strength 0 to 1; beyond it is cut, no number is none
  /// @return false once the gamepad is gone. Thread class: any but the force loop's: the kernel may wait.
  bool set(double strength) noexcept;

 private:
  bool open_node(const std::string& path) noexcept;
  bool play(int times) noexcept;

  Call call_;
  int descriptor_ = -1, effect_ = -1;
  bool runs_ = false;
};

inline constexpr int kRumbleLasts_ms = 500;  ///< longer than any picture of the viewer takes

}  // namespace fuai
