// The Force Dimension driver against a library with the vendor's names: axes, units, every fault.
// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "fakes/fake_clock.h"
#include "fakes/fake_dhd.h"
#include "fakes/scoped_variable.h"
#include "fuai/core/error.h"
#include "fuai/device/device_forcedimension.h"
#include "fuai/device/device_simulated.h"
#include "support/allocation_guard.h"

using namespace fuai;
using namespace fuai_test;

namespace {

const std::string kFakes = FUAI_FAKES;

/// The fake in its first state, chosen as the vendor's library.
struct Bench {
  explicit Bench(const char* file = "libfake_drd.so") : variable(kDhdLibraryVariable, kFakes + file) {
    void* const handle = ::dlopen((kFakes + file).c_str(), RTLD_NOW | RTLD_LOCAL);
    REQUIRE(handle != nullptr);
    const auto access = reinterpret_cast<FakeDhdAccess>(::dlsym(handle, "fake_dhd"));
    REQUIRE(static_cast<bool>(access));
    fake = access();
    *fake = FakeDhd{};
    fake_now = 100.0;
  }
  std::unique_ptr<DeviceForceDimension> open(const std::string& model = "") {
    return std::make_unique<DeviceForceDimension>(model, fake_clock);
  }
  Vec3 force(int i = 0) const {
    const double* const f = fake->devices[i].force;
    return {f[0], f[1], f[2]};
  }
  ScopedVariable variable;
  FakeDhd* fake = nullptr;
};

Error open_error(Bench& bench, const std::string& model = "") {
  try {
    bench.open(model);
  } catch (const Error& e) {
    return e;
  }
  FAIL("opened");
  return Error(ErrorKind::kUsage, "");
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("forcedimension: axes are turned, x towards the user, y right, z up") {
    Bench bench;
    FakeDhdDevice& device = bench.fake->devices[0];
    const auto omega = bench.open();
    CHECK(device.forces_on);
    const double position[3] = {0.01, 0.02, 0.03}, velocity[3] = {0.1, 0.2, 0.3};
    std::copy_n(position, 3, device.position);
    std::copy_n(velocity, 3, device.velocity);
    device.buttons = 5;
    const DeviceSample sample = omega->read();
    CHECK(sample.position == Vec3(0.02, -0.01, 0.03));
    CHECK(sample.velocity == Vec3(0.2, -0.1, 0.3));
    CHECK(sample.buttons == 5);
    CHECK(sample.status == kDeviceReady);
    omega->write({Vec3(1.0, 2.0, 3.0)});
    CHECK(bench.force() == Vec3(-2.0, 1.0, 3.0));
  }

  TEST_CASE("forcedimension: a wrist's turn is turned with the axes, a gripper pinches") {
    Bench bench;
    FakeDhdDevice& device = bench.fake->devices[0];
    device.type = 35;
    const auto omega = bench.open("omega.7");
    CHECK(omega->read().orientation == Mat3::Identity());
    CHECK(omega->read().pinch == 0.0);
    // A quarter about the device's x, which points to the user: about our minus y.
    const double frame[3][3] = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    std::copy_n(&frame[0][0], 9, &device.frame[0][0]);
    device.gap = 0.0;
    Mat3 expected;
    expected << 0, 0, -1, 0, 1, 0, 1, 0, 0;
    CHECK(omega->read().orientation == expected);
    CHECK(omega->read().pinch == 1.0);
  }

  TEST_CASE("forcedimension: numbers of the device, lowered by a limit of the user's") {
    Bench bench;
    bench.fake->devices[0].max_force = 2.5;
    const auto omega = bench.open("omega.3");
    const DeviceInfo& preset = find_device_preset("omega.3").info;
    CHECK(omega->info().driver == "forcedimension");
    CHECK(omega->info().model == "fake device");
    CHECK(omega->info().stable_stiffness == preset.stable_stiffness);
    CHECK(omega->info().peak_force == 2.5);
    CHECK(omega->info().continuous_force == 2.5);
    bench.fake->devices[0] = FakeDhdDevice{};
    bench.fake->devices[0].type = 60;
    CHECK(bench.open("falcon")->info().peak_force == find_device_preset("falcon").info.peak_force);
    bench.fake->devices[0].type = 12345;  // one that came later
    CHECK(bench.open()->info().peak_force == 5.0);
  }

  TEST_CASE("forcedimension: two devices, each by its number or its model") {
    Bench bench;
    bench.fake->count = 2;
    bench.fake->devices[1].type = 63;
    const auto omega = bench.open("0"), delta = bench.open("delta.3");
    CHECK(delta->info().peak_force == 20.0);
    delta->write({Vec3(0.0, 0.0, 1.0)});
    CHECK(bench.force(0) == Vec3::Zero());
    CHECK(bench.force(1) == Vec3(0.0, 0.0, 1.0));
    CHECK(bench.fake->wrong_ids == 0);
  }

  TEST_CASE("forcedimension: what --diagnose says") {
    const auto found = [](const DriverReport& report, const std::string& what) -> std::string {
      for (const DriverFinding& finding : report.findings)
        if (finding.what.find(what) != std::string::npos) return finding.found;
      return "";
    };
    {
      Bench bench;
      const DriverReport report = forcedimension_driver().probe();
      CHECK(report.available);
      CHECK(found(report, "libfake_drd.so") == "found");
      CHECK(found(report, "SDK version") == "3.17.6.0");
      CHECK(found(report, "sees") == "1");
      CHECK(!bench.fake->devices[0].open);
      bench.fake->count = 0;
      const DriverReport none = forcedimension_driver().probe();
      CHECK(none.why_not == "the vendor's library sees no device: no device found");
      CHECK(!none.cure.empty());
    }
    {
      const ScopedVariable variable(kDhdLibraryVariable, kFakes + "libfake_dhd_broken.so");
      CHECK(forcedimension_driver().probe().why_not == "the vendor's library has no dhdSetForce");
    }
    {
      const ScopedVariable variable(kDhdLibraryVariable, kFakes + "libfake_needs_part.so");
      const DriverReport report = forcedimension_driver().probe();
      CHECK(report.why_not == "the vendor's library needs libfake_missing_part.so.4, which is missing");
    }
    {
      const ScopedVariable variable(kDhdLibraryVariable, kFakes + "nowhere.so");
      const DriverReport report = forcedimension_driver().probe();
      CHECK(report.why_not.find("nowhere.so: cannot open shared object file") != std::string::npos);
      CHECK(report.cure.find("FUAI_DHD_LIBRARY") != std::string::npos);
      CHECK_THROWS_AS(DeviceForceDimension("", fake_clock), Error);
    }
    const DriverReport report = forcedimension_driver().probe();  // no such machine has the vendor's library
    for (const char* name : {"libdrd.so", "libdhd.so"}) CHECK(found(report, name).find(name) == 0);
  }
}

TEST_SUITE("safety") {
  TEST_CASE("forcedimension: what cannot be opened says so in the vendor's words") {
    Bench bench;
    bench.fake->failing = kFakeDhdOpen;
    Error error = open_error(bench);
    CHECK(error.kind() == ErrorKind::kNoDevice);
    CHECK(error.problem().find("device 0: injected error") != std::string::npos);
    CHECK(!error.cure().empty());
    for (const unsigned call : {kFakeDhdEnableForce, kFakeDhdSetForce}) {
      bench.fake->failing = call;
      CHECK(open_error(bench).problem().find("injected error") != std::string::npos);
      CHECK(!bench.fake->devices[0].open);
    }
    bench.fake->failing = 0;
    CHECK(open_error(bench, "delta.3").problem().find("device 0 is of type omega.3 (33)") !=
          std::string::npos);
    CHECK(open_error(bench, "glove").kind() == ErrorKind::kUsage);
    bench.fake->count = 0;
    CHECK(open_error(bench).problem().find("no device found") != std::string::npos);
  }

  TEST_CASE("forcedimension: any call that fails takes the force off, and the device comes back") {
    for (const unsigned call : {kFakeDhdGetPosition, kFakeDhdSetForce, kFakeDhdGetStatus,
                                kFakeDhdGetOrientation, kFakeDhdGetGripper}) {
      CAPTURE(call);
      Bench bench;
      FakeDhdDevice& device = bench.fake->devices[0];
      device.type = 35;
      const auto omega = bench.open();
      device.position[1] = 0.01;
      CHECK(omega->read().status == kDeviceReady);
      omega->write({Vec3(1.0, 0.0, 0.0)});
      bench.fake->failing = call;
      // The status is asked for every 50th time.
      for (int i = 0; i < 50; ++i) {
        omega->read();
        omega->write({Vec3(1.0, 0.0, 0.0)});
      }
      const DeviceSample lost = omega->read();
      CHECK(lost.status == kDeviceDisconnected);
      CHECK(lost.position == Vec3(0.01, 0.0, 0.0));
      CHECK(bench.force() == Vec3::Zero());
      CHECK(!device.forces_on);
      // Back after half a second, not sooner, with no force until there is a command.
      bench.fake->failing = 0;
      fake_now += 0.4;
      CHECK(omega->read().status == kDeviceDisconnected);
      fake_now += 0.2;
      CHECK(omega->read().status == kDeviceReady);
      CHECK(bench.force() == Vec3::Zero());
      omega->write({Vec3(1.0, 0.0, 0.0)});
      CHECK(bench.force() == Vec3(0.0, 1.0, 0.0));
      CHECK(device.opened == 2);
    }
  }

  TEST_CASE("forcedimension: unplugged and plugged in again; another device in its place is not taken") {
    Bench bench;
    FakeDhdDevice& device = bench.fake->devices[0];
    const auto omega = bench.open();
    omega->write({Vec3(1.0, 0.0, 0.0)});
    device.plugged = false;
    CHECK(omega->read().status == kDeviceDisconnected);
    fake_now += 1.0;
    CHECK(omega->read().status == kDeviceDisconnected);
    device.plugged = true;
    device.type = 60;
    fake_now += 1.0;
    CHECK(omega->read().status == kDeviceDisconnected);
    CHECK(!device.open);
    device.type = 33;
    fake_now += 1.0;
    CHECK(omega->read().status == kDeviceReady);
    CHECK(bench.force() == Vec3::Zero());
  }

  TEST_CASE("forcedimension: old data and clipping are no errors; too much and NaN are cut") {
    Bench bench;
    bench.fake->too_early = true;
    const auto omega = bench.open();
    CHECK(omega->read().status == kDeviceReady);
    bench.fake->clips_at = 2.0;
    omega->write({Vec3(3.0, 0.0, 0.0)});
    CHECK(omega->read().status == kDeviceSaturated);
    omega->write({Vec3(1.0, 0.0, 0.0)});
    CHECK(omega->read().status == kDeviceReady);
    bench.fake->clips_at = 1e9;
    omega->write({Vec3(1e9, 0.0, 0.0)});
    CHECK(bench.force().norm() == doctest::Approx(12.0).epsilon(1e-15));
    CHECK(omega->read().status == kDeviceSaturated);
    omega->write({Vec3(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0)});
    CHECK(bench.force() == Vec3::Zero());
    bench.fake->devices[0].position[0] = std::numeric_limits<double>::quiet_NaN();
    CHECK(omega->read().status == kDeviceDisconnected);
  }

  TEST_CASE("forcedimension: forces switched off and lost calibration are told; no velocity is no number") {
    Bench bench;
    FakeDhdDevice& device = bench.fake->devices[0];
    const auto omega = bench.open();
    device.force_off_cause = 1;  // its button
    bench.fake->failing = kFakeDhdGetVelocity;
    for (int i = 0; i < 50; ++i) omega->read();
    CHECK(omega->read().status == kDeviceForceOff);
    CHECK(std::isnan(omega->read().velocity.x()));
    device.force_off_cause = 0;
    device.initialized = false;
    for (int i = 0; i < 50; ++i) omega->read();
    CHECK(omega->read().status == kDeviceUncalibrated);
  }

  TEST_CASE("forcedimension: closing leaves no force, with libdhd alone too") {
    for (const char* file : {"libfake_drd.so", "libfake_dhd.so"}) {
      Bench bench(file);
      auto omega = bench.open();
      omega->write({Vec3(1.0, 0.0, 0.0)});
      CHECK(bench.force().norm() == 1.0);
      omega.reset();
      CHECK(bench.force() == Vec3::Zero());
      CHECK(!bench.fake->devices[0].forces_on);
      CHECK(!bench.fake->devices[0].open);
    }
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("forcedimension: reading, writing, losing and finding again allocate nothing") {
    Bench bench;
    const auto omega = bench.open();
    const AllocationGuard guard;
    for (int i = 0; i < 1000; ++i) {
      bench.fake->devices[0].plugged = i < 300 || i > 600;
      fake_now += 0.01;
      omega->read();
      omega->write({Vec3(1.0, 0.0, 0.0)});
    }
    CHECK(guard.count() == 0);
    CHECK(omega->read().status == kDeviceReady);
  }
}
