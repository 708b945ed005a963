// The list of drivers and the presets of the simulated one.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <string>

#include "fuai/core/error.h"
#include "fuai/device/device_simulated.h"
#include "fuai/device/registry.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("every driver says whether it is available, and if not, why and what to do") {
    CHECK(device_drivers().front().name == "simulated");
    for (const DeviceDriver& driver : device_drivers()) {
      CAPTURE(std::string(driver.name));
      const DriverReport report = driver.probe();
      CHECK(!driver.description.empty());
      CHECK(report.available == report.why_not.empty());
      CHECK((report.available || !report.cure.empty()));
      CHECK(!report.findings.empty());
    }
  }

  TEST_CASE("devices open by driver and model; wrong names list the right ones") {
    CHECK(open_device("simulated")->info().model == "PHANToM Premium 1.5");
    for (const std::string& model : find_device_driver("simulated").probe().models)
      CHECK(open_device("simulated:" + model)->info().driver == "simulated");
    CHECK(open_device("simulated:touch")->info().peak_force == 3.3);
    for (const char* wrong : {"simulated:glove", "phantom", "", "forcedimension:glove"}) {
      try {
        open_device(wrong);
        FAIL("opened");
      } catch (const Error& e) {
        CHECK(e.kind() == ErrorKind::kUsage);
        CHECK(e.cure().find("take one of") == 0);
      }
    }
  }

  TEST_CASE("presets: six devices whose numbers hang together") {
    REQUIRE(device_presets().size() == 6);
    for (const DevicePreset& preset : device_presets()) {
      CAPTURE(std::string(preset.name));
      const DeviceInfo& info = preset.spec.info;
      CHECK(info.continuous_force <= info.peak_force);
      CHECK(info.stable_stiffness * info.resolution < info.peak_force);  // a wall is more than one step deep
      CHECK(info.rate >= 1000.0);
      CHECK(!info.sources.empty());
      CHECK_NOTHROW(SimulatedDevice(preset.spec, find_hand_model("none"), make_still_motion(Vec3::Zero())));
    }
  }
}
