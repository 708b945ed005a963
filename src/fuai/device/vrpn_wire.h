// VRPN's messages as bytes: cookie, header, descriptions, the few payloads that a hand needs.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/device-protocols.md, "VRPN".
//
//   cookie (24 bytes), then messages: header of six big-endian 32-bit numbers {length, sec, usec, sender,
//   type, seq}, payload, zeros up to a multiple of 8. length = 24 + payload without the zeros.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "fuai/core/types.h"

namespace fuai {

inline constexpr std::size_t kVrpnCookieSize = 24, kVrpnHeaderSize = 24;
/// Longest payload that is kept; longer ones (text, images) are passed over.
inline constexpr std::size_t kVrpnMostPayload = 1024;
/// Longest that is believed at all; more is the end of the connection.
inline constexpr std::size_t kVrpnMostSkipped = 1 << 20;

/// Types that the protocol itself uses.
enum VrpnSystemType : std::int32_t { kVrpnSenderDescription = -1, kVrpnTypeDescription = -2 };

/// "vrpn: ver. 07.38  0" and zeros. Thread class: real-time.
std::array<std::uint8_t, kVrpnCookieSize> vrpn_cookie() noexcept;
/// Whether the other side speaks our major version. @param cookie kVrpnCookieSize bytes.
bool is_good_vrpn_cookie(std::span<const std::uint8_t> cookie) noexcept;

/// A message that has come. The payload is the reader's, until its next call.
struct VrpnMessage {
  std::int32_t sender = 0, type = 0;
  std::span<const std::uint8_t> payload;
};

enum class VrpnRead {
  kNothing,  ///< all bytes are used up
  kCookie,   ///< a good cookie
  kMessage,  ///< `message` is filled
  kBad       ///< not VRPN, another version, or an impossible length: close
};

/// Puts messages together from bytes that come in any pieces. Keeps at most one message.
class VrpnReader {
 public:
  /// Before a new connection. Thread class: real-time.
  void restart() noexcept;
  /// Takes bytes from the front of `bytes` until one thing is complete. Call it until kNothing or kBad.
  /// Thread class: real-time.
  VrpnRead read(std::span<const std::uint8_t>& bytes, VrpnMessage& message) noexcept;

 private:
  bool fill(std::span<const std::uint8_t>& bytes, std::size_t wanted) noexcept;

  bool cookie_seen_ = false, done_ = false;
  std::size_t have_ = 0, skip_ = 0;
  std::array<std::uint8_t, kVrpnHeaderSize + kVrpnMostPayload> buffer_{};
};

/// Writes a message. @return the bytes used in `out`, empty when there is no room. Thread class: real-time.
std::span<const std::uint8_t> write_vrpn_message(std::span<std::uint8_t> out, std::int32_t sender,
                                                 std::int32_t type,
                                                 std::span<const std::uint8_t> payload) noexcept;
/// "id is called name". @param what kVrpnSenderDescription or kVrpnTypeDescription. Thread class: real-time.
std::span<const std::uint8_t> write_vrpn_description(std::span<std::uint8_t> out, VrpnSystemType what,
                                                     std::int32_t id, std::string_view name) noexcept;
/// The name in a description's payload; empty when it is none.
std::string_view read_vrpn_description(std::span<const std::uint8_t> payload) noexcept;

/// A force about a point: F + J (p - origin) within the radius, else none. Coordinates are the server's.
struct VrpnForceField {
  Vec3 origin = Vec3::Zero();    ///< [m]
  Vec3 force = Vec3::Zero();     ///< [N]
  Mat3 jacobian = Mat3::Zero();  ///< [N/m]
  double radius = 0.0;           ///< [m]
};
/// 16 floats. Thread class: real-time.
std::array<std::uint8_t, 64> vrpn_force_field(const VrpnForceField& field) noexcept;

/// Big-endian numbers in payloads; the caller has checked that they are there. Thread class: real-time.
std::int32_t read_vrpn_int(std::span<const std::uint8_t> bytes, std::size_t at) noexcept;
double read_vrpn_double(std::span<const std::uint8_t> bytes, std::size_t at) noexcept;

}  // namespace fuai
