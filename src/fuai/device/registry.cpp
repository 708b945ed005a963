// The list of drivers.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/registry.h"

#include <array>

#include "fuai/core/error.h"
#include "fuai/device/device_simulated.h"

namespace fuai {
namespace {

DriverReport probe_simulated() {
  DriverReport report;
  report.available = true;
  for (const DevicePreset& preset : device_presets()) {
    report.models.emplace_back(preset.name);
    report.findings.push_back({std::string(preset.name), preset.spec.info.model, true});
  }
  return report;
}

std::unique_ptr<Device> open_simulated(const DeviceRequest& request) {
  const SimulatedDeviceSpec& spec =
      request.model.empty() ? device_presets().front().spec : find_device_preset(request.model);
  return std::make_unique<SimulatedDevice>(spec, find_hand_model("arm"), make_still_motion(Vec3::Zero()));
}

}  // namespace

DeviceDriver simulated_driver() {
  return {"simulated", "a computed device with a computed hand", true, probe_simulated, open_simulated};
}

std::span<const DeviceDriver> device_drivers() {
  static const std::array drivers{simulated_driver(), forcedimension_driver(), openhaptics_driver(),
                                  inverse3_driver(),  vrpn_driver(),           spacenav_driver(),
                                  gamepad_driver(),   mouse_driver()};
  return drivers;
}

const DeviceDriver& find_device_driver(std::string_view name) {
  std::string names;
  for (const DeviceDriver& driver : device_drivers()) {
    if (driver.name == name) return driver;
    names += (names.empty() ? "" : ", ") + std::string(driver.name);
  }
  throw Error(ErrorKind::kUsage, "there is no driver '" + std::string(name) + "'", {"", 0, 0, "device"},
              "take one of " + names);
}

std::unique_ptr<Device> open_device(std::string_view name) {
  const std::size_t colon = name.find(':');
  const DeviceDriver& driver = find_device_driver(name.substr(0, colon));
  return driver.open({colon == std::string_view::npos ? "" : std::string(name.substr(colon + 1))});
}

}  // namespace fuai
