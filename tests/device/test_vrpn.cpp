// The VRPN client: golden bytes, then against a server on loopback with every fault.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "fakes/fake_clock.h"
#include "fakes/fake_vrpn.h"
#include "fakes/scoped_variable.h"
#include "fuai/core/error.h"
#include "fuai/device/device_vrpn.h"
#include "support/allocation_guard.h"

using namespace fuai;
using namespace fuai_test;

namespace {

std::string hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    constexpr const char* kDigits = "0123456789abcdef";
    text += {kDigits[byte >> 4], kDigits[byte & 15], ' '};
  }
  if (!text.empty()) text.pop_back();
  return text;
}

/// A server and a client of it; time passes by steps of a millisecond.
struct Bench {
  Bench() { fake_now = 100.0; }
  VrpnOptions options() {
    VrpnOptions chosen;
    chosen.host = "127.0.0.1";
    chosen.port = std::to_string(server.socket.port());
    chosen.clock = fake_clock;
    chosen.idle = [this] {
      server.pump();
      fake_now += 1e-3;
    };
    return chosen;
  }
  std::unique_ptr<DeviceVrpn> open() { return std::make_unique<DeviceVrpn>(options()); }
  std::string problem(VrpnOptions chosen) {
    try {
      DeviceVrpn device(chosen);
    } catch (const Error& e) {
      CHECK(e.kind() == ErrorKind::kNoDevice);
      CHECK(!e.cure().empty());
      return e.problem();
    }
    return "opened";
  }
  DeviceSample step(DeviceVrpn& device, const Vec3& force, double dt = 1e-3) {
    server.pump();
    fake_now += dt;
    const DeviceSample sample = device.read();
    device.write({force});
    server.pump();
    return sample;
  }
  FakeVrpn server;
};

const Vec3 kPull(1.0, 0.0, 0.0);

}  // namespace

TEST_SUITE("golden") {
  TEST_CASE("VRPN: the bytes that a real server of version 07.38 took and gave") {
    CHECK(hex(vrpn_cookie()) == "76 72 70 6e 3a 20 76 65 72 2e 20 30 37 2e 33 38 20 20 30 00 00 00 00 00");
    std::array<std::uint8_t, 256> out;
    VrpnForceField field;
    field.origin = Vec3(0.5, 0.0, -1.0);
    field.force = Vec3(1.0, 2.0, 3.0);
    field.jacobian << 1, 2, 3, 4, 5, 6, 7, 8, 9;
    field.radius = 0.25;
    // 88 bytes, sender 0, type 1; sixteen floats, the matrix row by row.
    CHECK(hex(write_vrpn_message(out, 0, 1, vrpn_force_field(field))) ==
          "00 00 00 58 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 01 00 00 00 00 "
          "3f 00 00 00 00 00 00 00 bf 80 00 00 3f 80 00 00 40 00 00 00 40 40 00 00 "
          "3f 80 00 00 40 00 00 00 40 40 00 00 40 80 00 00 40 a0 00 00 40 c0 00 00 "
          "40 e0 00 00 41 00 00 00 41 10 00 00 3e 80 00 00");
    // The length does not count the zeros: 24 + 4 + 9 = 37, and 3 zeros.
    CHECK(hex(write_vrpn_description(out, kVrpnSenderDescription, 3, "Phantom0")) ==
          "00 00 00 25 00 00 00 00 00 00 00 00 00 00 00 03 ff ff ff ff 00 00 00 00 "
          "00 00 00 09 50 68 61 6e 74 6f 6d 30 00 00 00 00");
    CHECK(hex(write_vrpn_message(out, 0, 2, {})) ==
          "00 00 00 18 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 02 00 00 00 00");
    CHECK(write_vrpn_message(std::span(out).first(80), 0, 1, vrpn_force_field(field)).empty());
  }
}

TEST_SUITE("unit") {
  TEST_CASE("VRPN: a message in any pieces is the same message") {
    const std::string cookie = std::string("vrpn: ver. 07.38  0") + std::string(5, '\0');
    Bytes all(cookie.begin(), cookie.end());
    Bytes pose(8, 0);
    for (const double value : {0.1, 0.2, 0.3, 0.0, 0.0, 0.0, 1.0}) put64(pose, value);
    for (const Bytes& bytes :
         {vrpn_description(-1, 7, "tracker"), vrpn_description(-2, 1, "vrpn_Tracker Pos_Quat"),
          vrpn_message(7, 9, Bytes(5000, 1)),  // longer than what is kept
          vrpn_message(7, 1, pose)})
      all.insert(all.end(), bytes.begin(), bytes.end());
    for (std::size_t cut = 0; cut <= all.size(); ++cut) {
      VrpnClient client("tracker");
      REQUIRE(client.take(std::span(all).first(cut)));
      REQUIRE(client.take(std::span(all).subspan(cut)));
      CHECK(client.state().position == Vec3(0.1, 0.2, 0.3));
      CHECK(client.state().message_count == 3);  // the long one is passed over
    }
    VrpnClient client("tracker");
    for (const std::uint8_t& byte : all) REQUIRE(client.take({&byte, 1}));
    CHECK(client.state().pose_count == 1);
  }

  TEST_CASE("VRPN: names, hosts and ports") {
    const auto parsed = [](const std::string& text) {
      const VrpnOptions options = parse_vrpn_name(text);
      return options.name + " " + options.host + " " + options.port;
    };
    CHECK(parsed("") == "Phantom0 localhost 3883");
    CHECK(parsed("Falcon0") == "Falcon0 localhost 3883");
    CHECK(parsed("Falcon0@lab-pc") == "Falcon0 lab-pc 3883");
    CHECK(parsed("Falcon0@tcp://lab-pc:4000") == "Falcon0 lab-pc 4000");
    CHECK(parsed("Falcon0@[::1]:4000") == "Falcon0 ::1 4000");
    CHECK(parsed("@lab-pc") == "Phantom0 lab-pc 3883");
    for (const char* wrong : {"a@b:", "a@b:0", "a@b:65536", "a@b:12x", "a@[::1", "a@[::1]x"})
      CHECK_THROWS_AS(parse_vrpn_name(wrong), Error);
    const ScopedVariable variable(kVrpnAddressVariable, "elsewhere:1234");
    CHECK(parsed("Falcon0") == "Falcon0 elsewhere 1234");
  }

  TEST_CASE("VRPN: positions, turns, velocities, buttons and forces in our axes") {
    Bench bench;
    bench.server.position = Vec3(0.1, 0.2, 0.3);
    const auto device = bench.open();
    CHECK(device->info().peak_force == 3.3);
    CHECK(bench.step(*device, Vec3(0.25, 0.5, 1.0)).status == kDeviceReady);
    CHECK(device->read().position == Vec3(0.1, -0.3, 0.2));
    CHECK(std::isnan(device->read().velocity.x()));
    CHECK(bench.server.force == Vec3(0.25, 1.0, -0.5));
    CHECK(bench.server.felt() == bench.server.force);
    CHECK((bench.server.origin - bench.server.position).norm() < 1e-7);  // floats
    CHECK(bench.server.rate == 1000.0);
    Bytes velocity(8, 0), button, buttons;
    for (const double value : {1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.01}) put64(velocity, value);
    for (const std::uint32_t value : {3u, 1u, 0u, 1u}) put32(buttons, value);
    for (const std::uint32_t value : {4u, 1u}) put32(button, value);
    bench.server.say(vrpn_message(4, FakeVrpn::kVelocity, velocity));
    bench.server.say(vrpn_message(4, FakeVrpn::kButtons, buttons));
    bench.server.say(vrpn_message(4, FakeVrpn::kButton, button));
    // A quarter about the server's y, which is up: about our z.
    const double half = std::sqrt(0.5);
    bench.server.silent = true;
    bench.server.pose(Vec3::Zero(), {0.0, half, 0.0, half});
    const DeviceSample sample = bench.step(*device, kPull);
    bench.step(*device, kPull);
    CHECK(device->read().velocity == Vec3(1.0, -3.0, 2.0));
    CHECK(sample.buttons == (1u | 4u | 16u));
    Mat3 expected;
    expected << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    CHECK((sample.orientation - expected).norm() < 1e-15);
    for (const auto& [code, status] : {std::pair<std::uint32_t, std::uint32_t>{0, kDeviceSaturated},
                                       {1, kDeviceWarm},
                                       {2, kDeviceForceOff},
                                       {3, kDeviceForceOff},
                                       {4, kDeviceReady}}) {
      Bytes error;
      put32(error, code);
      bench.server.say(vrpn_message(4, FakeVrpn::kForceError, error));
      CHECK(bench.step(*device, kPull).status == status);
    }
    // A server that never takes an error back does not end the session.
    bench.server.silent = false;
    Bytes error;
    put32(error, 2);
    bench.server.say(vrpn_message(4, FakeVrpn::kForceError, error));
    for (int i = 0; i < 499; ++i) CHECK(bench.step(*device, kPull).status == kDeviceForceOff);
    for (int i = 0; i < 5; ++i) bench.step(*device, kPull);
    CHECK(device->read().status == kDeviceReady);
  }

  TEST_CASE("VRPN: descriptions in any order, a UDP description, one byte at a time, other senders") {
    for (const bool types_first : {true, false}) {
      Bench bench;
      bench.server.types_first = types_first;
      bench.server.pieces = 1;
      bench.server.position = Vec3(0.01, 0.0, 0.0);
      const auto device = bench.open();
      bench.server.pieces = 0;
      Bytes pose(8, 0);
      for (const double value : {9.0, 9.0, 9.0, 0.0, 0.0, 0.0, 1.0}) put64(pose, value);
      bench.server.say(vrpn_message(0, FakeVrpn::kPose, pose));  // of another device
      pose[3] = 1;
      bench.server.say(vrpn_message(4, FakeVrpn::kPose, pose));  // of another sensor
      CHECK(bench.step(*device, kPull).position == Vec3(0.01, 0.0, 0.0));
    }
  }

  TEST_CASE("VRPN: a tracker without force is an input") {
    Bench bench;
    bench.server.forces = false;
    const auto device = bench.open();
    CHECK(device->info().peak_force == 0.0);
    bench.step(*device, kPull);
    CHECK(bench.server.fields == 0);
  }

  TEST_CASE("VRPN: what --diagnose says") {
    const ScopedVariable variable(kVrpnAddressVariable, "127.0.0.1:1");  // nobody listens there
    const DriverReport report = vrpn_driver().probe();
    CHECK(report.why_not == "no VRPN server answers at 127.0.0.1:1: Connection refused");
    CHECK(report.cure.find("vrpn_server") != std::string::npos);
  }
}

TEST_SUITE("safety") {
  TEST_CASE("VRPN: what cannot be opened says why") {
    Bench bench;
    VrpnOptions options = bench.options();
    options.name = "Falcon0";
    CHECK(bench.problem(options).find("has no 'Falcon0' but VRPN Control, Phantom0") != std::string::npos);
    for (const char* cookie : {"vrpn: ver. 08.00  0", "HTTP/1.1 400 Bad Request and more"}) {
      bench.server.cookie = cookie;
      bench.server.cookie.resize(40, '\0');
      CHECK(bench.problem(bench.options()).find("is no VRPN server of version 07") != std::string::npos);
    }
    bench.server.cookie = FakeVrpn{}.cookie;
    bench.server.silent = true;
    CHECK(bench.problem(bench.options()) == "the VRPN server sends no position of 'Phantom0'");
    bench.server.socket.refuse();
    CHECK(bench.problem(bench.options()).find("Connection refused") != std::string::npos);
    options.name = "";
    CHECK_THROWS_AS(DeviceVrpn{options}, Error);
  }

  TEST_CASE("VRPN: silence of a quarter second takes the force away, of ten ends the connection") {
    Bench bench;
    const auto device = bench.open();
    bench.step(*device, kPull);
    CHECK(bench.server.felt() == kPull);
    bench.server.silent = true;
    for (int i = 0; i < 240; ++i) CHECK(bench.step(*device, kPull).status == kDeviceReady);
    for (int i = 0; i < 20; ++i) bench.step(*device, kPull);
    CHECK(device->read().status == kDeviceDisconnected);
    CHECK(bench.server.felt() == Vec3::Zero());
    CHECK(bench.server.radius == 0.0);
    CHECK(bench.server.socket.connections == 1);
    // Back by itself when positions come again.
    bench.server.silent = false;
    bench.step(*device, kPull);
    CHECK(bench.step(*device, kPull).status == kDeviceReady);
    CHECK(bench.server.felt() == kPull);
    bench.server.silent = true;
    for (int i = 0; i < 990; ++i) bench.step(*device, kPull, 0.01);
    CHECK(bench.server.pings >= 9);
    CHECK(bench.server.socket.connections == 1);
    for (int i = 0; i < 150; ++i) bench.step(*device, kPull, 0.01);
    CHECK(bench.server.socket.connections == 2);
    CHECK(device->read().status == kDeviceDisconnected);
    bench.server.silent = false;
    bench.step(*device, kPull);
    CHECK(bench.step(*device, kPull).status == kDeviceReady);
  }

  TEST_CASE("VRPN: reports at 60 Hz alone: the hand is late, the force stays, between reports too") {
    Bench bench;
    const auto device = bench.open();
    const double speed = 0.2;  // [m/s]: 3.4 mm from report to report, within the field's 10 mm
    for (int i = 0; i < 500; ++i) {
      bench.server.silent = i % 17 != 0;
      bench.server.position.x() = speed * 1e-3 * i;
      const DeviceSample sample = bench.step(*device, kPull);
      CHECK(sample.status == kDeviceReady);
      // What was sent in step k, a multiple of 17, is known from k on until the next one.
      CHECK(sample.position.x() == doctest::Approx(speed * 1e-3 * (i - i % 17)).epsilon(1e-12));
      CHECK(bench.server.felt() == kPull);
    }
    CHECK(bench.server.pings == 0);
  }

  TEST_CASE("VRPN: dropped, refused for a while, and back within a second") {
    Bench bench;
    const auto device = bench.open();
    bench.server.position = Vec3(0.0, 0.05, 0.0);
    bench.step(*device, kPull);
    bench.server.socket.drop();
    bench.server.socket.refuse();
    const DeviceSample lost = bench.step(*device, kPull);
    CHECK(lost.status == kDeviceDisconnected);
    CHECK(lost.position == Vec3(0.0, 0.0, 0.05));
    for (int i = 0; i < 3000; ++i) CHECK(bench.step(*device, kPull).status == kDeviceDisconnected);
    bench.server.socket.listen();
    bench.server.fields = 0;
    int until = 0;
    while (bench.step(*device, kPull).status != kDeviceReady && until < 2000) ++until;
    CHECK(until < 1010);
    CHECK(bench.server.socket.connections == 2);
    bench.step(*device, kPull);
    CHECK(bench.server.felt() == kPull);
  }

  TEST_CASE("VRPN: numbers that mean another device now, no numbers, impossible lengths") {
    Bench bench;
    const auto device = bench.open();
    bench.step(*device, kPull);
    // The same device under another number; its old one is another's.
    bench.server.say(vrpn_description(-1, 4, "Button0"));
    CHECK(bench.step(*device, kPull).status == kDeviceDisconnected);
    CHECK(bench.server.radius == 0.0);
    bench.server.id = 6;
    bench.server.say(vrpn_description(-1, 6, "Phantom0"));
    bench.step(*device, kPull);
    CHECK(bench.step(*device, kPull).status == kDeviceReady);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    bench.server.pose(Vec3(nan, 0.0, 0.0));
    CHECK(bench.step(*device, kPull).status == kDeviceDisconnected);
    for (int i = 0; i < 1010; ++i) bench.step(*device, kPull);
    CHECK(device->read().status == kDeviceReady);
    for (const std::uint32_t length : {0u, 23u, 0x80000000u, 0xffffffffu, (1u << 20) + 25u}) {
      Bytes header;
      put32(header, length);
      header.resize(24, 0);
      bench.server.say(header);
      bench.step(*device, kPull);
      CHECK(bench.step(*device, kPull).status == kDeviceDisconnected);
      for (int i = 0; i < 1010; ++i) bench.step(*device, kPull);
      CHECK(device->read().status == kDeviceReady);
    }
  }

  TEST_CASE("VRPN: too much is cut, no number is none, closing takes the field away") {
    Bench bench;
    auto device = bench.open();
    bench.step(*device, Vec3(0.0, 0.0, 1e9));
    CHECK(bench.server.felt().norm() == doctest::Approx(3.3).epsilon(1e-7));  // floats
    CHECK((bench.step(*device, kPull).status & kDeviceSaturated) != 0);
    device->write({Vec3::Constant(std::numeric_limits<double>::quiet_NaN())});
    bench.server.pump();
    CHECK(bench.server.felt() == Vec3::Zero());
    bench.step(*device, kPull);
    CHECK(bench.server.felt() == kPull);
    // The field is narrow: nobody pulls a hand that has gone on.
    bench.server.position = Vec3(0.011, 0.0, 0.0);
    CHECK(bench.server.felt() == Vec3::Zero());
    bench.step(*device, kPull);
    CHECK(bench.server.felt() == kPull);
    device.reset();
    // The server sees the last words before the end of the connection.
    bench.server.pump();
    CHECK(bench.server.radius == 0.0);
    CHECK(bench.server.force == Vec3::Zero());
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("VRPN: reading, writing, losing and finding again allocate nothing") {
    Bench bench;
    const auto device = bench.open();
    std::size_t allocated = 0;
    for (int i = 0; i < 3000; ++i) {
      if (i == 1000) bench.server.socket.drop();
      bench.server.pump();
      fake_now += 1e-3;
      const AllocationGuard guard;
      device->read();
      device->write({kPull});
      allocated += guard.count();
    }
    CHECK(allocated == 0);
    CHECK(bench.server.socket.connections == 2);
    CHECK(device->read().status == kDeviceReady);
  }
}
