// A device as a hand of the viewer: to the bit, unplugged, without force, on its own threads.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/device_hand.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <thread>

#include "fuai/core/error.h"
#include "fuai/device/device_simulated.h"
#include "support/allocation_guard.h"
#include "viewer/small_table.h"

using namespace fuai;
using namespace fuai_test;

namespace {

class Always final : public HoldRule {
 public:
  explicit Always(bool& flag) : flag_(flag) {}
  bool holds(std::size_t /*hand*/, double /*time*/, const DeviceSample& last) noexcept override {
    return flag_ && (last.status & kDeviceDisconnected) == 0;
  }

 private:
  bool& flag_;
};

/// A simulated Touch whose hand stays, on a small hanging sheet, in virtual time.
struct Bench {
  Bench() : cloths(cloths_of(small_setup())), session(cloths) {
    const SimulatedDeviceSpec& spec = find_device_preset("touch");
    auto made =
        std::make_unique<SimulatedDevice>(spec, find_hand_model("none"), make_still_motion(Vec3::Zero()));
    device = made.get();
    hand = std::make_unique<DeviceHand>(HandDevice{std::move(made), std::make_unique<Always>(wants), true},
                                        session, DeviceHand::Time::kVirtual);
    hand->begin(cloths->scene(0).view);
    map = fit_workspace(cloths->scene(0).view, spec.info);
    session.play(true);
  }
  /// @param at where the hand is put at every tick; none: where the device goes
  void ticks(int count, const Vec3* at = nullptr) {
    for (int i = 0; i < count; ++i) {
      if (at != nullptr) device->place(map.to_device(*at));
      hand->tick(wall_us += 1000.0);
    }
  }
  bool holds() const { return session.device_touch().reading.holds; }

  std::shared_ptr<ViewCloths> cloths;
  ViewSession session;
  SimulatedDevice* device = nullptr;
  std::unique_ptr<DeviceHand> hand;
  WorkspaceMap map;
  bool wants = true;
  double wall_us = 0.0;
};

/// Where the sheet's lower edge hangs after a while, about.
Vec3 low_edge(Bench& bench) {
  bench.wants = false;
  bench.ticks(600);
  bench.session.play(false);
  bench.ticks(1);
  bench.session.play(true);
  bench.session.fetch();
  const std::vector<Vec3>& all = bench.session.snapshot().cloths[0].positions;
  return *std::min_element(all.begin(), all.end(),
                           [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
}

/// An input without force whose hand goes straight up.
class Pusher final : public Device {
 public:
  Pusher() {
    info_.workspace_low = Vec3::Constant(-0.15);
    info_.workspace_high = Vec3::Constant(0.15);
    info_.force_freedoms = 0;
  }
  const DeviceInfo& info() const noexcept override { return info_; }
  DeviceSample read() noexcept override {
    DeviceSample sample;
    sample.position = place;
    sample.buttons = 1;
    return sample;
  }
  void write(const DeviceCommand& command) noexcept override { most = std::max(most, command.force.norm()); }
  Vec3 place = Vec3::Zero();
  double most = 0.0;

 private:
  DeviceInfo info_;
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the workspace lies as the eye sees the scene, and reaches all of it") {
    SceneView view;
    view.low = Vec3(0.1, -0.4, 0.0);
    view.high = Vec3(0.5, 0.2, 0.9);
    DeviceInfo info;
    info.workspace_low = Vec3(-0.08, -0.03, -0.05);
    info.workspace_high = Vec3(0.08, 0.04, 0.07);
    for (const double azimuth : {-0.5 * std::numbers::pi, -1.1, 0.0, 2.5}) {
      view.azimuth = azimuth;
      const WorkspaceMap map = fit_workspace(view, info);
      CHECK(map.rotation.isUnitary(1e-12));  // rounding of a product of sines
      CHECK(map.rotation.col(0).cross(map.rotation.col(1)).dot(map.rotation.col(2)) == doctest::Approx(1.0));
      const Vec3 eye(std::cos(azimuth), std::sin(azimuth), 0.0);
      CHECK(map.way_to_tool(Vec3::UnitY()).normalized().dot(eye) == doctest::Approx(-1.0));  // away from it
      CHECK(map.way_to_tool(Vec3::UnitZ()).normalized().z() == doctest::Approx(1.0));
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 place((corner & 1) != 0 ? view.high.x() : view.low.x(),
                         (corner & 2) != 0 ? view.high.y() : view.low.y(),
                         (corner & 4) != 0 ? view.high.z() : view.low.z());
        const Vec3 device = map.to_device(place);
        CHECK((device - info.workspace_low).minCoeff() >= 0.0);
        CHECK((info.workspace_high - device).minCoeff() >= 0.0);
      }
    }
    view.azimuth = -0.5 * std::numbers::pi;  // from the front: the device's axes are the scene's
    CHECK(fit_workspace(view, info).rotation.isApprox(Mat3::Identity(), 1e-12));
  }

  TEST_CASE("the hand feels the cloth's true reaction, through the map, when nothing limits it") {
    Bench bench;
    const Vec3 edge = low_edge(bench);
    bench.wants = true;
    // Gripped beside the cloth and led 5 mm aside in a second; then still for longer than the ramp of 0.5 s.
    Vec3 at = edge;
    for (int i = 0; i < 1000; ++i) {
      at = edge + Vec3(5e-6 * i, 0.0, 2e-6 * i);
      bench.ticks(1, &at);
    }
    bench.ticks(1500, &at);
    REQUIRE(bench.holds());
    const Vec3 cloth = bench.session.device_touch().reading.force;
    CHECK(cloth.norm() > 1e-3);  // it pulls with more than the weight of a few nodes
    const Vec3 expected = bench.map.force_gain * (bench.map.rotation.transpose() * cloth);
    CHECK(bench.hand->look().force == doctest::Approx(expected.norm()).epsilon(0.01));
    // A still hand: no damping, no limit. The cloth still swings a little from tick to tick: 1 %.
    CHECK((bench.device->given_force() - expected).norm() < 0.01 * expected.norm());
    CHECK(bench.hand->look().rate == doctest::Approx(1.0 / kViewStep));
  }

  TEST_CASE("unplugged: no force at once, the hand lets go; plugged in again it goes on") {
    Bench bench;
    const Vec3 edge = low_edge(bench);
    bench.wants = true;
    Vec3 at = edge;
    bench.ticks(1, &at);
    REQUIRE(bench.holds());
    at.x() += 0.004;
    bench.ticks(700, &at);
    CHECK(bench.hand->look().force > 0.0);
    bench.device->set_connected(false);
    bench.ticks(1);
    CHECK(bench.hand->look().force == 0.0);
    CHECK(bench.hand->look().away);
    bench.ticks(1);  // the rule has seen the sample
    CHECK_FALSE(bench.holds());
    const std::int64_t before = bench.session.ticks();
    bench.ticks(50);
    CHECK(bench.session.ticks() == before + 50);  // the cloth goes on
    bench.device->set_connected(true);
    bench.ticks(2, &edge);
    CHECK_FALSE(bench.hand->look().away);
    CHECK(bench.holds());
  }

  TEST_CASE("an input without force leads the cloth and is given nothing") {
    const std::shared_ptr<ViewCloths> cloths = cloths_of(small_setup());
    ViewSession session(cloths);
    auto made = std::make_unique<Pusher>();
    Pusher& pusher = *made;
    bool wants = true;
    DeviceHand hand({std::move(made), std::make_unique<Always>(wants), false}, session,
                    DeviceHand::Time::kVirtual);
    hand.begin(cloths->scene(0).view);
    const WorkspaceMap map = fit_workspace(cloths->scene(0).view, pusher.info());
    session.play(true);
    const Vec3 begin = cloths->scene(0).start.positions[0];  // a corner, free, level with the held edge
    for (int i = 0; i < 300; ++i) {
      pusher.place = map.to_device(begin + Vec3(0.0, 0.0, 1e-4 * i));
      hand.tick(1000.0 * i);
    }
    const GraspReading reading = session.device_touch().reading;
    CHECK(reading.holds);
    CHECK(reading.centre.z() > begin.z() + 0.02);
    CHECK(reading.force.norm() > 0.0);
    CHECK(pusher.most == 0.0);
  }

  TEST_CASE("a driver that does not exist is wrong usage") {
    CHECK_THROWS_AS(open_hand_device("nosuch"), Error);
    CHECK_THROWS_AS(open_hand_device("simulated:nosuch"), Error);
  }
}

TEST_SUITE("determinism+property") {
  TEST_CASE("a simulated hand visits the cloth, twice to the same bits, and gets no energy from it") {
    std::uint64_t hashes[2] = {0, 0};
    for (std::uint64_t& hash : hashes) {
      const std::shared_ptr<ViewCloths> cloths = cloths_of(small_setup());
      ViewSession session(cloths);
      HandDevice opened = open_hand_device("simulated:touch");
      const auto& device = static_cast<const SimulatedDevice&>(*opened.device);
      DeviceHand hand(std::move(opened), session, DeviceHand::Time::kVirtual);
      hand.begin(cloths->scene(0).view);
      session.play(true);
      double least = 0.0, most = 0.0;
      bool held = false;
      for (int i = 0; i < 4000; ++i) {
        hand.tick(1000.0 * i);
        held = held || session.device_touch().reading.holds;
        least = std::min(least, device.work_received());
        most = std::max(most, hand.look().force);
      }
      CHECK(held);
      CHECK(most > 0.01);
      CHECK(least > -1e-3);                               // docs/haptics.md allows a hand 1 mJ
      CHECK_FALSE(session.device_touch().reading.holds);  // let go before the round was over
      hash = session.state_hash();
    }
    CHECK(hashes[0] == hashes[1]);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("a tick of device, path and session does not allocate") {
    Bench bench;
    const Vec3 edge = low_edge(bench);
    bench.wants = true;
    bench.ticks(600, &edge);  // states are kept in rings that are filled by then
    const AllocationGuard guard;
    bench.ticks(400, &edge);
    CHECK(guard.count() == 0);
  }

  TEST_CASE("on threads of its own it ticks the session until it is ended, again with another scene") {
    const std::shared_ptr<ViewCloths> cloths = cloths_of(small_setup());
    ViewSession session(cloths);
    session.play(true);
    DeviceHand hand(open_hand_device("simulated"), session, DeviceHand::Time::kReal);
    for (const std::int64_t ticks : {50, 100}) {
      hand.begin(cloths->scene(0).view);
      while (session.ticks() < ticks) std::this_thread::yield();
      hand.end();
      const std::int64_t after = session.ticks();
      std::this_thread::yield();
      CHECK(session.ticks() == after);
    }
    CHECK(hand.look().tool.allFinite());
  }
}
