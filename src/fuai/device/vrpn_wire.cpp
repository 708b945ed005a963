// Reads and writes VRPN's bytes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/vrpn_wire.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace fuai {
namespace {

constexpr std::string_view kCookie = "vrpn: ver. 07.38  0";
/// What both sides must have in common: through the last point.
constexpr std::size_t kMajor = std::string_view("vrpn: ver. 07.").size();

std::uint32_t read_word(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes[at + i];
  return value;
}

void write_word(std::span<std::uint8_t> bytes, std::size_t at, std::uint32_t value) noexcept {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

constexpr std::size_t padded(std::size_t size) noexcept { return (size + 7) / 8 * 8; }

}  // namespace

std::array<std::uint8_t, kVrpnCookieSize> vrpn_cookie() noexcept {
  std::array<std::uint8_t, kVrpnCookieSize> cookie{};
  std::copy(kCookie.begin(), kCookie.end(), cookie.begin());
  return cookie;
}

bool is_good_vrpn_cookie(std::span<const std::uint8_t> cookie) noexcept {
  return cookie.size() >= kMajor && std::equal(kCookie.begin(), kCookie.begin() + kMajor, cookie.begin());
}

void VrpnReader::restart() noexcept {
  cookie_seen_ = done_ = false;
  have_ = skip_ = 0;
}

/// Until the buffer holds `wanted` bytes.
bool VrpnReader::fill(std::span<const std::uint8_t>& bytes, std::size_t wanted) noexcept {
  const std::size_t more = std::min(wanted - have_, bytes.size());
  std::copy_n(bytes.begin(), more, buffer_.begin() + static_cast<std::ptrdiff_t>(have_));
  have_ += more;
  bytes = bytes.subspan(more);
  return have_ == wanted;
}

VrpnRead VrpnReader::read(std::span<const std::uint8_t>& bytes, VrpnMessage& message) noexcept {
  if (!cookie_seen_) {
    if (have_ < kVrpnCookieSize && !fill(bytes, kVrpnCookieSize)) return VrpnRead::kNothing;
    if (!is_good_vrpn_cookie({buffer_.data(), kVrpnCookieSize})) return VrpnRead::kBad;
    cookie_seen_ = true;
    have_ = 0;
    return VrpnRead::kCookie;
  }
  for (;;) {
    if (done_) have_ = 0;  // the last message has been looked at
    done_ = false;
    if (skip_ > 0) {
      const std::size_t less = std::min(skip_, bytes.size());
      skip_ -= less;
      bytes = bytes.subspan(less);
      if (skip_ > 0) return VrpnRead::kNothing;
    }
    if (have_ < kVrpnHeaderSize && !fill(bytes, kVrpnHeaderSize)) return VrpnRead::kNothing;
    const std::span<const std::uint8_t> all(buffer_);
    const std::uint32_t length = read_word(all, 0);
    if (length < kVrpnHeaderSize || length > kVrpnHeaderSize + kVrpnMostSkipped) return VrpnRead::kBad;
    const std::size_t payload = length - kVrpnHeaderSize;
    if (payload > kVrpnMostPayload) {
      skip_ = padded(payload);
      have_ = 0;
      continue;
    }
    if (have_ < kVrpnHeaderSize + padded(payload) && !fill(bytes, kVrpnHeaderSize + padded(payload)))
      return VrpnRead::kNothing;
    message.sender = read_vrpn_int(all, 12);
    message.type = read_vrpn_int(all, 16);
    message.payload = all.subspan(kVrpnHeaderSize, payload);
    done_ = true;
    return VrpnRead::kMessage;
  }
}

std::span<const std::uint8_t> write_vrpn_message(std::span<std::uint8_t> out, std::int32_t sender,
                                                 std::int32_t type,
                                                 std::span<const std::uint8_t> payload) noexcept {
  const std::size_t size = kVrpnHeaderSize + padded(payload.size());
  if (payload.size() > kVrpnMostPayload || size > out.size()) return {};
  const std::span<std::uint8_t> message = out.first(size);
  std::fill(message.begin(), message.end(), std::uint8_t{0});
  write_word(message, 0, static_cast<std::uint32_t>(kVrpnHeaderSize + payload.size()));
  // Time and number stay zero: servers use neither for what is sent here.
  write_word(message, 12, static_cast<std::uint32_t>(sender));
  write_word(message, 16, static_cast<std::uint32_t>(type));
  std::copy(payload.begin(), payload.end(), message.begin() + kVrpnHeaderSize);
  return message;
}

std::span<const std::uint8_t> write_vrpn_description(std::span<std::uint8_t> out, VrpnSystemType what,
                                                     std::int32_t id, std::string_view name) noexcept {
  std::array<std::uint8_t, 4 + 128> payload{};
  if (name.size() + 1 > payload.size() - 4) return {};
  write_word(payload, 0, static_cast<std::uint32_t>(name.size() + 1));  // with the zero at its end
  std::copy(name.begin(), name.end(), payload.begin() + 4);
  return write_vrpn_message(out, id, what, std::span(payload).first(4 + name.size() + 1));
}

std::string_view read_vrpn_description(std::span<const std::uint8_t> payload) noexcept {
  if (payload.size() < 5) return {};
  const std::size_t size = std::min<std::size_t>(read_word(payload, 0), payload.size() - 4);
  const std::string_view text(reinterpret_cast<const char*>(payload.data()) + 4, size);
  return text.substr(0, text.find('\0'));
}

std::array<std::uint8_t, 64> vrpn_force_field(const VrpnForceField& field) noexcept {
  std::array<std::uint8_t, 64> bytes{};
  std::size_t at = 0;
  const auto put = [&](double value) {
    write_word(bytes, at, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
    at += 4;
  };
  for (int i = 0; i < 3; ++i) put(field.origin[i]);
  for (int i = 0; i < 3; ++i) put(field.force[i]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) put(field.jacobian(i, j));
  put(field.radius);
  return bytes;
}

std::int32_t read_vrpn_int(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  return static_cast<std::int32_t>(read_word(bytes, at));
}

double read_vrpn_double(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  const std::uint64_t high = read_word(bytes, at), low = read_word(bytes, at + 4);
  return std::bit_cast<double>(high << 32 | low);
}

}  // namespace fuai
