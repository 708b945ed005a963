// The Inverse3 driver: golden bytes of WebSocket, then against a service on loopback with every fault.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <atomic>
#include <limits>
#include <memory>
#include <string>
#include <thread>

#include "fakes/fake_clock.h"
#include "fakes/fake_inverse.h"
#include "fakes/scoped_variable.h"
#include "fuai/core/error.h"
#include "fuai/device/device_inverse3.h"
#include "support/allocation_guard.h"

using namespace fuai;
using namespace fuai_test;

namespace {

struct Bench {
  Bench() {
    fake_now = 100.0;
    // The fake asks the function whose golden value is tested below.
    server.accept = [](const std::string& key) { return websocket_accept(key); };
  }
  Inverse3Options options() {
    Inverse3Options chosen = parse_inverse3_name(server.socket.address());
    chosen.clock = fake_clock;
    chosen.idle = [this] {
      server.pump();
      fake_now += 1e-3;
    };
    return chosen;
  }
  std::unique_ptr<DeviceInverse3> open() { return std::make_unique<DeviceInverse3>(options()); }
  std::string problem(const Inverse3Options& chosen) {
    try {
      DeviceInverse3 device(chosen);
    } catch (const Error& e) {
      CHECK(e.kind() == ErrorKind::kNoDevice);
      CHECK(!e.cure().empty());
      return e.problem();
    }
    return "opened";
  }
  DeviceSample step(DeviceInverse3& device, const Vec3& force, double dt = 1e-3) {
    server.pump();
    fake_now += dt;
    const DeviceSample sample = device.read();
    device.write({force});
    server.pump();
    return sample;
  }
  FakeInverse server;
};

const Vec3 kPull(1.0, 2.0, -0.5);

std::string text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Reads bytes in pieces; the messages, and what ended it.
struct Heard {
  std::vector<std::string> texts, pings;
  bool open = false, closed = false, bad = false;
};
Heard hear(const std::string& bytes, std::size_t step, std::size_t most = 100000) {
  WebSocketReader reader(most);
  reader.restart(websocket_accept("dGhlIHNhbXBsZSBub25jZQ=="));
  Heard heard;
  for (std::size_t at = 0; at < bytes.size(); at += step) {
    std::span<const std::uint8_t> piece(reinterpret_cast<const std::uint8_t*>(bytes.data()) + at,
                                        std::min(step, bytes.size() - at));
    for (;;) {
      std::string_view message;
      const WebSocketRead read = reader.read(piece, message);
      if (read == WebSocketRead::kNothing) break;
      if (read == WebSocketRead::kText) heard.texts.emplace_back(message);
      if (read == WebSocketRead::kPing) heard.pings.emplace_back(message);
      heard.open = heard.open || read == WebSocketRead::kOpen;
      heard.closed = heard.closed || read == WebSocketRead::kClose;
      heard.bad = read == WebSocketRead::kBad;
      if (heard.bad || heard.closed) return heard;
    }
  }
  return heard;
}

const std::string kHandshake =
    "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    "Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n\r\n";

}  // namespace

TEST_SUITE("golden") {
  TEST_CASE("WebSocket: key, request and frames of RFC 6455") {
    CHECK(websocket_accept("dGhlIHNhbXBsZSBub25jZQ==") == "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
    std::array<std::uint8_t, 16> bytes{};
    const std::string nonce = "the sample nonce";
    std::copy(nonce.begin(), nonce.end(), bytes.begin());
    CHECK(websocket_key(bytes) == "dGhlIHNhbXBsZSBub25jZQ==");
    CHECK(websocket_request("localhost:10001", "dGhlIHNhbXBsZSBub25jZQ==") ==
          "GET / HTTP/1.1\r\nHost: localhost:10001\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
          "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n");
    // 5.7 of the RFC: a masked "Hello".
    std::array<std::uint8_t, 300> out;
    CHECK(text_of(write_websocket_frame(out, WebSocketOpcode::kText, "Hello", 0x37fa213d)) ==
          "\x81\x85\x37\xfa\x21\x3d\x7f\x9f\x4d\x51\x58");
    CHECK(
        text_of(write_websocket_frame(out, WebSocketOpcode::kText, std::string(256, 'a'), 0)).substr(0, 8) ==
        std::string("\x81\xfe\x01\x00\x00\x00\x00\x00", 8));
    CHECK(write_websocket_frame(std::span(out).first(10), WebSocketOpcode::kText, "Hello", 1).empty());
    // 5.7: the same not masked, in fragments, a ping.
    CHECK(hear(kHandshake + "\x81\x05Hello", 1).texts == std::vector<std::string>{"Hello"});
    CHECK(hear(kHandshake + "\x01\x03Hel\x80\x02lo", 3).texts == std::vector<std::string>{"Hello"});
    CHECK(hear(kHandshake + "\x89\x05Hello", 4).pings == std::vector<std::string>{"Hello"});
  }

  TEST_CASE("Inverse Service: the messages that are sent") {
    std::array<char, 400> out;
    CHECK(
        write_inverse3_force(out, "049D", Vec3(1.5, -0.25, 0.1)) ==
        R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"values":{"x":1.5,"y":-0.25,"z":0.1}}}}]})");
    CHECK(write_inverse3_probe(out, "049D") ==
          R"({"inverse3":[{"device_id":"049D","commands":{"probe_position":{}}}]})");
    CHECK(write_inverse3_force(std::span(out).first(40), "049D", Vec3::Zero()).empty());
  }
}

TEST_SUITE("unit") {
  TEST_CASE("WebSocket: lengths of one, three and nine bytes, in any pieces, up to a bound") {
    for (const std::size_t size : {0u, 125u, 126u, 65535u, 65536u})
      for (const std::size_t step : {1u, 7u, 4096u}) {
        const Heard heard = hear(kHandshake + server_frame(std::string(size, 'x')), step);
        REQUIRE(heard.texts.size() == 1);
        CHECK(heard.texts[0].size() == size);
      }
    CHECK(hear(kHandshake + server_frame(std::string(101, 'x')), 9, 100).bad);
    CHECK(
        hear(kHandshake + server_frame(std::string(60, 'x'), 0x01) + server_frame(std::string(60, 'x'), 0x80),
             9, 100)
            .bad);
    CHECK(hear(kHandshake + "\x81\x7f\xff\xff\xff\xff\xff\xff\xff\xff", 3).bad);
  }

  TEST_CASE("WebSocket: what is against the protocol") {
    for (const std::string& bytes : {
             std::string("\xc1\x01x"),             // a reserved bit
             std::string("\x83\x01x"),             // an unknown opcode
             std::string("\x81\x81\0\0\0\0x", 7),  // a mask from a server
             std::string("\x80\x01x"),             // a continuation of nothing
             std::string("\x01\x01x\x81\x01x"),    // a beginning within a message
             std::string("\x09\x01x"),             // a ping in fragments
             std::string("\x89\x7e\x00\x7e", 4),   // a long ping
         })
      CHECK(hear(kHandshake + bytes, 2).bad);
    CHECK(hear(kHandshake + std::string("\x88\x02\x03\xe8"), 2).closed);
    CHECK(hear("HTTP/1.1 404 Not Found\r\n\r\n", 5).bad);
    CHECK(hear("HTTP/1.1 101 x\r\nUpgrade: websocket\r\nSec-WebSocket-Accept: wrong\r\n\r\n", 5).bad);
    CHECK(hear(std::string(5000, 'x'), 100).bad);  // a handshake without end
  }

  TEST_CASE("Inverse3: names, ids and ports") {
    const auto parsed = [](const std::string& text) {
      const Inverse3Options options = parse_inverse3_name(text);
      return options.id + " " + options.host + " " + options.port;
    };
    CHECK(parsed("") == " localhost 10001");
    CHECK(parsed("lab-pc") == " lab-pc 10001");
    CHECK(parsed("lab-pc:9000") == " lab-pc 9000");
    CHECK(parsed("049D@") == "049D localhost 10001");
    CHECK(parsed("049D@:9000") == "049D localhost 9000");
    for (const char* wrong : {"a:", "a:x", "a\"b@host", "a b@"})
      CHECK_THROWS_AS(parse_inverse3_name(wrong), Error);
  }

  TEST_CASE("Inverse3: positions, velocities, buttons and forces; defaults left out; filters are recorded") {
    for (const bool omit : {false, true}) {
      Bench bench;
      bench.server.omit_defaults = omit;
      const auto device = bench.open();
      CHECK(device->info().model.find("049D") != std::string::npos);
      CHECK(device->info().sources.find("force gate gain is 0.3") != std::string::npos);
      bench.step(*device, kPull);
      CHECK(bench.server.force == kPull);
      bench.server.position = Vec3(0.1, 0.0, 0.3);
      bench.server.velocity = Vec3(0.0, -0.5, 0.0);
      bench.step(*device, kPull);
      const DeviceSample sample = bench.step(*device, kPull);
      CHECK(sample.status == kDeviceReady);
      CHECK(sample.position == Vec3(0.1, 0.0, 0.3));
      CHECK(sample.velocity == Vec3(0.0, -0.5, 0.0));
      CHECK(sample.buttons == 1);
      CHECK(sample.orientation == Mat3::Identity());
      CHECK(bench.server.masked_wrong == 0);
    }
  }

  TEST_CASE("Inverse3: another id is another device; who only reads keeps the service talking") {
    Bench bench;
    Inverse3Options options = bench.options();
    options.id = "BEEF";
    CHECK(bench.problem(options).find("has no Inverse3 'BEEF'") != std::string::npos);
    const auto device = bench.open();
    for (int i = 0; i < 100; ++i) {
      fake_now += 1e-3;
      bench.server.position = Vec3(0.0, 0.0, 1e-3 * i);
      bench.server.pump();
      CHECK(device->read().status == kDeviceReady);
      bench.server.pump();
    }
    CHECK(bench.server.probes >= 30);
    CHECK(bench.server.forces == 0);
    CHECK(device->read().position.z() > 0.09);
  }

  TEST_CASE("Inverse3: what --diagnose says") {
    const ScopedVariable variable(kInverse3AddressVariable, "127.0.0.1:1");
    const DriverReport report = inverse3_driver().probe();
    CHECK(report.why_not == "no Inverse Service answers at 127.0.0.1:1: Connection refused");
    CHECK(report.cure.find("haply-inverse-service") != std::string::npos);
    CHECK(report.findings.front().what == "GET /version at 127.0.0.1:1");
  }

  TEST_CASE("Inverse3: what --diagnose says of a service that is there") {
    // probe() waits for answers, so somebody else has to give them.
    FakeInverse service;
    service.accept = [](const std::string& key) { return websocket_accept(key); };
    const ScopedVariable variable(kInverse3AddressVariable, service.socket.address());
    std::atomic<bool> over = false;
    std::thread serving([&] {
      while (!over.load()) service.pump();
    });
    const DriverReport report = inverse3_driver().probe();
    over.store(true);
    serving.join();
    CHECK(report.available);
    REQUIRE(report.findings.size() >= 3);
    CHECK(report.findings[0].what == "GET /version at " + service.socket.address());
    CHECK(report.findings[0].found == "3.5.0");
    CHECK(report.findings[0].fine);
    CHECK(report.findings[1].what == "GET /version at 127.0.0.1:10000");
    CHECK(report.findings[2].found.find("049D") != std::string::npos);
  }
}

TEST_SUITE("safety") {
  TEST_CASE("Inverse3: what cannot be opened says why") {
    Bench bench;
    bench.server.present = false;
    CHECK(bench.problem(bench.options()).find("has no Inverse3") != std::string::npos);
    bench.server.accept = [](const std::string&) { return std::string("wrong"); };
    CHECK(bench.problem(bench.options()).find("it says: HTTP/1.1 101") != std::string::npos);
    bench.server.socket.refuse();
    CHECK(bench.problem(bench.options()).find("Connection refused") != std::string::npos);
  }

  TEST_CASE("Inverse3: fragments with a ping between, pings, long lengths make no difference") {
    for (int kind = 0; kind < 4; ++kind) {
      Bench bench;
      bench.server.fragmented = kind == 0;
      bench.server.ping_before_each = kind == 1;
      bench.server.length_code = kind == 2 ? 126 : kind == 3 ? 127 : 0;
      const auto device = bench.open();
      bench.server.position = Vec3(0.0, 0.1, 0.0);
      for (int i = 0; i < 5; ++i) bench.step(*device, kPull);
      const DeviceSample sample = bench.step(*device, kPull);
      CHECK(sample.status == kDeviceReady);
      CHECK(sample.position == Vec3(0.0, 0.1, 0.0));
      if (kind == 0) CHECK(bench.server.last_pong == "between");
      if (kind == 1) CHECK(bench.server.last_pong == "are you there");
      CHECK((kind > 1 || bench.server.pongs > 3));
    }
  }

  TEST_CASE("Inverse3: answers 20 ms late: no queue of old forces, no alarm") {
    Bench bench;
    const auto device = bench.open();
    bench.step(*device, kPull);
    bench.server.delay = 40;  // two pumps a step
    for (int i = 0; i < 200; ++i) CHECK(bench.step(*device, kPull).status == kDeviceReady);
    CHECK(bench.server.most_waiting <= 2);
    bench.server.delay = 0;
  }

  TEST_CASE("Inverse3: silence: disconnected after 0.1 s, a new connection after 2 s") {
    Bench bench;
    const auto device = bench.open();
    bench.server.position = Vec3(0.05, 0.0, 0.0);
    for (int i = 0; i < 5; ++i) bench.step(*device, kPull);
    bench.server.deaf = true;
    for (int i = 0; i < 110; ++i) bench.step(*device, kPull);
    CHECK(device->read().status == kDeviceDisconnected);
    CHECK(device->read().position == Vec3(0.05, 0.0, 0.0));
    CHECK(bench.server.force == Vec3::Zero());
    for (int i = 0; i < 3000; ++i) bench.step(*device, kPull);
    CHECK(bench.server.socket.connections >= 2);
    bench.server.deaf = false;
    for (int i = 0; i < 3000; ++i) bench.step(*device, kPull);
    CHECK(device->read().status == kDeviceReady);
    CHECK(bench.server.force == kPull);
  }

  TEST_CASE("Inverse3: unplugged from the service and back within a second; dropped and back") {
    Bench bench;
    const auto device = bench.open();
    for (int i = 0; i < 5; ++i) bench.step(*device, kPull);
    bench.server.present = false;
    for (int i = 0; i < 120; ++i) bench.step(*device, kPull);
    CHECK(device->read().status == kDeviceDisconnected);
    CHECK(bench.server.force == Vec3::Zero());
    for (int i = 0; i < 5000; ++i) bench.step(*device, kPull);
    CHECK(bench.server.asked_all >= 4);
    CHECK(bench.server.asked_all <= 6);
    CHECK(bench.server.socket.connections == 1);
    bench.server.present = true;
    for (int i = 0; i < 1010; ++i) bench.step(*device, kPull);
    CHECK(device->read().status == kDeviceReady);
    CHECK(bench.server.force == kPull);
    bench.server.socket.drop();
    CHECK(bench.step(*device, kPull).status == kDeviceDisconnected);
    for (int i = 0; i < 1010; ++i) bench.step(*device, kPull);
    CHECK(device->read().status == kDeviceReady);
    CHECK(bench.server.socket.connections == 2);
  }

  TEST_CASE("Inverse3: not ready, not calibrated: told, and no force") {
    Bench bench;
    const auto device = bench.open();
    for (int i = 0; i < 5; ++i) bench.step(*device, kPull);
    bench.server.ready = false;
    for (int i = 0; i < 5; ++i) bench.step(*device, kPull);
    CHECK(device->read().status == kDeviceForceOff);
    CHECK(bench.server.force == Vec3::Zero());
    bench.server.ready = true;
    bench.server.calibrated = false;
    for (int i = 0; i < 5; ++i) bench.step(*device, kPull);
    CHECK(device->read().status == kDeviceUncalibrated);
    CHECK(bench.server.force == Vec3::Zero());
    bench.server.calibrated = true;
    for (int i = 0; i < 5; ++i) bench.step(*device, kPull);
    CHECK(device->read().status == kDeviceReady);
    CHECK(bench.server.force == kPull);
  }

  TEST_CASE("Inverse3: nonsense is no state; too much is cut; closing leaves no force") {
    Bench bench;
    auto device = bench.open();
    for (int i = 0; i < 5; ++i) bench.step(*device, kPull);
    bench.server.position = Vec3(1e6, 0.0, 0.0);
    for (int i = 0; i < 110; ++i) CHECK(bench.step(*device, kPull).position == Vec3::Zero());
    CHECK(device->read().status == kDeviceDisconnected);
    bench.server.position = Vec3::Zero();
    for (int i = 0; i < 1010; ++i) bench.step(*device, kPull);
    bench.step(*device, Vec3(0.0, 1e9, 0.0));
    CHECK(bench.server.force.norm() == doctest::Approx(10.0).epsilon(1e-8));  // nine digits
    CHECK(bench.step(*device, kPull).status == kDeviceSaturated);
    bench.step(*device, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    CHECK(bench.server.force == Vec3::Zero());
    bench.step(*device, kPull);
    CHECK(bench.server.force == kPull);
    device.reset();
    bench.server.pump();
    CHECK(bench.server.force == Vec3::Zero());
    CHECK(bench.server.closes == 1);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("Inverse3: reading, writing, losing and finding again allocate nothing") {
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
