// Lets a gamepad rumble.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/gamepad_rumble.h"

#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/device/system_findings.h"

namespace fuai {
namespace {

constexpr const char* kCure =
    "plug a gamepad in that rumbles; if /dev/input/event* is there, add yourself to the group input";
constexpr double kFullMagnitude = 0xffff;

int system_call(int descriptor, unsigned long request, void* argument) {
  return ::ioctl(descriptor, request, argument);
}

}  // namespace

GamepadRumble::GamepadRumble(const std::string& path, Call call)
    : call_(call != nullptr ? call : system_call) {
  std::vector<DriverFinding> findings;
  std::vector<std::string> nodes{path};
  if (path.empty()) nodes = find_device_nodes("input/event", true, findings);
  for (const std::string& node : nodes)
    if (open_node(node)) return;
  throw Error(ErrorKind::kNoDevice, path.empty() ? "no gamepad rumbles" : path + " does not rumble",
              {"", 0, 0, "rumble"}, kCure);
}

GamepadRumble::~GamepadRumble() {
  set(0.0);
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool GamepadRumble::open_node(const std::string& path) noexcept {
  descriptor_ = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) return false;
  std::array<std::uint8_t, FF_MAX / 8 + 1> can{};
  if (call_(descriptor_, EVIOCGBIT(EV_FF, can.size()), can.data()) >= 0 &&
      (can[FF_RUMBLE / 8] >> (FF_RUMBLE % 8) & 1) != 0)
    return true;
  ::close(descriptor_);
  descriptor_ = -1;
  return false;
}

bool GamepadRumble::play(int times) noexcept {
  input_event event{};
  event.type = EV_FF;
  event.code = static_cast<std::uint16_t>(effect_);
  event.value = times;
  return ::write(descriptor_, &event, sizeof event) == static_cast<ssize_t>(sizeof event) || errno == EAGAIN;
}

bool GamepadRumble::set(double strength) noexcept {
  if (descriptor_ < 0) return false;
  const double share = std::isfinite(strength) ? std::clamp(strength, 0.0, 1.0) : 0.0;
  if (share == 0.0 && !runs_) return true;
  bool there = true;
  if (share > 0.0) {
    ff_effect effect{};
    effect.type = FF_RUMBLE;
    effect.id = static_cast<std::int16_t>(effect_);  // -1: a new one
    effect.replay.length = static_cast<std::uint16_t>(kRumbleLasts_ms);
    effect.u.rumble.strong_magnitude = static_cast<std::uint16_t>(std::lround(kFullMagnitude * share));
    effect.u.rumble.weak_magnitude = effect.u.rumble.strong_magnitude;
    there = call_(descriptor_, EVIOCSFF, &effect) >= 0;
    if (there) effect_ = effect.id;
  }
  there = there && play(share > 0.0 ? 1 : 0);
  runs_ = there && share > 0.0;
  if (there) return true;
  ::close(descriptor_);
  descriptor_ = -1;
  return false;
}

}  // namespace fuai
