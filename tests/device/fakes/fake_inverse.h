// An Inverse Service with one device, written from the protocol's description and without the client's code.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <deque>
#include <functional>
#include <string>

#include "fake_stream_server.h"
#include "fuai/core/types.h"

namespace fuai_test {

/// One frame of a server's: not masked.
inline std::string server_frame(const std::string& payload, unsigned first = 0x81, int length_code = 0) {
  std::string bytes(1, static_cast<char>(first));
  const std::size_t size = payload.size();
  if (length_code == 127 || size > 65535) {
    bytes += '\x7f';
    for (int shift = 56; shift >= 0; shift -= 8)
      bytes += static_cast<char>(static_cast<std::uint64_t>(size) >> shift & 0xff);
  } else if (length_code == 126 || size > 125) {
    bytes += '\x7e';
    bytes += static_cast<char>(size >> 8);
    bytes += static_cast<char>(size & 0xff);
  } else {
    bytes += static_cast<char>(size);
  }
  return bytes + payload;
}

/// The service.
struct FakeInverse {
  FakeStreamServer socket;
  std::function<std::string(const std::string& key)> accept;  ///< what RFC 6455 answers to a key
  std::string id = "049D";
  fuai::Vec3 position = fuai::Vec3::Zero(), velocity = fuai::Vec3::Zero(), force = fuai::Vec3::Zero();
  bool present = true, ready = true, calibrated = true, omit_defaults = false;
  bool fragmented = false, deaf = false, ping_before_each = false;
  int length_code = 0;
  int delay = 0;  ///< pumps until an answer is sent
  int masked_wrong = 0, messages = 0, probes = 0, asked_all = 0, forces = 0, pongs = 0, closes = 0;
  int most_waiting = 0;  ///< answers that ever waited at a time
  std::string last_pong;

  std::string state(bool full) const {
    if (!present) return full ? R"({"session_id":1,"inverse3":[],"verse_grip":[]})" : "{}";
    std::string text = full ? R"({"session_id":1,)" : "{";
    text += R"("inverse3":[{"device_id":")" + id + R"(",)";
    if (full) text += R"("config":{"filters":{"force_gate":{"gain":0.3},"damping":{"scalar":0.0}}},)";
    text += R"("state":{"cursor_position":)" + vector(position) + R"(,"cursor_velocity":)" +
            vector(velocity) + R"(,"control_mode":"idle"})";
    if (full || !omit_defaults)
      text += std::string(R"(,"status":{"calibrated":)") + word(calibrated) +
              R"(,"in_use":true,"power_supply":true,"ready":)" + word(ready) + R"(,"started":true})";
    text += R"(}],"verse_grip":[{"device_id":"61BA","state":{"orientation":{"x":0,"y":0,"z":0,"w":1},)"
            R"("hall":3,"button":true}}]})";
    return text;
  }
  /// Takes what has come, answers what is due.
  void pump() {
    if (socket.pump()) open_ = false;
    if (!open_ && !(socket.connected() && handshake())) return;
    listen();  // also to the last words of a connection that has ended
    for (int& wait : waiting_) --wait;
    while (!waiting_.empty() && waiting_.front() < 0) {
      waiting_.pop_front();
      answer(false);
    }
  }
  void answer(bool full) {
    if (deaf) return;
    if (ping_before_each) socket.send(server_frame("are you there", 0x89));
    const std::string text = state(full);
    if (!fragmented) return socket.send(server_frame(text, 0x81, length_code));
    socket.send(server_frame(text.substr(0, 10), 0x01));
    socket.send(server_frame("between", 0x89));
    socket.send(server_frame("", 0x00));
    socket.send(server_frame(text.substr(10, 20), 0x00));
    socket.send(server_frame(text.substr(30), 0x80));
  }

 private:
  static const char* word(bool value) { return value ? "true" : "false"; }
  std::string vector(const fuai::Vec3& v) const {
    std::string text = "{";
    for (int i = 0; i < 3; ++i) {
      if (omit_defaults && v[i] == 0.0) continue;
      char number[64];
      std::snprintf(number, sizeof number, "%s\"%c\":%.17g", text.size() > 1 ? "," : "", "xyz"[i], v[i]);
      text += number;
    }
    return text + "}";
  }
  bool handshake() {
    const std::string in(socket.received.begin(), socket.received.end());
    if (in.find("\r\n\r\n") == std::string::npos) return false;
    if (in.rfind("GET /version", 0) == 0) {
      socket.send("HTTP/1.1 200 OK\r\nContent-Type: text/plain\r\n\r\n3.5.0");
      socket.drop();
      return false;
    }
    const std::string name = "Sec-WebSocket-Key: ";
    const std::size_t at = in.find(name) + name.size();
    const std::string key = in.substr(at, in.find("\r\n", at) - at);
    socket.received.clear();
    socket.send(
        "HTTP/1.1 101 Switching Protocols\r\nupgrade: WebSocket\r\nConnection: Upgrade\r\n"
        "sec-websocket-accept:  " +
        accept(key) + "\r\n\r\n");
    open_ = true;
    waiting_.clear();
    answer(true);
    return true;
  }
  void listen() {
    std::vector<std::uint8_t>& in = socket.received;
    for (;;) {
      if (in.size() < 6) return;
      if ((in[1] & 0x80) == 0) ++masked_wrong;
      std::size_t size = in[1] & 0x7f, at = 2;
      if (size == 126) {
        size = static_cast<std::size_t>(in[2]) << 8 | in[3];
        at = 4;
      }
      if (in.size() < at + 4 + size) return;
      std::string text;
      for (std::size_t i = 0; i < size; ++i) text += static_cast<char>(in[at + 4 + i] ^ in[at + i % 4]);
      const unsigned opcode = in[0] & 0x0f;
      in.erase(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(at + 4 + size));
      if (opcode == 10) last_pong = text;
      pongs += opcode == 10 ? 1 : 0;
      closes += opcode == 8 ? 1 : 0;
      if (opcode == 1) take(text);
    }
  }
  void take(const std::string& text) {
    ++messages;
    if (text.find("force_render_full_state") != std::string::npos) {
      ++asked_all;
      return answer(true);
    }
    if (text.find("\"device_id\":\"" + id + "\"") == std::string::npos) return;
    if (text.find("probe_position") != std::string::npos) ++probes;
    if (text.find("set_cursor_force") != std::string::npos) {
      ++forces;
      for (int i = 0; i < 3; ++i) {
        const std::string name = {'"', "xyz"[i], '"', ':'};
        force[i] = std::strtod(text.c_str() + text.find(name) + name.size(), nullptr);
      }
    }
    if (deaf) return;
    waiting_.push_back(delay);
    most_waiting = std::max(most_waiting, static_cast<int>(waiting_.size()));
  }
  bool open_ = false;
  std::deque<int> waiting_;
};

}  // namespace fuai_test
