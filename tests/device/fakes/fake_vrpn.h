// A VRPN server with one device, written from the protocol's description and without the client's code.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "fake_stream_server.h"
#include "fuai/core/types.h"

namespace fuai_test {

using Bytes = std::vector<std::uint8_t>;

/// Big-endian numbers at the end of bytes.
inline void put32(Bytes& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}
inline void put64(Bytes& bytes, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  put32(bytes, static_cast<std::uint32_t>(bits >> 32));
  put32(bytes, static_cast<std::uint32_t>(bits));
}
inline std::uint32_t get32(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) << 24 | static_cast<std::uint32_t>(bytes[at + 1]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 8 | bytes[at + 3];
}

/// One message with its padding.
inline Bytes vrpn_message(int sender, int type, const Bytes& payload) {
  Bytes bytes;
  put32(bytes, static_cast<std::uint32_t>(24 + payload.size()));
  for (int i = 0; i < 2; ++i) put32(bytes, 7);  // time
  put32(bytes, static_cast<std::uint32_t>(sender));
  put32(bytes, static_cast<std::uint32_t>(type));
  put32(bytes, 99);  // number
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  while (bytes.size() % 8 != 0) bytes.push_back(0);
  return bytes;
}
inline Bytes vrpn_description(int what, int id, const std::string& name) {
  Bytes payload;
  put32(payload, static_cast<std::uint32_t>(name.size() + 1));
  payload.insert(payload.end(), name.begin(), name.end());
  payload.push_back(0);
  return vrpn_message(id, what, payload);
}

/// The server.
struct FakeVrpn {
  static constexpr int kPose = 5, kVelocity = 3, kButton = 2, kForce = 8, kForceError = 11, kButtons = 12;

  FakeStreamServer socket;
  std::string cookie = std::string("vrpn: ver. 07.35  0") + std::string(5, '\0');
  std::string name = "Phantom0";
  int id = 4;
  bool types_first = true, udp = true, silent = false, forces = true;
  std::size_t pieces = 0;  ///< bytes at a time; 0: all at once
  fuai::Vec3 position = fuai::Vec3::Zero();
  // What the client wants.
  std::map<int, std::string> client_senders, client_types;
  fuai::Vec3 origin = fuai::Vec3::Zero(), force = fuai::Vec3::Zero();
  double radius = 0.0;
  int fields = 0, pings = 0;
  double rate = 0.0;

  void say(const Bytes& bytes) {
    const std::size_t step = pieces == 0 ? bytes.size() : pieces;
    for (std::size_t at = 0; at < bytes.size(); at += step)
      socket.send(std::span(bytes).subspan(at, std::min(step, bytes.size() - at)));
  }
  /// Accepts, greets, understands what has come, says where the device is.
  void pump() {
    if (socket.pump()) {
      greeted_ = false;
      client_senders.clear();
      client_types.clear();
    }
    if (socket.connected() && !greeted_) greet();
    listen();  // also to the last words of a connection that has ended
    if (socket.connected() && !silent) pose(position);
  }
  void pose(const fuai::Vec3& where, const std::array<double, 4>& turn = {0, 0, 0, 1}) {
    Bytes payload(8, 0);
    for (int i = 0; i < 3; ++i) put64(payload, where[i]);
    for (const double q : turn) put64(payload, q);
    say(vrpn_message(id, kPose, payload));
  }
  /// As the PHANToM server does: about the origin, cut to 10 N.
  fuai::Vec3 felt() const {
    if (!socket.connected() || (position - origin).norm() > radius) return fuai::Vec3::Zero();
    return force.norm() > 10.0 ? fuai::Vec3(10.0 * force.normalized()) : force;
  }
  void describe() {
    if (udp) say(vrpn_message(3883, -3, {'1', '2', '7', '.', '0', '.', '0', '.', '1', 0}));
    const auto types = [&] {
      say(vrpn_description(-2, 0, "vrpn_Base ping_message"));
      say(vrpn_description(-2, kPose, "vrpn_Tracker Pos_Quat"));
      say(vrpn_description(-2, kVelocity, "vrpn_Tracker Velocity"));
      say(vrpn_description(-2, kButton, "vrpn_Button Change"));
      say(vrpn_description(-2, kButtons, "vrpn_Button States"));
      if (forces) say(vrpn_description(-2, kForce, "vrpn_ForceDevice Force"));
      if (forces) say(vrpn_description(-2, kForceError, "vrpn_ForceDevice Force_Error"));
    };
    if (types_first) types();
    say(vrpn_description(-1, 0, "VRPN Control"));
    say(vrpn_description(-1, id, name));
    say(vrpn_description(-1, 9, "a sender whose name is longer than a short string"));
    if (!types_first) types();
  }

 private:
  void greet() {
    greeted_ = true;
    cookie_taken_ = false;
    say(Bytes(cookie.begin(), cookie.end()));
    describe();
  }
  void listen() {
    Bytes& in = socket.received;
    if (!cookie_taken_) {
      if (in.size() < 24) return;
      in.erase(in.begin(), in.begin() + 24);
      cookie_taken_ = true;
    }
    while (in.size() >= 24) {
      const std::size_t length = get32(in, 0), whole = (length + 7) / 8 * 8;
      if (in.size() < whole) return;
      take(static_cast<int>(get32(in, 12)), static_cast<int>(get32(in, 16)),
           Bytes(in.begin() + 24, in.begin() + static_cast<std::ptrdiff_t>(length)));
      in.erase(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(whole));
    }
  }
  void take(int sender, int type, const Bytes& payload) {
    if (type < 0) {
      (type == -1 ? client_senders : client_types)[sender] =
          std::string(payload.begin() + 4, payload.end() - 1);
      return;
    }
    if (client_senders[sender] != name) return;
    if (client_types[type] == "vrpn_Base ping_message") ++pings;
    if (client_types[type] == "vrpn_Tracker set_update_rate")
      rate = std::bit_cast<double>(static_cast<std::uint64_t>(get32(payload, 0)) << 32 | get32(payload, 4));
    if (client_types[type] != "vrpn_ForceDevice Force_Field") return;
    ++fields;
    const auto number = [&](std::size_t i) {
      return static_cast<double>(std::bit_cast<float>(get32(payload, 4 * i)));
    };
    origin = fuai::Vec3(number(0), number(1), number(2));
    force = fuai::Vec3(number(3), number(4), number(5));
    radius = number(15);
  }
  bool greeted_ = false, cookie_taken_ = false;
};

}  // namespace fuai_test
