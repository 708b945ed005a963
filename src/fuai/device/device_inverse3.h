// Haply's Inverse3 by the WebSocket of its Inverse Service.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/devices.md, "Inverse3"; docs/theory/device-protocols.md.
//
//   1. The service answers each message with one state: write() sends a force, and read() takes what has
//   come.
//   2. At most two messages are without an answer: a service that stands still gets no queue of old forces.
//   3. No state for 0.1 s: samples say disconnected, forces are zero. For 2 s, or when the connection ends:
//   it is
//      made again, once a second. read() and write() never wait.
//   4. While it has no device the service is asked once a second.
#pragma once

#include <functional>
#include <string>

#include "fuai/device/device.h"
#include "fuai/device/device_clock.h"
#include "fuai/device/inverse3_wire.h"
#include "fuai/device/registry.h"
#include "fuai/device/stream_socket.h"
#include "fuai/device/websocket_wire.h"

namespace fuai {

/// "host:port" in the environment, where the service is looked for when no address is given.
inline constexpr const char* kInverse3AddressVariable = "FUAI_INVERSE3_ADDRESS";

/// Which device of which service, and how to wait for it.
struct Inverse3Options {
  std::string id;  ///< empty: the first
  std::string host = "localhost";
  std::string port = "10001";
  double patience = 2.0;  ///< for the first answer, at opening [s]
  DeviceClock clock = steady_seconds;
  std::function<void()> idle;  ///< called instead of waiting while it opens; for tests
};
/// "host:port" or "ID@host:port" or "ID@"; the rest from the environment or the defaults.
/// @throws Error (kUsage). Thread class: set-up.
Inverse3Options parse_inverse3_name(const std::string& text);

/// One Inverse3.
class DeviceInverse3 final : public Device {
 public:
  /// @throws Error (kNoDevice) without a service or without the device. Thread class: set-up.
  explicit DeviceInverse3(const Inverse3Options& options);
  ~DeviceInverse3() override;

  const DeviceInfo& info() const noexcept override { return info_; }
  DeviceSample read() noexcept override;
  void write(const DeviceCommand& command) noexcept override;

 private:
  void listen(double now) noexcept;
  void take(std::span<const std::uint8_t> bytes, double now) noexcept;
  void ask(double now) noexcept;
  bool send(WebSocketOpcode opcode, std::string_view payload) noexcept;
  bool send_counted(std::string_view message, double now) noexcept;
  bool trusted(double now) const noexcept {
    return open_ && socket_.connected() && counted_ > 0 && now - stated_ <= kStale;
  }
  std::uint32_t status() const noexcept;
  std::string problem() const;

  static constexpr double kStale = 0.1;  ///< [s]

  Inverse3Options options_;
  StreamAddress address_;
  StreamSocket socket_;
  WebSocketReader reader_;
  std::string request_, accept_;  // of the handshake; the key is not renewed, as nothing is secret
  Inverse3State state_;
  DeviceInfo info_;
  RetryTimer retry_, ask_;
  bool asked_ = false, open_ = false, saturated_ = false, forced_ = false, bad_ = false;
  int unanswered_ = 0, messages_ = 0;
  std::uint32_t mask_ = 1, counted_ = 0;
  double heard_ = 0.0, stated_ = 0.0, sent_ = 0.0;  // [s]
  std::array<std::uint8_t, 512> frame_{};
  std::array<char, 400> text_{};
  DeviceSample last_;
};

}  // namespace fuai
