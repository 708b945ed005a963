// Whatever goes wrong before it, what goes to the device is finite, bounded, and zero in time.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <random>

#include "fuai/core/error.h"
#include "fuai/haptics/virtual_session.h"
#include "support/allocation_guard.h"
#include "support/lock_guard.h"
#include "wide_open.h"

using namespace fuai;
using namespace fuai_test;

namespace {

/// The limits of a Touch, a wall that it renders, and a hand that presses on it.
struct Bench {
  explicit Bench(double stiffness = 300.0)
      : spec(find_device_preset("touch")),
        options(make_force_path_options(spec.info)),
        path(options),
        wall(stiffness, 0.0, Vec3(0.01, 0.0, 0.0), SpringWall::Answer::kTangent) {}

  /// One tick at a place; the model answers at once unless it is stalled.
  ForceTick tick(const DeviceSample& sample, double dt, bool answers = true) {
    const ToolPose pose = path.follow(sample, dt);
    if (answers) path.models().put(wall.update(pose, dt, dt));
    return path.render();
  }
  static DeviceSample at(const Vec3& position) {
    DeviceSample sample;
    sample.position = position;
    return sample;
  }
  /// Ticks until the ramp is over.
  ForceTick settle(const Vec3& position) {
    ForceTick last;
    for (int i = 0; i < 700; ++i) last = tick(at(position), kTick);
    return last;
  }

  SimulatedDeviceSpec spec;
  ForcePathOptions options;
  ForcePath path;
  SpringWall wall;
};

/// Round-off of a norm that was scaled to a bound.
constexpr double kRounding = 1.0 + 1e-12;

}  // namespace

TEST_SUITE("safety") {
  TEST_CASE("after connecting the force rises within half a second, never faster than 0.1 N a tick") {
    Bench bench;
    const double full = 300.0 * 0.01;  // 3 N
    Vec3 last = Vec3::Zero();
    for (int i = 1; i <= 600; ++i) {
      const ForceTick tick = bench.tick(Bench::at(Vec3::Zero()), kTick);
      CHECK((tick.force - last).norm() <= 0.1 * kRounding);
      CHECK(tick.force.norm() <= full * std::min(1.0, i / 500.0) * (1.0 + 1e-9));
      last = tick.force;
    }
    // The thermal budget has not been touched by then: 3 N for a third of a second against 0.88 N for ten.
    CHECK(last.x() == doctest::Approx(full).epsilon(1e-9));
  }

  TEST_CASE("a cloth that stalls: the force fades and is zero within 100 ms; it comes back slowly") {
    Bench bench;
    bench.settle(Vec3::Zero());
    for (int i = 1; i <= 130; ++i) {
      const ForceTick tick = bench.tick(Bench::at(Vec3::Zero()), kTick, false);
      CHECK(tick.model_age == doctest::Approx(i * kTick));
      if (i != 33) CHECK(((tick.status & kForceModelOld) != 0) == (i > 33));
      if (i <= 50) CHECK(tick.force.x() > 1.0);
      if (i >= 100) CHECK(tick.force == Vec3::Zero());
    }
    for (int i = 1; i <= 100; ++i)
      CHECK(bench.tick(Bench::at(Vec3::Zero()), kTick).force.norm() <= 3.0 * i / 500.0 * (1.0 + 1e-9));
  }

  TEST_CASE("unplugged at any tick, or switched off: no force from that tick on, and the ramp afterwards") {
    const std::uint32_t reasons[] = {kDeviceDisconnected, kDeviceUncalibrated, kDeviceForceOff};
    for (int when : {1, 7, 300, 501, 650}) {
      Bench bench;
      for (int i = 0; i < when; ++i) bench.tick(Bench::at(Vec3::Zero()), kTick);
      DeviceSample away = Bench::at(Vec3::Zero());
      for (int i = 0; i < 6; ++i) {
        away.status = reasons[i % 3];
        const ForceTick tick = bench.tick(away, kTick);
        CHECK(tick.force == Vec3::Zero());
        CHECK((tick.status & kForceDeviceAway) != 0);
      }
      CHECK(bench.tick(Bench::at(Vec3(0.02, 0.0, 0.0)), kTick).force.norm() <= 3.0 / 500.0);
    }
  }

  TEST_CASE("samples that are none: no force in that tick") {
    for (int kind = 0; kind < 6; ++kind) {
      Bench bench;
      bench.settle(Vec3::Zero());
      DeviceSample bad = Bench::at(Vec3::Zero());
      double dt = kTick;
      if (kind == 0) bad.position.y() = NAN;
      if (kind == 1) bad.position.x() = 1e9;
      if (kind == 2) bad.position.x() = 0.03;  // 30 m/s
      if (kind == 3) bad.velocity = Vec3::Constant(1e9);
      if (kind == 4) dt = NAN;
      if (kind == 5) dt = 0.5;  // the loop itself was away
      CAPTURE(kind);
      const ForceTick tick = bench.tick(bad, dt);
      CHECK(tick.force == Vec3::Zero());
      CHECK((tick.status & (kForceSampleBad | kForceLate)) != 0);
      CHECK((tick.status & kForceFaults) == 0);
      CHECK(bench.tick(Bench::at(Vec3::Zero()), kTick).force.norm() <= 3.0 / 500.0);
    }
  }

  TEST_CASE("a broken model latches a fault: no force until the reset") {
    for (int kind = 0; kind < 3; ++kind) {
      Bench bench;
      bench.settle(Vec3::Zero());
      LocalModel broken = begin_model(bench.path.follow(Bench::at(Vec3::Zero()), kTick), 99);
      if (kind == 0) broken.force.x() = NAN;
      if (kind == 1) broken.force.x() = 1e9;
      if (kind == 2) broken.stiffness(1, 1) = INFINITY;
      bench.path.models().put(broken);
      CHECK(bench.path.render().force == Vec3::Zero());
      for (int i = 0; i < 50; ++i) {
        const ForceTick tick = bench.tick(Bench::at(Vec3::Zero()), kTick);
        CHECK(tick.force == Vec3::Zero());
        CHECK((tick.status & kForceFaultModel) != 0);
      }
      bench.path.reset();
      const ForceTick tick = bench.tick(Bench::at(Vec3::Zero()), kTick);
      CHECK(tick.force.norm() > 0.0);
      CHECK(tick.force.norm() <= 3.0 / 500.0);
    }
  }

  TEST_CASE("clutch: no force while it is open, the tool stays, and then it goes on from there") {
    Bench bench;
    bench.settle(Vec3::Zero());
    bench.path.open_clutch(true);
    Vec3 position = Vec3::Zero();
    for (int i = 0; i < 50; ++i) {
      position.y() += 0.0005;
      const ToolPose pose = bench.path.follow(Bench::at(position), kTick);
      CHECK(pose.position == Vec3::Zero());
      CHECK(bench.path.render().force == Vec3::Zero());
    }
    bench.path.open_clutch(false);
    const ToolPose pose = bench.path.follow(Bench::at(position + Vec3(0.0, 0.001, 0.0)), kTick);
    CHECK(pose.position.norm() < 1e-12);
    CHECK(bench.path.render().force.norm() <= 3.0 / 500.0);
  }

  TEST_CASE("power: what a hand is given never exceeds it") {
    SafetyOptions options;
    options.most_power = 0.2;
    options.most_rate = options.most_step = 1e9;
    SafetyLimiter limiter(options);
    std::uint32_t status = 0;
    const Vec3 v(0.3, 0.4, 0.0);
    const Vec3 pushed = limiter.limit(Vec3(2.0, 1.0, 0.5), v, 1.0, kTick, status);
    CHECK(pushed.dot(v) == doctest::Approx(0.2));
    CHECK((status & kForcePowerCut) != 0);
    CHECK((pushed - Vec3(2.0, 1.0, 0.5)).cross(v).norm() < 1e-12);  // only along the motion
    // Against the motion nothing is cut: that takes energy away.
    CHECK(limiter.limit(Vec3(-2.0, -1.0, 0.5), v, 1.0, kTick, status) == Vec3(-2.0, -1.0, 0.5));
  }

  TEST_CASE(
      "fuzz: whatever comes, the force is finite, within the limits, and changes by 0.1 N a tick at most") {
    const double values[] = {NAN, INFINITY, -INFINITY, 1e9, -1e9, 1e300, 0.0};
    for (unsigned seed = 0; seed < 200; ++seed) {
      std::mt19937 random(seed);
      const auto chance = [&](double share) {
        return std::uniform_real_distribution<>(0.0, 1.0)(random) < share;
      };
      const auto wild = [&] { return values[random() % std::size(values)]; };
      Bench bench(std::uniform_real_distribution<>(10.0, 4000.0)(random));
      const double trouble = seed % 2 == 0 ? 0.01 : 0.2;
      Vec3 last = Vec3::Zero();
      double square = 0.0, silence = 0.0;
      bool stalled = false, broken = false;
      for (int i = 0; i < 1500; ++i) {
        if (chance(0.005)) stalled = !stalled;
        // Jitter to 5 ms, and now and then a stall of the loop.
        double dt = std::uniform_real_distribution<>(1e-6, 0.005)(random);
        if (chance(0.1 * trouble)) dt = chance(0.5) ? 0.5 : wild();
        const double passed = std::isfinite(dt) && dt > 0.0 ? std::min(dt, 1.0) : 0.0;
        DeviceSample sample = Bench::at(Vec3(0.03 * std::sin(0.01 * i), 0.02 * std::cos(0.013 * i), 0.0));
        if (chance(trouble)) sample.position[static_cast<int>(random() % 3)] = wild();
        if (chance(trouble)) sample.velocity = Vec3::Constant(wild());
        if (chance(trouble)) sample.status = kDeviceDisconnected;
        const ToolPose pose = bench.path.follow(sample, dt);
        CHECK(pose.position.allFinite());
        LocalModel model = bench.wall.update(pose, kTick, kTick);
        if (chance(0.1 * trouble)) {
          broken = true;
          (chance(0.5) ? model.force : model.origin)[static_cast<int>(random() % 3)] = wild();
        }
        if (!stalled) bench.path.models().put(model);
        silence = stalled ? silence + passed : 0.0;
        const ForceTick tick = bench.path.render();
        REQUIRE(tick.force.allFinite());
        const SafetyOptions& limits = bench.options.safety;
        CHECK(tick.force.norm() <= limits.most_force * kRounding);
        const double step = (tick.force - last).norm();
        // To nothing at once where device, loop or model failed. Where the cap itself comes down the force
        // goes with it: the device's in 50 ms while fading, and while motors are warm by less than another
        // 0.1 N in 5 ms (slope of the cap, 2.4 N over 0.15 N2, by 3.3 N squared for 5 ms of 10 s).
        const double fading = (tick.status & kForceStalled) != 0
                                  ? limits.most_force * passed / (limits.fade_ends - limits.fade_begins)
                                  : 0.0;
        const double warm = (tick.status & (kForceWarm | kForceCut)) != 0 ? 0.1 : 0.0;
        CHECK((tick.force == Vec3::Zero() || step <= (0.1 + fading + warm) * kRounding));
        if (silence >= limits.fade_ends) CHECK(tick.force == Vec3::Zero());
        if (broken && (tick.status & kForceFaults) != 0) CHECK(tick.force == Vec3::Zero());
        // The thermal budget, kept by the test itself.
        square += (1.0 - std::exp(-passed / limits.thermal_time)) * (tick.force.squaredNorm() - square);
        CHECK(square <= limits.continuous_force * limits.continuous_force * (1.0 + 1e-9));
        last = tick.force;
        if (chance(0.002)) bench.path.reset();
      }
    }
  }

  TEST_CASE("options out of range are refused") {
    for (int what = 0; what < 7; ++what) {
      ForcePathOptions options;
      if (what == 0) options.map.scale = 0.0;
      if (what == 1) options.map.force_gain = NAN;
      if (what == 2) options.map.rotation = 2.0 * Mat3::Identity();
      if (what == 3) options.stable_stiffness = 0.0;
      if (what == 4) options.blend = -1.0;
      if (what == 5) options.safety.fade_ends = options.safety.fade_begins;
      if (what == 6) options.passivity.mass = 0.0;
      CHECK_THROWS_AS(ForcePath{options}, Error);
    }
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("a million ticks without an allocation or a lock") {
    SimulatedDeviceSpec spec = find_device_preset("touch");
    Bench bench;
    DeviceSample sample;
    const AllocationGuard guard;
    const LockGuard locks;
    for (int i = 0; i < 1'000'000; ++i) {
      sample.position.x() = 0.02 * std::sin(0.01 * i);
      if (i % 1000 == 999) sample.position.x() = NAN;  // trouble must not allocate either
      bench.tick(sample, kTick, i % 16 == 0);
    }
    const std::size_t taken = locks.count();  // before the test's own
    CHECK(guard.count() == 0);
    CHECK(taken == 0);
    CHECK(bench.path.counters().ticks == 1'000'000);
    CHECK(bench.path.counters().bad_samples >= 1000);
  }
}

TEST_SUITE("determinism") {
  TEST_CASE(
      "jitter to 5 ms: the wall stays stable, late ticks are counted, and the same input gives the same "
      "bits") {
    const auto run = [] {
      const SimulatedDeviceSpec spec = find_device_preset("premium");
      SimulatedDevice device(spec, find_hand_model("arm"),
                             make_reach_motion(Vec3::Zero(), Vec3(0.03, 0.0, 0.0), {0.6, 2.0}));
      ForcePath path(make_force_path_options(spec.info));
      SpringWall wall(400.0, 0.0, Vec3::Zero(), SpringWall::Answer::kTangent);
      VirtualSession session(device, path, wall, {1.0 / 60.0, 1.0 / 60.0, 4000});
      std::mt19937 random(5);
      for (int i = 0; i < 3000; ++i)
        session.tick(i == 1500 ? 0.03 : std::uniform_real_distribution<>(1e-4, 0.005)(random));
      CHECK(path.counters().late == 1);
      CHECK(device.true_position().norm() < 0.002);  // back where it began, at rest
      CHECK(device.true_velocity().norm() < 0.01);
      return device.true_position();
    };
    CHECK(run() == run());
  }
}
