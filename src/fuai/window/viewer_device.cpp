// Opens, follows and ends the devices of the window.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/viewer_device.h"

#include <algorithm>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/device/registry.h"
#include "fuai/experiments/scene_pictures.h"
#include "fuai/window/viewer_work.h"

namespace fuai {

ViewerDevice::ViewerDevice(ViewerState& state, std::function<void(const std::string&)> say)
    : state_(state), say_(std::move(say)) {}

void ViewerDevice::open(const ViewerOptions& options, bool computed) {
  open_hand(options.device, computed);
  if (options.rumble) open_rumble();
  if (options.sound) open_sound();
}

void ViewerDevice::open_hand(const std::string& name, bool computed) {
  const std::string driver = name.substr(0, name.find(':'));
  if (driver.empty() || find_device_driver(driver).name == mouse_driver().name) return;
  state_.device.asked = name;
  try {
    HandDevice opened = open_hand_device(name);
    if (computed && !opened.computed) {
      throw Error(ErrorKind::kUsage, "'" + name + "' lives in real time, and --seconds is computed time", {},
                  "leave --seconds out, or take --device simulated");
    }
    meet_device(state_, opened.device->info());
    hand_ = std::make_unique<DeviceHand>(std::move(opened), *state_.session,
                                         computed ? DeviceHand::Time::kVirtual : DeviceHand::Time::kReal);
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::kNoDevice) throw;
    tell(e);
  }
}

void ViewerDevice::open_rumble() {
  try {
    rumble_ = std::make_unique<GamepadRumble>();
  } catch (const Error& e) {
    tell(e);
  }
}

void ViewerDevice::open_sound() {
  try {
    sound_ = std::make_unique<ForceSound>();
  } catch (const Error& e) {
    tell(e);
  }
}

void ViewerDevice::begin() {
  if (hand_) hand_->begin(state_.cloths->scene(0).view);
}

std::size_t ViewerDevice::felt() const { return std::min(state_.felt, state_.built.fabrics.size() - 1); }

void ViewerDevice::follow_force() {
  state_.rumbles = rumble_ != nullptr || sound_ != nullptr;
  double share = 0.0;
  if (state_.playing && !state_.forces.empty()) {
    const ForceMoment& last = state_.forces.back();
    // Of cloths that have just come there is none yet; the scene's own hand is nobody's to feel.
    const bool feels = last.hand >= 0 && last.hand != kSceneHand && felt() < last.forces.size();
    if (feels) share = force_share(last.forces[felt()]);
  }
  if (rumble_ && !rumble_->set(share)) {
    rumble_.reset();
    tell("--rumble", TextId::kDeviceAway);
  }
  if (sound_ && !sound_->set(share)) {
    sound_.reset();
    tell("--sound", TextId::kDeviceAway);
  }
}

/// To the window in its language, and in English to whoever started it.
void ViewerDevice::tell(const std::function<std::string(Language)>& what) {
  const auto line = [&](Language language) {
    return what(language) + "; " + ui_text(TextId::kDeviceMouseGoesOn, language);
  };
  state_.say(line(state_.settings.language), true);
  if (say_) say_(line(Language::kEnglish));
}

void ViewerDevice::tell(const std::string& name, TextId what) {
  tell([&](Language language) { return name + ": " + ui_text(what, language); });
}

void ViewerDevice::tell(const Error& error) {
  tell([&](Language language) { return error_text_without_place(error, language); });
}

void ViewerDevice::follow() {
  state_.session->feel(felt());
  if (!hand_) return;
  const DeviceView before = std::exchange(state_.device.view, hand_->look());
  const DeviceView& now = state_.device.view;
  if (now.away && !before.away) tell(state_.device.model, TextId::kDeviceAway);
  if (!now.away && before.away) state_.say(state_.device.model + ": " + state_.text(TextId::kDeviceBack));
  if (now.faulted && !before.faulted) tell(state_.device.model, TextId::kDeviceFault);
  most_force_ = std::max(most_force_, now.force);
}

void ViewerDevice::end(ViewerResult& result) {
  if (!hand_) return;
  follow();
  const std::vector<std::string> refused = hand_->end();
  if (say_)
    for (const std::string& line : refused) say_(line);
  result.device = state_.device.model;
  result.overruns = state_.device.view.overruns;
  result.device_force = most_force_;
}

}  // namespace fuai
