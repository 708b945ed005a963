// A VRPN client without its socket: bytes in, the state of one remote device out.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/device-protocols.md, "VRPN".
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "fuai/device/vrpn_wire.h"

namespace fuai {

/// What a server has said of a device, in the server's axes.
struct VrpnState {
  Vec3 position = Vec3::Zero();  ///< [m]
  /// [m/s]; not a number until there is one.
  Vec3 velocity = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Mat3 orientation = Mat3::Identity();
  std::uint32_t buttons = 0;
  int force_error = 4;        ///< as the server numbers them; 4: fine
  bool poses = false;         ///< there has been one
  bool knows_device = false;  ///< the server has described a sender of this name
  bool knows_forces = false;  ///< and the messages of a force device
  std::uint32_t pose_count = 0, message_count = 0, force_error_count = 0;
};

/// One device of one server.
class VrpnClient {
 public:
  /// @param name of the device on the server, up to 100 bytes. Thread class: set-up.
  explicit VrpnClient(std::string name);

  /// Before a new connection. Thread class: real-time.
  void restart() noexcept;
  /// @return false when the connection must be closed: not VRPN, another version, a position that is no
  /// number. Thread class: real-time.
  bool take(std::span<const std::uint8_t> bytes) noexcept;
  const VrpnState& state() const noexcept { return state_; }
  /// Whether a cookie has come that is not of our version.
  bool wrong_version() const noexcept { return wrong_version_; }

  /// What to send at once after connecting: cookie and descriptions, wish for 1 kHz. Thread class: real-time.
  std::span<const std::uint8_t> greeting() const noexcept { return greeting_; }
  /// Messages to send; valid until the next call of any of these. Thread class: real-time.
  std::span<const std::uint8_t> force_field(const VrpnForceField& field) noexcept;
  std::span<const std::uint8_t> ping() noexcept;

  /// Collects the names of all senders too, at most 64: for messages to people. Thread class: set-up.
  void collect_names() { names_.reserve(kMostNames); }
  void stop_collecting() noexcept { std::vector<std::string>().swap(names_); }  // `= {}` keeps its room
  const std::vector<std::string>& names() const noexcept { return names_; }

 private:
  static constexpr std::size_t kMostNames = 64, kMostTypes = 512;
  void describe_type(std::int32_t id, std::string_view name) noexcept;
  void describe_sender(std::int32_t id, std::string_view name) noexcept;
  bool take_message(const VrpnMessage& message) noexcept;
  void take_buttons(std::span<const std::uint8_t> payload) noexcept;
  bool take_pose(std::span<const std::uint8_t> payload) noexcept;

  std::string name_;
  std::vector<std::uint8_t> greeting_;
  std::vector<std::string> names_;  // has room only when it is to collect
  VrpnReader reader_;
  VrpnState state_;
  bool wrong_version_ = false;
  std::int32_t sender_ = -1;                      // the server's number of our device
  std::array<std::uint8_t, kMostTypes> types_{};  // what the server's numbers mean
  std::array<std::uint8_t, 128> out_{};
};

}  // namespace fuai
