// Events of input devices as bytes: spacenavd's socket and the kernel's joystick nodes.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/device-protocols.md, "spacenav" and "Gamepads".
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "fuai/core/types.h"

namespace fuai {

/// Puts records of N bytes together from bytes that come in any pieces.
template <std::size_t N>
class RecordReader {
 public:
  void restart() noexcept { have_ = 0; }
  /// Takes bytes from the front. @return whether record() is complete; call it until it is not.
  /// Thread class: real-time.
  bool read(std::span<const std::uint8_t>& bytes) noexcept {
    if (have_ == N) have_ = 0;
    while (have_ < N && !bytes.empty()) {
      record_[have_++] = bytes.front();
      bytes = bytes.subspan(1);
    }
    return have_ == N;
  }
  /// A number of this machine's byte order at a place of the record.
  template <class T>
  T number(std::size_t at) const noexcept {
    T value;
    std::memcpy(&value, record_.data() + at, sizeof value);
    return value;
  }

 private:
  std::array<std::uint8_t, N> record_{};
  std::size_t have_ = 0;
};

/// What an input says: how far it is pushed, in our axes, which buttons are down.
struct InputState {
  Vec3 deflection = Vec3::Zero();  ///< about -1 to 1
  std::uint32_t buttons = 0;
  double pinch = 0.0;  ///< 0 to 1
};

inline void set_button(InputState& state, std::int32_t number, bool down) noexcept {
  if (number < 0 || number > 31) return;
  const std::uint32_t bit = std::uint32_t{1} << number;
  state.buttons = down ? state.buttons | bit : state.buttons & ~bit;
}

/// spacenavd: eight 32-bit numbers an event; 0: motion x y z rx ry rz period, 1: press, 2: release of a
/// button.
class SpacenavReader {
 public:
  static constexpr double kFull = 350.0;  ///< of a 3D mouse pushed as far as it goes
  void restart() noexcept {
    records_.restart();
    state_ = {};
  }
  /// @return false when this is no spacenavd. Thread class: real-time.
  bool take(std::span<const std::uint8_t> bytes) noexcept {
    while (records_.read(bytes)) {
      const auto kind = records_.number<std::int32_t>(0);
      const auto first = records_.number<std::int32_t>(4), second = records_.number<std::int32_t>(8),
                 third = records_.number<std::int32_t>(12);
      // Other kinds tell of devices and settings; beyond a few there are none.
      if (kind < 0 || kind > 63) return false;
      // Its x is right, y up, z away.
      if (kind == 0) state_.deflection = Vec3(first, third, second) / kFull;
      if (kind == 1 || kind == 2) set_button(state_, first, kind == 1);
    }
    return true;
  }
  const InputState& state() const noexcept { return state_; }

 private:
  RecordReader<32> records_;
  InputState state_;
};

/// A joystick node: 32-bit time, 16-bit value, kind (1 button, 2 axis, +128 at the beginning), number.
/// Left stick: x and y; right stick: z; right trigger: pinch; as the kernel numbers common gamepads.
class JoystickReader {
 public:
  void restart() noexcept {
    records_.restart();
    state_ = {};
  }
  /// Thread class: real-time.
  void take(std::span<const std::uint8_t> bytes) noexcept {
    while (records_.read(bytes)) {
      const double value = records_.number<std::int16_t>(4) / 32767.0;
      const unsigned kind = records_.number<std::uint8_t>(6) & 0x7fu;
      const unsigned number = records_.number<std::uint8_t>(7);
      if (kind == 1) set_button(state_, static_cast<std::int32_t>(number), value != 0.0);
      if (kind != 2) continue;
      if (number == 0) state_.deflection.x() = value;
      if (number == 1) state_.deflection.y() = -value;  // theirs is down
      if (number == 4) state_.deflection.z() = -value;
      if (number == 5) state_.pinch = std::min(1.0, std::max(0.0, 0.5 * (value + 1.0)));
    }
  }
  const InputState& state() const noexcept { return state_; }

 private:
  RecordReader<8> records_;
  InputState state_;
};

}  // namespace fuai
