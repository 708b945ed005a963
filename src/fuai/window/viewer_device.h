// The devices of the window: the hand of a haptic device on the cloths, a gamepad that rumbles, a tone.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "A device".
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "fuai/device/force_sound.h"
#include "fuai/device/gamepad_rumble.h"
#include "fuai/window/device_hand.h"
#include "fuai/window/viewer.h"
#include "fuai/window/viewer_state.h"

namespace fuai {

/// What the user holds besides the mouse. What is missing is told, in the window and to whoever started it,
/// and the mouse goes on. Thread class: the window's.
class ViewerDevice {
 public:
  /// @param state must outlive it  @param say as ViewerOptions::say
  ViewerDevice(ViewerState& state, std::function<void(const std::string&)> say);

  /// Opens what the options ask for; a device that is not there is told.
  /// @param computed the ticks are of computed time
  /// @throws Error (kUsage) for a driver that does not exist, and a real device in computed time.
  void open(const ViewerOptions& options, bool computed);
  /// Whether a device ticks the session.
  bool ticks() const noexcept { return hand_ != nullptr; }
  /// Its hand, or none.
  DeviceHand* hand() noexcept { return hand_.get(); }
  /// Starts, or starts anew with another scene.
  void begin();
  /// Takes what the device has to tell; once a picture.
  void follow();
  /// The gamepad and the tone, as strong as the arrows are long: the force of the cloth that is felt on the
  /// hand that gripped or moved last; once a picture.
  void follow_force();
  /// No force any more, and nobody ticks the session.
  void end(ViewerResult& result);

 private:
  void open_hand(const std::string& name, bool computed);
  void open_rumble();
  void open_sound();
  std::size_t felt() const;
  void tell(const std::function<std::string(Language)>& what);
  void tell(const std::string& name, TextId what);
  void tell(const Error& error);

  ViewerState& state_;
  std::function<void(const std::string&)> say_;
  double most_force_ = 0.0;  // that was sent [N]
  std::unique_ptr<GamepadRumble> rumble_;
  std::unique_ptr<ForceSound> sound_;
  std::unique_ptr<DeviceHand> hand_;
};

}  // namespace fuai
