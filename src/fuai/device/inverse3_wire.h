// The Inverse Service's messages as text: what it says of one Inverse3 and its grip, what it is told.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/device-protocols.md, "Inverse Service".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "fuai/core/types.h"

namespace fuai {

/// A device's id: letters, digits, '-', '_', '.', up to 31.
struct Inverse3Id {
  std::array<char, 32> letters{};
  std::string_view text() const noexcept { return {letters.data()}; }
  /// @return false, and nothing changes, for an id that cannot be one.
  bool set(std::string_view id) noexcept;
};

/// What is known of one device. Coordinates are the service's.
struct Inverse3State {
  Inverse3Id id;                        ///< empty: none has been seen
  Vec3 position = Vec3::Zero();         ///< of the cursor [m]
  Vec3 velocity = Vec3::Zero();         ///< [m/s]
  Mat3 orientation = Mat3::Identity();  ///< of the first grip
  std::uint32_t buttons = 0;            ///< of the first grip
  bool calibrated = false, powered = false, ready = false, started = false;
  double force_gate = -1.0,
         damping = -1.0;    ///< filters of the service that change what is felt; -1: not told
  std::uint32_t count = 0;  ///< messages that had a state of it
};

/// Takes one message. @param wanted the id of the device to follow; empty: the first one that is seen
/// @return false for what is not JSON or has a position or velocity beyond reason (1 km, 1 km/s): nothing is
/// taken from it. Thread class: real-time.
bool read_inverse3_message(std::string_view json, std::string_view wanted, Inverse3State& state) noexcept;

/// "Force on this device", [N] in the service's coordinates. @return empty when there is no room.
/// Thread class: real-time.
std::string_view write_inverse3_force(std::span<char> out, std::string_view id, const Vec3& force) noexcept;
/// "Where is it?", without a force. Thread class: real-time.
std::string_view write_inverse3_probe(std::span<char> out, std::string_view id) noexcept;
/// "Tell everything again": where there is no device yet.
inline constexpr std::string_view kInverse3AskAll = R"({"session":{"force_render_full_state":{}}})";

}  // namespace fuai
