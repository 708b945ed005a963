// The OpenHaptics driver against a library with the vendor's names: axes, units, frames, every fault.
// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <string>
#include <thread>

#include "fakes/fake_clock.h"
#include "fakes/fake_hd.h"
#include "fakes/scoped_variable.h"
#include "fuai/core/error.h"
#include "fuai/device/device_openhaptics.h"
#include "fuai/device/device_simulated.h"
#include "fuai/device/hd_api.h"
#include "support/allocation_guard.h"

using namespace fuai;
using namespace fuai_test;

namespace {

const std::string kFakes = FUAI_FAKES;

/// The fake in its first state; a loop of ours and the vendor's take turns.
struct Bench {
  Bench() : variable(kHdLibraryVariable, kFakes + "libfake_hd.so") {
    void* const handle = ::dlopen((kFakes + "libfake_hd.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    REQUIRE(handle != nullptr);
    const auto access = reinterpret_cast<FakeHdAccess>(::dlsym(handle, "fake_hd"));
    vendor_tick = reinterpret_cast<FakeHdTick>(::dlsym(handle, "fake_hd_tick"));
    REQUIRE((access && vendor_tick));
    fake = access();
    *fake = FakeHd{};
    fake_now = 100.0;
  }
  ~Bench() { CHECK(fake->misuses == 0); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  std::unique_ptr<DeviceOpenHaptics> open(const std::string& name = "") {
    return std::make_unique<DeviceOpenHaptics>(name, fake_clock);
  }
  /// A millisecond: we command, the vendor ticks, we read.
  DeviceSample step(DeviceOpenHaptics& device, const Vec3& force) {
    device.write({force});
    fake_now += 1e-3;
    vendor_tick();
    return device.read();
  }
  Vec3 force(int i = 0) const {
    const double* const f = fake->devices[i].force;
    return {f[0], f[1], f[2]};
  }
  ScopedVariable variable;
  FakeHd* fake = nullptr;
  FakeHdTick vendor_tick = nullptr;
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("openhaptics: millimetres and axes, x right, y up, z towards the user") {
    Bench bench;
    FakeHdDevice& device = bench.fake->devices[0];
    const auto touch = bench.open();
    CHECK(bench.fake->rate == 1000);
    const double position[3] = {10, 20, 30}, velocity[3] = {100, 200, 300};
    std::copy_n(position, 3, device.position);
    std::copy_n(velocity, 3, device.velocity);
    device.buttons = 2;
    CHECK(touch->read().status == kDeviceDisconnected);  // before the vendor's first tick
    const DeviceSample sample = bench.step(*touch, Vec3(0.1, 0.2, 0.3));
    CHECK(sample.status == kDeviceReady);
    // Rounding of one product.
    CHECK((sample.position - Vec3(0.01, -0.03, 0.02)).norm() < 1e-17);
    CHECK((sample.velocity - Vec3(0.1, -0.3, 0.2)).norm() < 1e-16);
    CHECK(sample.orientation == Mat3::Identity());
    CHECK(sample.buttons == 2);
    CHECK(sample.time == fake_now);
    CHECK(bench.force() == Vec3(0.1, 0.3, -0.2));
  }

  TEST_CASE(
      "openhaptics: a quarter turn of the stylus about the vendor's y, which is up, is one about our z") {
    Bench bench;
    const auto touch = bench.open();
    // Columns: x to -z, y stays, z to x.
    const double transform[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1};
    std::copy_n(transform, 16, bench.fake->devices[0].transform);
    Mat3 expected;
    expected << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    CHECK(bench.step(*touch, Vec3::Zero()).orientation == expected);
  }

  TEST_CASE("openhaptics: the vendor's numbers, and those of the model where it has none") {
    Bench bench;
    {
      const auto touch = bench.open();
      CHECK(touch->info().model == "Touch");
      CHECK(touch->info().peak_force == 3.1);
      CHECK(touch->info().continuous_force == 0.8);
      CHECK(touch->info().stable_stiffness == find_device_preset("touch").info.stable_stiffness);
      CHECK((touch->info().workspace_low - Vec3(-0.08, -0.04, -0.06)).norm() < 1e-16);
      CHECK((touch->info().workspace_high - Vec3(0.08, 0.035, 0.06)).norm() < 1e-16);
    }
    bench.fake->devices[0].model = "PHANTOM Premium 1.5";
    CHECK(bench.open()->info().stable_stiffness == find_device_preset("premium").info.stable_stiffness);
  }

  TEST_CASE("openhaptics: names are tried in their order; two devices share the scheduler") {
    Bench bench;
    bench.fake->count = 2;
    bench.fake->devices[0].name = "Default PHANToM";
    bench.fake->devices[1].name = "left";
    const auto right = bench.open();
    auto left = bench.open("left");
    CHECK(bench.fake->callbacks == 2);
    left->write({Vec3(0.5, 0.0, 0.0)});
    bench.step(*right, Vec3(0.0, 0.0, 0.25));
    CHECK(bench.force(0) == Vec3(0.0, 0.25, 0.0));
    CHECK(bench.force(1) == Vec3(0.5, 0.0, 0.0));
    left.reset();
    CHECK(bench.force(1) == Vec3::Zero());
    CHECK(bench.fake->scheduler_runs);
    CHECK(bench.step(*right, Vec3::Zero()).status == kDeviceReady);
  }

  TEST_CASE("openhaptics: what --diagnose says") {
    const auto report_of = [](const std::string& file) {
      const ScopedVariable variable(kHdLibraryVariable, kFakes + file);
      return openhaptics_driver().probe();
    };
    CHECK(report_of("libfake_hd.so").available);
    CHECK(report_of("libfake_hd_broken.so").why_not == "the vendor's library has no hdUpdateCalibration");
    CHECK(report_of("libfake_needs_part.so").why_not ==
          "the vendor's library needs libfake_missing_part.so.4, which is missing");
    const DriverReport none = report_of("nowhere.so");
    CHECK(none.why_not.find("cannot open shared object file") != std::string::npos);
    CHECK(none.cure.find("FUAI_HD_LIBRARY") != std::string::npos);
    bool usb = false, node = false, names = false;
    for (const DriverFinding& finding : none.findings) {
      usb = usb || finding.what.find("USB") == 0;
      node = node || finding.what == "device node";
      names = names || finding.found == "'Default Device', 'Default PHANToM', the default";
    }
    CHECK((usb && node && names));
  }
}

TEST_SUITE("safety") {
  TEST_CASE("openhaptics: a device that is lost does not take the other along") {
    Bench bench;
    bench.fake->count = 2;
    bench.fake->devices[1].name = "left";
    const auto right = bench.open("Default Device"), left = bench.open("left");
    const Vec3 pull(0.5, 0.0, 0.0);
    bench.fake->devices[0].plugged = false;
    for (int i = 0; i < 3; ++i) {
      left->write({pull});
      CHECK(bench.step(*right, pull).status == kDeviceDisconnected);
      CHECK(left->read().status == kDeviceReady);
    }
    CHECK(bench.force(1) == pull);
  }

  TEST_CASE("openhaptics: what cannot be opened says so in the vendor's words") {
    Bench bench;
    const auto problem = [&](const std::string& name) -> std::string {
      try {
        bench.open(name);
      } catch (const Error& e) {
        CHECK(e.kind() == ErrorKind::kNoDevice);
        CHECK(!e.cure().empty());
        return e.problem();
      }
      return "opened";
    };
    CHECK(problem("right") ==
          "OpenHaptics opens no device: 'right': Device fault (error 0x300, internal -7)");
    bench.fake->next_error = 0x204;
    CHECK(problem("Default Device").find("could not be switched on") != std::string::npos);
    CHECK(!bench.fake->devices[0].open);
    bench.fake->count = 0;
    CHECK(
        problem("").find("'Default Device': Device fault (error 0x300, internal -7); 'Default PHANToM': ") !=
        std::string::npos);
    CHECK(!bench.fake->scheduler_runs);
  }

  TEST_CASE("openhaptics: warm motors and limits: half a second without force, told, then it goes on") {
    for (const unsigned code : {0x200u, 0x201u, 0x202u, 0x203u, 0x204u}) {
      CAPTURE(code);
      Bench bench;
      const auto touch = bench.open();
      const Vec3 pull(1.0, 0.0, 0.0);
      bench.step(*touch, pull);
      CHECK(bench.force() == pull);
      bench.fake->next_error = code;
      const std::uint32_t told = kDeviceForceOff | (code == 0x200u ? kDeviceWarm : kDeviceReady);
      CHECK(bench.step(*touch, pull).status == told);
      for (int i = 0; i < 499; ++i) {
        CHECK(bench.step(*touch, pull).status == told);
        CHECK(bench.force() == Vec3::Zero());
      }
      bench.step(*touch, pull);
      CHECK(bench.step(*touch, pull).status == kDeviceReady);
      CHECK(bench.force() == pull);
      CHECK(bench.fake->devices[0].opened == 1);
    }
  }

  TEST_CASE("openhaptics: every other error is the end; the device is opened again half a second later") {
    for (const unsigned code : {0x100u, 0x101u, 0x102u, 0x103u, 0x104u, 0x300u, 0x301u, 0x302u, 0x303u,
                                0x304u, 0x400u, 0x401u, 0x402u, 0x500u, 0x501u, 0x600u, 0xABCDu}) {
      CAPTURE(code);
      Bench bench;
      const auto touch = bench.open();
      bench.fake->devices[0].position[0] = 10.0;
      const Vec3 pull(1.0, 0.0, 0.0);
      bench.step(*touch, pull);
      bench.fake->next_error = code;
      const DeviceSample lost = bench.step(*touch, pull);
      CHECK(lost.status == kDeviceDisconnected);
      CHECK(lost.position.x() == doctest::Approx(0.01).epsilon(1e-15));
      CHECK(bench.force() == Vec3::Zero());
      CHECK(bench.fake->callbacks == 0);
      fake_now += 0.4;
      CHECK(bench.step(*touch, pull).status == kDeviceDisconnected);
      fake_now += 0.2;
      touch->read();  // opens it
      CHECK(bench.step(*touch, pull).status == kDeviceReady);
      CHECK(bench.force() == pull);
      CHECK(bench.fake->devices[0].opened == 2);
    }
  }

  TEST_CASE("openhaptics: unplugged and back, also while the scheduler hangs") {
    Bench bench;
    const auto touch = bench.open();
    const Vec3 pull(1.0, 0.0, 0.0);
    bench.step(*touch, pull);
    bench.fake->devices[0].plugged = false;
    CHECK(bench.step(*touch, pull).status == kDeviceDisconnected);
    for (int i = 0; i < 5; ++i) {
      fake_now += 0.6;
      CHECK(bench.step(*touch, pull).status == kDeviceDisconnected);
    }
    bench.fake->devices[0].plugged = true;
    fake_now += 0.6;
    touch->read();
    CHECK(bench.force() == Vec3::Zero());
    CHECK(bench.step(*touch, pull).status == kDeviceReady);
    bench.fake->frozen = true;
    for (int i = 0; i < 100; ++i) bench.step(*touch, pull);
    CHECK(bench.step(*touch, pull).status == kDeviceDisconnected);
    CHECK(bench.force() == Vec3::Zero());
    bench.fake->frozen = false;
    fake_now += 0.6;
    touch->read();
    CHECK(bench.step(*touch, pull).status == kDeviceReady);
  }

  TEST_CASE("openhaptics: when our loop stands still, the vendor's lets go after a tenth of a second") {
    Bench bench;
    const auto touch = bench.open();
    bench.step(*touch, Vec3(1.0, 0.0, 0.0));
    for (int i = 1; i <= 110; ++i) {
      fake_now += 1e-3;
      bench.vendor_tick();
      if (i < 99) CHECK(bench.force().x() == 1.0);
      if (i > 100) CHECK(bench.force() == Vec3::Zero());
    }
    CHECK(touch->read().status == kDeviceTimedOut);
    CHECK(bench.step(*touch, Vec3(1.0, 0.0, 0.0)).status == kDeviceReady);
  }

  TEST_CASE("openhaptics: not calibrated: no force; what the vendor can do by itself is asked for") {
    Bench bench;
    FakeHdDevice& device = bench.fake->devices[0];
    device.calibration = kHdCalibrationNeedsManualInput;
    const auto touch = bench.open();
    for (int i = 0; i < 3; ++i) {
      CHECK(bench.step(*touch, Vec3(1.0, 0.0, 0.0)).status == kDeviceUncalibrated);
      CHECK(bench.force() == Vec3::Zero());
    }
    device.calibration = kHdCalibrationNeedsUpdate;
    for (int i = 0; i < 101; ++i) bench.step(*touch, Vec3::Zero());
    CHECK(device.calibration_updates == 1);
    CHECK(bench.step(*touch, Vec3::Zero()).status == kDeviceReady);
  }

  TEST_CASE("openhaptics: too much is cut, no number is none, closing leaves no force") {
    Bench bench;
    auto touch = bench.open();
    CHECK(bench.step(*touch, Vec3(0.0, 1e9, 0.0)).status == kDeviceSaturated);
    CHECK(bench.force().norm() == doctest::Approx(3.1).epsilon(1e-15));
    bench.step(*touch, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    CHECK(bench.force() == Vec3::Zero());
    bench.step(*touch, Vec3(1.0, 0.0, 0.0));
    touch.reset();
    CHECK(bench.force() == Vec3::Zero());
    CHECK(!bench.fake->scheduler_runs);
    CHECK(bench.fake->callbacks == 0);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("openhaptics: nothing is torn between the vendor's thread and ours") {
    Bench bench;
    FakeHdDevice& device = bench.fake->devices[0];
    const auto touch = bench.open();  // its clock stands: nothing is stale, however seldom a thread runs
    constexpr int kTicks = 20000;
    std::atomic<bool> done = false;
    int torn_forces = 0;
    std::thread vendor([&] {
      for (int i = 1; i <= kTicks; ++i) {
        std::fill_n(device.position, 3, static_cast<double>(i % 64));
        bench.vendor_tick();
        if (device.force[0] != device.force[1] || device.force[0] != -device.force[2]) ++torn_forces;
      }
      done = true;
    });
    int torn_samples = 0;
    for (int i = 0; !done; ++i) {
      const Vec3 place = touch->read().position;
      if (place.x() != -place.y() || place.x() != place.z()) ++torn_samples;
      const double size = 1e-3 * (i % 1000);
      touch->write({Vec3(size, size, size)});
    }
    vendor.join();
    CHECK(torn_forces == 0);
    CHECK(torn_samples == 0);
    // The last tick's place has come: 20000 % 64 = 32 mm; rounding of one product.
    CHECK(touch->read().position.x() == doctest::Approx(0.032).epsilon(1e-15));
  }

  TEST_CASE("openhaptics: both loops allocate nothing, also when a device is lost and found") {
    Bench bench;
    const auto touch = bench.open();
    const AllocationGuard guard;
    for (int i = 0; i < 2000; ++i) {
      bench.fake->devices[0].plugged = i < 300 || i > 1000;
      bench.step(*touch, Vec3(1.0, 0.0, 0.0));
    }
    CHECK(guard.count() == 0);
    CHECK(touch->read().status == kDeviceReady);
  }
}
