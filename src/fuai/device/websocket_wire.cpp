// Reads and writes WebSocket bytes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/websocket_wire.h"

#include <algorithm>
#include <bit>

namespace fuai {
namespace {

/// @source FIPS 180-4, 6.1; here only to prove that the server speaks WebSocket, which is no secret.
std::array<std::uint8_t, 20> sha1(std::string_view text) {
  std::string bytes(text);
  bytes.push_back('\x80');
  while (bytes.size() % 64 != 56) bytes.push_back('\0');
  const std::uint64_t bits = std::uint64_t{text.size()} * 8;
  for (int shift = 56; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(bits >> shift & 0xff));
  std::array<std::uint32_t, 5> h{0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476, 0xc3d2e1f0};
  for (std::size_t block = 0; block < bytes.size(); block += 64) {
    std::array<std::uint32_t, 80> w{};
    for (std::size_t i = 0; i < 64; ++i)
      w[i / 4] = w[i / 4] << 8 | static_cast<std::uint8_t>(bytes[block + i]);
    for (std::size_t i = 16; i < 80; ++i) w[i] = std::rotl(w[i - 3] ^ w[i - 8] ^ w[i - 14] ^ w[i - 16], 1);
    auto [a, b, c, d, e] = h;
    for (std::size_t i = 0; i < 80; ++i) {
      const std::uint32_t f = i < 20   ? (b & c) | (~b & d)
                              : i < 40 ? b ^ c ^ d
                              : i < 60 ? (b & c) | (b & d) | (c & d)
                                       : b ^ c ^ d;
      constexpr std::array<std::uint32_t, 4> k{0x5a827999, 0x6ed9eba1, 0x8f1bbcdc, 0xca62c1d6};
      const std::uint32_t next = std::rotl(a, 5) + f + e + k[i / 20] + w[i];
      e = d;
      d = c;
      c = std::rotl(b, 30);
      b = a;
      a = next;
    }
    h = {h[0] + a, h[1] + b, h[2] + c, h[3] + d, h[4] + e};
  }
  std::array<std::uint8_t, 20> digest{};
  for (std::size_t i = 0; i < 20; ++i) digest[i] = static_cast<std::uint8_t>(h[i / 4] >> (24 - 8 * (i % 4)));
  return digest;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t j = 0; j < 3; ++j) three = three << 8 | (i + j < bytes.size() ? bytes[i + j] : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j <= bytes.size() ? kLetters[three >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

constexpr char small(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_word(std::string_view a, std::string_view b) noexcept {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return small(x) == small(y); });
}

/// The value of a header line, without blanks around it; empty when there is none of this name.
std::string_view header_value(std::string_view text, std::string_view name) noexcept {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find("\r\n"), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 2, text.size()));
    const std::size_t colon = line.find(':');
    if (colon == line.npos || !same_word(line.substr(0, colon), name)) continue;
    line.remove_prefix(colon + 1);
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
    while (!line.empty() && (line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
    return line;
  }
  return {};
}

}  // namespace

std::string websocket_accept(std::string_view key) {
  return base64(sha1(std::string(key) + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"));
}

std::string websocket_key(const std::array<std::uint8_t, 16>& bytes) { return base64(bytes); }

std::string websocket_request(std::string_view host, std::string_view key) {
  return "GET / HTTP/1.1\r\nHost: " + std::string(host) +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: " + std::string(key) +
         "\r\nSec-WebSocket-Version: 13\r\n\r\n";
}

std::span<const std::uint8_t> write_websocket_frame(std::span<std::uint8_t> out, WebSocketOpcode opcode,
                                                    std::string_view payload, std::uint32_t mask) noexcept {
  const std::size_t length_bytes = payload.size() < 126 ? 0 : payload.size() < 65536 ? 2 : 8;
  const std::size_t size = 2 + length_bytes + 4 + payload.size();
  if (size > out.size()) return {};
  out[0] = static_cast<std::uint8_t>(0x80 | static_cast<unsigned>(opcode));
  out[1] = static_cast<std::uint8_t>(0x80 | (length_bytes == 0   ? payload.size()
                                             : length_bytes == 2 ? std::size_t{126}
                                                                 : std::size_t{127}));
  std::size_t at = 2;
  for (std::size_t i = length_bytes; i-- > 0;)
    out[at++] = static_cast<std::uint8_t>(std::uint64_t{payload.size()} >> (8 * i));
  const std::size_t mask_at = at;
  for (int shift = 24; shift >= 0; shift -= 8) out[at++] = static_cast<std::uint8_t>(mask >> shift);
  for (std::size_t i = 0; i < payload.size(); ++i)
    out[at++] = static_cast<std::uint8_t>(static_cast<std::uint8_t>(payload[i]) ^ out[mask_at + i % 4]);
  return out.first(size);
}

WebSocketReader::WebSocketReader(std::size_t most) : text_(most) {}

void WebSocketReader::restart(std::string_view accept) noexcept {
  std::fill(accept_.begin(), accept_.end(), '\0');
  std::copy_n(accept.begin(), std::min(accept.size(), accept_.size()), accept_.begin());
  phase_ = Phase::kHandshake;
  handshake_size_ = header_size_ = text_size_ = control_size_ = 0;
  left_ = 0;
  in_message_ = binary_ = told_ = false;
}

std::string_view WebSocketReader::first_line() const noexcept {
  const std::string_view all(handshake_.data(), handshake_size_);
  return all.substr(0, std::min(all.find_first_of("\r\n"), std::size_t{80}));
}

/// @return true when the empty line has come
bool WebSocketReader::take_handshake(std::span<const std::uint8_t>& bytes) noexcept {
  while (!bytes.empty() && handshake_size_ < handshake_.size()) {
    handshake_[handshake_size_++] = static_cast<char>(bytes.front());
    bytes = bytes.subspan(1);
    if (std::string_view(handshake_.data(), handshake_size_).ends_with("\r\n\r\n")) return true;
  }
  if (handshake_size_ == handshake_.size()) phase_ = Phase::kBad;
  return false;
}

bool WebSocketReader::good_handshake() const noexcept {
  const std::string_view all(handshake_.data(), handshake_size_);
  return all.starts_with("HTTP/1.1 101") && same_word(header_value(all, "Upgrade"), "websocket") &&
         header_value(all, "Sec-WebSocket-Accept") == std::string_view(accept_.data(), accept_.size());
}

/// @return true when the frame's header is complete and allowed; kBad when it is not allowed
bool WebSocketReader::take_header(std::span<const std::uint8_t>& bytes) noexcept {
  const auto wanted = [&] {
    if (header_size_ < 2) return std::size_t{2};
    const unsigned code = header_[1] & 0x7fu;
    return code < 126 ? std::size_t{2} : code == 126 ? std::size_t{4} : std::size_t{10};
  };
  while (header_size_ < wanted()) {
    if (bytes.empty()) return false;
    header_[header_size_++] = bytes.front();
    bytes = bytes.subspan(1);
  }
  left_ = header_[1] & 0x7fu;
  if (header_size_ > 2) left_ = 0;
  for (std::size_t i = 2; i < header_size_; ++i) left_ = left_ << 8 | header_[i];
  header_size_ = 0;
  last_ = (header_[0] & 0x80) != 0;
  const unsigned code = header_[0] & 0x0fu;
  opcode_ = static_cast<WebSocketOpcode>(code);
  const bool control = code >= 8;
  const bool known = code <= 2 || (code >= 8 && code <= 10);
  const bool reserved = (header_[0] & 0x70) != 0, masked = (header_[1] & 0x80) != 0;
  phase_ = Phase::kBad;
  if (!known || reserved || masked) return false;
  if (control && (!last_ || left_ > control_.size())) return false;
  // A continuation needs a beginning, a beginning the end of the last message.
  if (!control && (opcode_ == WebSocketOpcode::kContinuation) != in_message_) return false;
  if (!control && left_ > text_.size() - text_size_) return false;
  if (!control) {
    if (!in_message_) binary_ = opcode_ == WebSocketOpcode::kBinary;
    in_message_ = true;
  } else {
    control_size_ = 0;
  }
  phase_ = Phase::kPayload;
  return true;
}

WebSocketRead WebSocketReader::end_of_frame(std::string_view& message) noexcept {
  phase_ = Phase::kHeader;
  switch (opcode_) {
    case WebSocketOpcode::kPing:
      message = {control_.data(), control_size_};
      return WebSocketRead::kPing;
    case WebSocketOpcode::kClose:
      phase_ = Phase::kBad;  // nothing may follow
      return WebSocketRead::kClose;
    case WebSocketOpcode::kPong:
      return WebSocketRead::kNothing;
    default:
      if (!last_) return WebSocketRead::kNothing;
      in_message_ = false;
      told_ = true;
      message = {text_.data(), text_size_};
      return binary_ ? WebSocketRead::kNothing : WebSocketRead::kText;
  }
}

WebSocketRead WebSocketReader::read(std::span<const std::uint8_t>& bytes,
                                    std::string_view& message) noexcept {
  if (phase_ == Phase::kHandshake) {
    if (!take_handshake(bytes)) return phase_ == Phase::kBad ? WebSocketRead::kBad : WebSocketRead::kNothing;
    phase_ = good_handshake() ? Phase::kHeader : Phase::kBad;
    return phase_ == Phase::kBad ? WebSocketRead::kBad : WebSocketRead::kOpen;
  }
  for (;;) {
    if (told_) text_size_ = 0;  // the last message has been looked at
    told_ = false;
    if (phase_ == Phase::kBad) return WebSocketRead::kBad;
    if (phase_ == Phase::kHeader) {
      if (!take_header(bytes)) {
        if (phase_ == Phase::kBad) return WebSocketRead::kBad;
        return WebSocketRead::kNothing;
      }
    }
    const std::size_t more = static_cast<std::size_t>(std::min<std::uint64_t>(left_, bytes.size()));
    const bool control = static_cast<unsigned>(opcode_) >= 8;
    char* const to = control ? control_.data() + control_size_ : text_.data() + text_size_;
    std::transform(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(more), to,
                   [](std::uint8_t byte) { return static_cast<char>(byte); });
    (control ? control_size_ : text_size_) += more;
    left_ -= more;
    bytes = bytes.subspan(more);
    if (left_ > 0) return WebSocketRead::kNothing;
    const WebSocketRead done = end_of_frame(message);
    if (done != WebSocketRead::kNothing) return done;
  }
}

}  // namespace fuai
