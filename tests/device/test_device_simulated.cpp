// The simulated device against what mechanics says of it.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "fuai/core/error.h"
#include "fuai/device/device_simulated.h"
#include "fuai/device/velocity_filter_rt.h"
#include "support/allocation_guard.h"

using namespace fuai;

namespace {

constexpr double kTick = 1e-3;

/// 45 g on a bench: no friction, no encoder, endless room, strong motors.
SimulatedDeviceSpec plain_spec() {
  SimulatedDeviceSpec spec;
  spec.info.mass = 0.045;
  spec.info.peak_force = spec.info.continuous_force = 1e6;
  spec.info.workspace_low = Vec3::Constant(-10.0);
  spec.info.workspace_high = Vec3::Constant(10.0);
  spec.damping = 0.1;
  return spec;
}

SimulatedDevice make_plain(const SimulatedDeviceSpec& spec, const HandModel& hand = {}) {
  return SimulatedDevice(spec, hand, make_still_motion(Vec3::Zero()));
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("viscous damping: speed under a constant force is F/b (1 - exp(-b t / m))") {
    const SimulatedDeviceSpec spec = plain_spec();
    SimulatedDevice device = make_plain(spec);
    device.write({Vec3(0.3, -0.1, 0.2)});
    for (int i = 0; i < 400; ++i) device.advance(kTick);
    const double share = 1.0 - std::exp(-spec.damping * 0.4 / spec.info.mass);
    // First order in the substep: b dt / 2m = 6e-5.
    CHECK((device.true_velocity() - share / spec.damping * Vec3(0.3, -0.1, 0.2)).norm() < 1e-4 * 3.0);
  }

  TEST_CASE("a hand is a damped spring: 5 mm away it swings by the closed form") {
    SimulatedDeviceSpec spec = plain_spec();
    const HandModel arm = find_hand_model("arm");
    SimulatedDevice device = make_plain(spec, arm);
    device.place(Vec3(0.005, 0.0, 0.0));
    const double m = spec.info.mass + arm.mass, c = (spec.damping + arm.damping) / (2.0 * m);
    const double w = std::sqrt(arm.stiffness / m - c * c);
    double worst = 0.0;
    for (int i = 1; i <= 600; ++i) {
      device.advance(kTick);
      const double t = i * kTick;
      const double x = 0.005 * std::exp(-c * t) * (std::cos(w * t) + c / w * std::sin(w * t));
      worst = std::max(worst, std::abs(device.true_position().x() - x));
    }
    // First order in the substep: dampers and springs are off by half of it, 25 us * 37 mm/s = 1 um each.
    CHECK(worst < 2e-6);
  }

  TEST_CASE("Coulomb friction: holds below, slides above with the difference, and stops for good") {
    SimulatedDeviceSpec spec = plain_spec();
    spec.friction = 0.26;
    spec.damping = 0.0;
    SimulatedDevice device = make_plain(spec);
    device.write({Vec3(0.25, 0.0, 0.0)});
    for (int i = 0; i < 100; ++i) device.advance(kTick);
    CHECK(device.true_position() == Vec3::Zero());
    device.write({Vec3(0.36, 0.0, 0.0)});
    for (int i = 0; i < 100; ++i) device.advance(kTick);
    CHECK(device.true_velocity().x() == doctest::Approx(0.1 * 0.1 / 0.045).epsilon(1e-9));
    device.write({Vec3::Zero()});
    for (int i = 0; i < 100; ++i) device.advance(kTick);
    CHECK(device.true_velocity() == Vec3::Zero());
  }

  TEST_CASE("the port's balance: what the motors did is in the motion, the damper took the rest") {
    SimulatedDeviceSpec spec = plain_spec();
    spec.damping = 0.0;
    SimulatedDevice device = make_plain(spec);
    for (int i = 0; i < 500; ++i) {
      device.write({Vec3(std::sin(0.05 * i), 0.3, -0.2 * std::cos(0.02 * i))});
      device.advance(kTick);
    }
    const double kinetic = 0.5 * spec.info.mass * device.true_velocity().squaredNorm();
    // Exact but for rounding of 10,000 substeps.
    CHECK(-device.work_received() == doctest::Approx(kinetic).epsilon(1e-11));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("the program sees the encoder's steps") {
    SimulatedDeviceSpec spec = plain_spec();
    spec.info.resolution = 55e-6;
    SimulatedDevice device = make_plain(spec);
    device.place(Vec3(1.30 * 55e-6, 1.60 * 55e-6, -2.4 * 55e-6));
    CHECK((device.read().position - Vec3(1, 2, -2) * 55e-6).norm() < 1e-15);
  }

  TEST_CASE("saturation, no numbers, timeout, delay and the plug") {
    SimulatedDeviceSpec spec = plain_spec();
    spec.info.peak_force = spec.info.continuous_force = 3.3;
    spec.info.command_timeout = 0.1;
    SUBCASE("saturation keeps the direction") {
      SimulatedDevice device = make_plain(spec);
      device.write({Vec3(30.0, 40.0, 0.0)});
      device.advance(kTick);
      CHECK((device.given_force() - 3.3 * Vec3(0.6, 0.8, 0.0)).norm() < 1e-12);
      CHECK((device.read().status & kDeviceSaturated) != 0);
    }
    SUBCASE("a force that is no number is none") {
      SimulatedDevice device = make_plain(spec);
      device.write({Vec3(1.0, 0.0, 0.0)});
      device.write({Vec3(NAN, 0.0, 0.0)});
      device.advance(kTick);
      CHECK(device.given_force() == Vec3::Zero());
      CHECK(device.true_position().allFinite());
    }
    SUBCASE("without commands the force goes after the timeout") {
      SimulatedDevice device = make_plain(spec);
      device.write({Vec3(1.0, 0.0, 0.0)});
      for (int i = 0; i < 99; ++i) device.advance(kTick);
      CHECK(device.given_force().x() == 1.0);
      for (int i = 0; i < 3; ++i) device.advance(kTick);
      CHECK(device.given_force() == Vec3::Zero());
      CHECK((device.read().status & kDeviceTimedOut) != 0);
    }
    SUBCASE("a delay of three ticks") {
      spec.delay = 3.0 * kTick;
      SimulatedDevice device = make_plain(spec);
      for (int i = 0; i < 10; ++i) {
        device.write({Vec3(0.1 * (i + 1), 0.0, 0.0)});
        device.advance(kTick);
        CHECK(device.given_force().x() == doctest::Approx(i < 3 ? 0.0 : 0.1 * (i - 2)));
      }
    }
    SUBCASE("unplugged: no force, stale samples; plugged in again it goes on") {
      SimulatedDevice device = make_plain(spec);
      device.write({Vec3(1.0, 0.0, 0.0)});
      device.advance(kTick);
      const DeviceSample before = device.read();
      device.set_connected(false);
      device.write({Vec3(1.0, 0.0, 0.0)});
      device.advance(kTick);
      CHECK(device.given_force() == Vec3::Zero());
      CHECK(device.read().status == kDeviceDisconnected);
      CHECK(device.read().position == before.position);
      device.set_connected(true);
      device.write({Vec3(1.0, 0.0, 0.0)});
      device.advance(kTick);
      CHECK(device.given_force().x() == 1.0);
      CHECK(device.read().status == kDeviceReady);
    }
  }

  TEST_CASE("the workspace has walls") {
    SimulatedDeviceSpec spec = plain_spec();
    spec.info.workspace_low = Vec3::Constant(-0.05);
    spec.info.workspace_high = Vec3::Constant(0.05);
    SimulatedDevice device = make_plain(spec);
    device.write({Vec3(1.0, 0.0, 0.0)});
    for (int i = 0; i < 1000; ++i) device.advance(kTick);
    CHECK(device.true_position().x() == 0.05);
    CHECK(device.true_velocity().x() == 0.0);
  }

  TEST_CASE("motors warm: the mean square never exceeds the continuous force, and it is reached") {
    MotorHeat heat(8.5, 1.4, 10.0);
    CHECK(heat.most_force() == 8.5);
    double most = 0.0;
    for (int i = 0; i < 60'000; ++i) {
      heat.advance(heat.most_force(), kTick);
      most = std::max(most, heat.used());
    }
    CHECK(most <= 1.0);
    CHECK(most > 0.99);
    CHECK(heat.most_force() == doctest::Approx(1.4).epsilon(0.01));  // from above, as used() comes to 1
    // By then 0.8 Fc^2 = F^2 (1 - exp(-t / tau)): the peak lasts 0.22 s.
    MotorHeat cold(8.5, 1.4, 10.0);
    int ticks = 0;
    while (cold.most_force() >= 8.5) {
      cold.advance(8.5, kTick);
      ++ticks;
    }
    CHECK(ticks == doctest::Approx(-10.0e3 * std::log(1.0 - 0.8 * 1.96 / 72.25)).epsilon(0.01));
  }

  TEST_CASE("velocity of a steady motion is met within three time constants; without time nothing changes") {
    VelocityFilter filter(100.0);
    for (int i = 0; i <= 5; ++i) filter.update(Vec3(0.2 * i * kTick, 0.0, 0.0), kTick);
    // 1 - exp(-5 * 2 pi 0.1) = 0.957.
    CHECK(filter.velocity().x() == doctest::Approx(0.2 * (1.0 - std::exp(-std::numbers::pi))).epsilon(1e-9));
    const Vec3 before = filter.velocity();
    CHECK(filter.update(Vec3(5.0, 0.0, 0.0), 0.0) == before);
    filter.restart();
    CHECK(filter.update(Vec3(5.0, 0.0, 0.0), kTick) == Vec3::Zero());
    CHECK(filter.update(Vec3(5.0, 0.0, 0.0), kTick) == Vec3::Zero());
  }

  TEST_CASE("numbers out of range are refused") {
    for (int what = 0; what < 5; ++what) {
      SimulatedDeviceSpec spec = plain_spec();
      if (what == 0) spec.info.mass = 0.0;
      if (what == 1) spec.delay = 0.1;
      if (what == 2) spec.friction = -1.0;
      if (what == 3) spec.info.workspace_high = spec.info.workspace_low;
      if (what == 4) spec.info.peak_force = NAN;
      CHECK_THROWS_AS(make_plain(spec), Error);
    }
  }
}

TEST_SUITE("determinism+realtime") {
  TEST_CASE("every preset with every hand: same bits twice, finite, nothing allocated") {
    for (const DevicePreset& preset : device_presets()) {
      for (const HandModel& hand : hand_models()) {
        CAPTURE(std::string(preset.name) + ", " + std::string(hand.name));
        const auto end_of = [&] {
          SimulatedDevice device(
              preset.spec, hand,
              make_chirp_motion(Vec3::Zero(), Vec3(0.02, 0.0, -0.01), {0.0, 0.3}, 0.2, 5.0));
          const fuai_test::AllocationGuard guard;
          for (int i = 0; i < 300; ++i) {
            const DeviceSample sample = device.read();
            device.write({-50.0 * sample.position});
            device.advance(1.0 / preset.spec.info.rate);
          }
          CHECK(guard.count() == 0);
          CHECK(device.true_position().allFinite());
          return device.true_position();
        };
        CHECK(end_of() == end_of());
      }
    }
  }
}
