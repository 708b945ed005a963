// A stream socket that never makes anybody wait: TCP or a socket of this machine.
// SPDX-License-Identifier: Apache-2.0
//
//   closed --connect()--> connecting --advance()--> connected --(peer, error, close())--> closed
//
//   What is to be sent goes through a queue of fixed size; what does not fit is refused whole, so that
//   messages stay whole. The system's own buffer is kept small: old forces must not queue up for a server
//   that stands still.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace fuai {

/// Where to connect: a resolved address.
struct StreamAddress {
  alignas(8) std::array<unsigned char, 128> bytes{};  ///< of the system's sockaddr
  unsigned size = 0;
  int family = 0;
  std::string text;  ///< for people: "host:port" or a path
};

/// Takes "host", "host:port", ":port" or "[v6]:port" into `host` and `port`, which hold the defaults.
/// @param where names it in the message @throws Error (kUsage). Thread class: set-up.
void take_address(std::string_view text, const char* where, std::string& host, std::string& port);
/// The same of a variable of the environment, where it is set. Thread class: set-up.
void take_address_variable(const char* variable, std::string& host, std::string& port);
/// Looks the name up, IPv4 first. @throws Error (kNoDevice) with the system's words. Thread class: set-up.
StreamAddress resolve_tcp(const std::string& host, const std::string& port);
/// @throws Error (kUsage) for a path that is too long for a socket. Thread class: set-up.
StreamAddress unix_address(const std::string& path);

/// One connection.
class StreamSocket {
 public:
  StreamSocket() = default;
  StreamSocket(const StreamSocket&) = delete;
  StreamSocket& operator=(const StreamSocket&) = delete;
  ~StreamSocket() { close(); }

  /// Begins to connect, after closing what was. @return false when the system refuses at once (see error()).
  /// Thread class: real-time.
  bool connect(const StreamAddress& address) noexcept;
  /// Looks whether a connection has come about, sends what waits. @return whether it is connected.
  /// Thread class: real-time.
  bool advance() noexcept;
  /// Takes what has come. @return number of bytes, 0 for none; the socket is closed when the peer has gone.
  /// Thread class: real-time.
  std::size_t receive(std::span<std::uint8_t> into) noexcept;
  /// Queues a message and sends what goes. @return false, and nothing is queued, when there is no room.
  /// Thread class: real-time.
  bool send(std::span<const std::uint8_t> message) noexcept;
  /// Thread class: real-time.
  void close() noexcept;
  /// Waits until something can be read or, while connecting or with a full queue, written.
  /// @param seconds at most. Thread class: set-up.
  void wait(double seconds) const noexcept;
  /// Waits until the queue is sent, at most so long [s]: for the last words. Thread class: set-up.
  void drain(double seconds) noexcept;

  bool open() const noexcept { return descriptor_ >= 0; }
  bool connected() const noexcept { return connected_; }
  /// Whether all that was given to send() is with the system.
  bool drained() const noexcept { return queued_ == 0; }
  /// The system's error that ended it last; 0: the peer closed it, or nothing did.
  int error() const noexcept { return error_; }

 private:
  void fail(int error) noexcept;
  void flush() noexcept;

  int descriptor_ = -1, error_ = 0;
  bool connected_ = false;
  std::size_t queued_ = 0;
  std::array<std::uint8_t, 8192> queue_{};
};

/// "no VRPN server answers at host:port: why". Thread class: set-up.
std::string no_answer(const char* who, const StreamSocket& socket, const StreamAddress& address);

}  // namespace fuai
