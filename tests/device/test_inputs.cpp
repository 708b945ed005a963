// Inputs without force: 3D mouse on a socket, gamepad on a node, mouse from a window.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>

#include "fakes/fake_clock.h"
#include "fakes/fake_stream_server.h"
#include "fakes/scoped_variable.h"
#include "fuai/core/error.h"
#include "fuai/device/device_gamepad.h"
#include "fuai/device/device_mouse.h"
#include "fuai/device/device_spacenav.h"
#include "support/allocation_guard.h"

using namespace fuai;
using namespace fuai_test;

namespace {

/// A path of this process, free again at the end.
struct TemporaryPath {
  explicit TemporaryPath(const char* name)
      : path((std::filesystem::temp_directory_path() / (name + std::to_string(::getpid()))).string()) {}
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;
  ~TemporaryPath() { ::unlink(path.c_str()); }
  std::string path;
};

using Event = std::array<std::int32_t, 8>;

void send(const FakeStreamServer& server, const Event& event, std::size_t pieces = 32) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(event.data());
  for (std::size_t at = 0; at < 32; at += pieces)
    server.send(std::span(bytes + at, std::min(pieces, 32 - at)));
}

/// A second in steps of 10 ms.
DeviceSample pass_second(Device& device) {
  for (int i = 0; i < 99; ++i) {
    fake_now += 0.01;
    device.read();
  }
  fake_now += 0.01;
  return device.read();
}

/// A gamepad's node: a pipe.
struct Pad {
  Pad() : node("fuai-pad") {
    REQUIRE(::mkfifo(node.path.c_str(), 0600) == 0);
    keep = ::open(node.path.c_str(), O_RDWR | O_CLOEXEC);  // a writer, so that the pipe does not end
    fake_now = 100.0;
  }
  Pad(const Pad&) = delete;
  Pad& operator=(const Pad&) = delete;
  ~Pad() { ::close(keep); }
  void say(std::int16_t value, std::uint8_t kind, std::uint8_t number, std::size_t pieces = 8) const {
    std::array<std::uint8_t, 8> event{};
    std::memcpy(event.data() + 4, &value, 2);
    event[6] = kind;
    event[7] = number;
    for (std::size_t at = 0; at < 8; at += pieces)
      REQUIRE(::write(keep, event.data() + at, std::min(pieces, 8 - at)) > 0);
  }
  TemporaryPath node;
  int keep = -1;
};

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a push is a speed: dead zone, full deflection, the box's end, a pause of the loop") {
    RateControl hand;
    hand.update(Vec3(1.0, 0.05, -2.0), 10.0);
    CHECK(hand.position() == Vec3::Zero());
    for (int i = 1; i <= 50; ++i) hand.update(Vec3(1.0, 0.05, -2.0), 10.0 + 0.01 * i);
    // Rounding of fifty sums.
    CHECK(hand.position().x() == doctest::Approx(0.5 * RateControl::kSpeed).epsilon(1e-12));
    CHECK(hand.position().y() == 0.0);
    CHECK(hand.position().z() == doctest::Approx(-0.5 * RateControl::kSpeed).epsilon(1e-12));
    CHECK(hand.velocity().x() == RateControl::kSpeed);
    const double before = hand.position().x();
    hand.update(Vec3(0.53, 0.0, 0.0), 20.0);  // half of what is beyond the dead zone
    CHECK(hand.position().x() - before ==
          doctest::Approx(0.5 * RateControl::kSpeed * RateControl::kLongest).epsilon(1e-12));
    for (int i = 0; i < 1000; ++i) hand.update(Vec3(1.0, NAN, 0.0), 20.0 + 0.01 * i);
    CHECK(hand.position().x() == RateControl::kReach);
    CHECK(hand.velocity().x() == 0.0);
    CHECK(hand.position().allFinite());
  }
}

TEST_SUITE("unit") {
  TEST_CASE("spacenav: pushes are speeds in our axes, buttons, events in pieces") {
    const TemporaryPath socket("fuai-spnav");
    FakeStreamServer server(socket.path);
    fake_now = 100.0;
    DeviceSpacenav device(socket.path, fake_clock);
    CHECK(device.info().peak_force == 0.0);
    server.pump();
    send(server, {0, 350, 0, 0, 0, 0, 0, 16});
    device.read();
    CHECK(pass_second(device).position.x() == doctest::Approx(RateControl::kSpeed).epsilon(1e-12));
    for (const std::size_t pieces : {1u, 5u, 32u}) {
      send(server, {0, 0, 350, -350, 9, 9, 9, 16}, pieces);  // up and towards the user
      CHECK(pass_second(device).velocity.x() == 0.0);
    }
    const DeviceSample sample = device.read();
    CHECK(sample.position.y() == -RateControl::kReach);
    CHECK(sample.position.z() == RateControl::kReach);
    send(server, {1, 3, 1, 0, 0, 0, 0, 0});
    send(server, {1, 99, 1, 0, 0, 0, 0, 0});
    send(server, {3, 0, 0, 0, 0, 0, 0, 0});  // of a device: passed over
    CHECK(device.read().buttons == 8);
    send(server, {2, 3, 0, 0, 0, 0, 0, 0});
    CHECK(device.read().buttons == 0);
    CHECK(device.read().status == kDeviceReady);
  }

  TEST_CASE("gamepad: sticks, trigger, buttons") {
    const Pad pad;
    DeviceGamepad device(pad.node.path, fake_clock);
    CHECK(device.info().model == pad.node.path);
    device.read();
    pad.say(32767, 0x82, 0);   // as at the beginning: right
    pad.say(-32767, 2, 1, 3);  // up is away
    pad.say(32767, 2, 4, 1);   // down
    pad.say(0, 2, 5);
    pad.say(1, 1, 2);
    pad.say(32767, 2, 77);
    const DeviceSample sample = pass_second(device);
    CHECK((sample.position - RateControl::kSpeed * Vec3(1, 1, -1)).norm() < 1e-12);
    CHECK(sample.pinch == 0.5);
    CHECK(sample.buttons == 4);
    pad.say(0, 1, 2);
    CHECK(device.read().buttons == 0);
  }

  TEST_CASE("mouse: where the window says, cut to the box") {
    DeviceMouse mouse(fake_clock);
    fake_now = 7.0;
    CHECK(mouse.read().position == Vec3::Zero());
    mouse.set({Vec3(0.01, -0.02, 9.0), 5, 0.25});
    mouse.set({Vec3(NAN, 0.0, 0.0), 9, 0.5});
    const DeviceSample sample = mouse.read();
    CHECK(sample.position == Vec3(0.01, -0.02, DeviceMouse::kReach));
    CHECK(sample.buttons == 5);
    CHECK(sample.pinch == 0.25);
    CHECK(sample.time == 7.0);
    CHECK(sample.status == kDeviceReady);
    CHECK(mouse_driver().open({})->info().force_freedoms == 0);
  }
}

TEST_SUITE("safety") {
  TEST_CASE("spacenav: without a daemon, a daemon that restarts, something else on the socket") {
    const TemporaryPath socket("fuai-spnav");
    const ScopedVariable variable(kSpacenavVariable, socket.path);
    const DriverReport report = spacenav_driver().probe();
    CHECK(report.why_not == "no spacenavd listens at " + socket.path + ": No such file or directory");
    CHECK(report.cure.find("spacenavd") != std::string::npos);
    FakeStreamServer server(socket.path);
    CHECK(spacenav_driver().probe().available);
    server.pump();
    fake_now = 100.0;
    DeviceSpacenav device("", fake_clock);
    server.pump();
    send(server, {0, 350, 0, 0, 0, 0, 0, 16});
    send(server, {1, 0, 1, 0, 0, 0, 0, 0}, 20);
    fake_now += 0.01;
    device.read();
    server.drop();
    server.refuse();
    fake_now += 0.01;
    const DeviceSample lost = device.read();
    CHECK(lost.status == kDeviceDisconnected);
    CHECK(lost.velocity == Vec3::Zero());
    CHECK(lost.buttons == 0);
    CHECK(pass_second(device).position == lost.position);
    server.listen();
    CHECK(pass_second(device).status == kDeviceReady);
    CHECK(device.read().velocity == Vec3::Zero());
    server.pump();
    send(server, {0x48545450, 0, 0, 0, 0, 0, 0, 0});
    CHECK(device.read().status == kDeviceDisconnected);
    fake_now += 1.1;
    device.read();
    CHECK(device.read().status == kDeviceReady);
    CHECK_THROWS_AS(DeviceSpacenav(std::string(200, 'x')), Error);
  }

  TEST_CASE("gamepad: none, pulled out while pushed, plugged in again") {
    CHECK_THROWS_WITH_AS(DeviceGamepad("/nowhere/js0"),
                         doctest::Contains("/nowhere/js0 cannot be opened: No such file or directory"),
                         Error);
    Pad pad;
    DeviceGamepad device(pad.node.path, fake_clock);
    pad.say(32767, 2, 0);
    fake_now += 0.01;
    device.read();
    ::close(pad.keep);  // the pipe ends, as a node of an unplugged device does
    fake_now += 0.01;
    const DeviceSample lost = device.read();
    CHECK(lost.status == kDeviceDisconnected);
    CHECK(lost.velocity == Vec3::Zero());
    pad.keep = ::open(pad.node.path.c_str(), O_RDWR | O_CLOEXEC);
    CHECK(pass_second(device).position == lost.position);
    fake_now += 0.1;
    device.read();
    CHECK(device.read().status == kDeviceReady);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("inputs: reading, losing and finding again allocate nothing") {
    const TemporaryPath socket("fuai-spnav");
    FakeStreamServer server(socket.path);
    const Pad pad;
    DeviceSpacenav spacenav(socket.path, fake_clock);
    DeviceGamepad gamepad(pad.node.path, fake_clock);
    DeviceMouse mouse(fake_clock);
    std::size_t allocated = 0;
    for (int i = 0; i < 1000; ++i) {
      if (i == 300) server.drop();
      server.pump();
      fake_now += 0.01;
      pad.say(static_cast<std::int16_t>(i), 2, 0);
      const AllocationGuard guard;
      mouse.set({});
      for (Device* const device : std::initializer_list<Device*>{&spacenav, &gamepad, &mouse}) {
        device->write({Vec3(1.0, 0.0, 0.0)});
        device->read();
      }
      allocated += guard.count();
    }
    CHECK(allocated == 0);
    CHECK(server.connections == 2);
  }
}
