// A WebSocket client's half of RFC 6455 as bytes: handshake, text frames, ping, close; no extensions.
// SPDX-License-Identifier: Apache-2.0
// Source: RFC 6455; docs/theory/device-protocols.md, "WebSocket".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fuai {

/// What a server must answer to a key: base64 of the SHA-1 of key and the protocol's own text. @source RFC
/// 6455, 4.2.2. Thread class: set-up.
std::string websocket_accept(std::string_view key);
/// The request that opens a connection. @param key 16 bytes in base64. Thread class: set-up.
std::string websocket_request(std::string_view host, std::string_view key);
/// Sixteen bytes in base64. Thread class: set-up.
std::string websocket_key(const std::array<std::uint8_t, 16>& bytes);

enum class WebSocketOpcode : std::uint8_t {
  kContinuation = 0,
  kText = 1,
  kBinary = 2,
  kClose = 8,
  kPing = 9,
  kPong = 10
};

/// Writes a whole masked frame. @return the bytes used in `out`, empty when there is no room.
/// Thread class: real-time.
std::span<const std::uint8_t> write_websocket_frame(std::span<std::uint8_t> out, WebSocketOpcode opcode,
                                                    std::string_view payload, std::uint32_t mask) noexcept;

enum class WebSocketRead {
  kNothing,  ///< all bytes are used up
  kOpen,     ///< the server has taken the handshake
  kText,     ///< `message` is a whole text
  kPing,     ///< `message` is to be sent back as a pong
  kClose,    ///< the server ends the connection
  kBad       ///< no WebSocket, or against the protocol, or too long: close
};

/// Puts messages together from bytes that come in any pieces, and from fragments. Keeps at most one message.
class WebSocketReader {
 public:
  /// @param most longest message [bytes]. Thread class: set-up.
  explicit WebSocketReader(std::size_t most);

  /// Before a new connection. @param accept see websocket_accept(). Thread class: real-time.
  void restart(std::string_view accept) noexcept;
  /// Takes bytes from the front of `bytes` until one thing is complete; `message` is the reader's, until its
  /// next call. Call it until kNothing or kBad. Thread class: real-time.
  WebSocketRead read(std::span<const std::uint8_t>& bytes, std::string_view& message) noexcept;
  /// The first line of what answered the handshake, for messages to people. Thread class: any.
  std::string_view first_line() const noexcept;

 private:
  enum class Phase { kHandshake, kHeader, kPayload, kBad };
  bool take_handshake(std::span<const std::uint8_t>& bytes) noexcept;
  bool good_handshake() const noexcept;
  bool take_header(std::span<const std::uint8_t>& bytes) noexcept;
  WebSocketRead end_of_frame(std::string_view& message) noexcept;

  std::vector<char> text_;              // of the message, fragment by fragment
  std::array<char, 4096> handshake_{};  // what came until the empty line
  std::array<char, 125> control_{};
  std::array<std::uint8_t, 10> header_{};
  std::array<char, 28> accept_{};
  Phase phase_ = Phase::kHandshake;
  std::size_t handshake_size_ = 0, header_size_ = 0, text_size_ = 0, control_size_ = 0;
  std::uint64_t left_ = 0;  // of the frame's payload
  bool in_message_ = false, binary_ = false, told_ = false, last_ = false;
  WebSocketOpcode opcode_ = WebSocketOpcode::kText;
};

}  // namespace fuai
