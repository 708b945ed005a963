// The mouse as a device.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/device_mouse.h"

#include <algorithm>
#include <cmath>

namespace fuai {
namespace {

constexpr const char* kDriver = "mouse";

DriverReport probe() {
  DriverReport report;
  report.available = true;
  report.findings.push_back({"mouse", "moves only where a window hands its position in", true});
  return report;
}

}  // namespace

DeviceMouse::DeviceMouse(DeviceClock clock) : clock_(clock) {
  info_.driver = kDriver;
  info_.model = "mouse";
  info_.sources = "chosen: a box of 0.3 m";
  info_.workspace_low = Vec3::Constant(-kReach);
  info_.workspace_high = Vec3::Constant(kReach);
  info_.resolution = 1e-4;  // about a pixel
  info_.force_freedoms = 0;
}

void DeviceMouse::set(const MouseInput& input) noexcept {
  if (!input.position.allFinite()) return;
  MouseInput kept = input;
  kept.position = input.position.cwiseMax(-kReach).cwiseMin(kReach);
  kept.pinch = std::isfinite(input.pinch) ? std::clamp(input.pinch, 0.0, 1.0) : 0.0;
  inputs_.put(kept);
}

DeviceSample DeviceMouse::read() noexcept {
  inputs_.fetch();
  const MouseInput& input = inputs_.value();
  DeviceSample sample;
  sample.time = clock_();
  sample.position = input.position;
  sample.buttons = input.buttons;
  sample.pinch = input.pinch;
  return sample;
}

DeviceDriver mouse_driver() {
  return {kDriver, "the mouse of a window, input only", false, probe,
          [](const DeviceRequest&) -> std::unique_ptr<Device> { return std::make_unique<DeviceMouse>(); }};
}

}  // namespace fuai
