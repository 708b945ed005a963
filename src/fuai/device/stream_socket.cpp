// Sockets of the system, never blocking.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/stream_socket.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "fuai/core/error.h"

namespace fuai {
namespace {

constexpr int kSendBuffer = 8192;  ///< of the system [bytes], which doubles it

/// @return whether it can be read; a port is 1 to 65535
bool split_address(std::string_view text, std::string& host, std::string& port) {
  std::string_view name = text, number;
  if (!text.empty() && text.front() == '[') {  // IPv6
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return false;
    name = text.substr(1, end - 1);
    const std::string_view rest = text.substr(end + 1);
    if (!rest.empty() && rest.front() != ':') return false;
    if (!rest.empty()) number = rest.substr(1);
    if (!rest.empty() && number.empty()) return false;
  } else if (const std::size_t colon = text.find(':'); colon != std::string_view::npos) {
    name = text.substr(0, colon);
    number = text.substr(colon + 1);
    if (number.empty()) return false;
  }
  if (!number.empty()) {
    int value = 0;
    const std::from_chars_result read = std::from_chars(number.data(), number.data() + number.size(), value);
    if (read.ec != std::errc{} || read.ptr != number.data() + number.size() || value < 1 || value > 65535)
      return false;
    port = number;
  }
  if (!name.empty()) host = name;
  return true;
}

}  // namespace

void take_address(std::string_view text, const char* where, std::string& host, std::string& port) {
  if (!split_address(text, host, port))
    throw Error(ErrorKind::kUsage, std::string(where) + ": '" + std::string(text) + "' is no address",
                {"", 0, 0, "device"}, "write host or host:port, the port from 1 to 65535");
}

void take_address_variable(const char* variable, std::string& host, std::string& port) {
  if (const char* const text = std::getenv(variable)) take_address(text, variable, host, port);
}

std::string no_answer(const char* who, const StreamSocket& socket, const StreamAddress& address) {
  return std::string("no ") + who + " answers at " + address.text + ": " +
         (socket.error() != 0 ? std::strerror(socket.error())
                              : (socket.open() ? "nothing heard in time" : "it closed the connection"));
}

StreamAddress resolve_tcp(const std::string& host, const std::string& port) {
  StreamAddress address;
  address.text = (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" + port;
  int failure = 0;
  for (const int family : {AF_INET, AF_INET6}) {
    addrinfo hints{}, *found = nullptr;
    hints.ai_family = family;
    hints.ai_socktype = SOCK_STREAM;
    failure = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
    if (failure != 0) continue;
    if (found->ai_addrlen <= address.bytes.size()) {
      std::memcpy(address.bytes.data(), found->ai_addr, found->ai_addrlen);
      address.size = found->ai_addrlen;
      address.family = found->ai_family;
    }
    ::freeaddrinfo(found);
    if (address.size > 0) return address;
  }
  throw Error(ErrorKind::kNoDevice,
              "the computer '" + host + "' is not known: " + std::string(::gai_strerror(failure)),
              {"", 0, 0, "device"}, "check the name, or give its number, as in 192.168.0.7:" + port);
}

StreamAddress unix_address(const std::string& path) {
  sockaddr_un name{};
  if (path.empty() || path.size() >= sizeof name.sun_path)
    throw Error(ErrorKind::kUsage, "'" + path + "' cannot be the path of a socket", {"", 0, 0, "device"},
                "give a path of 1 to 107 bytes");
  name.sun_family = AF_UNIX;
  std::copy(path.begin(), path.end(), name.sun_path);
  StreamAddress address;
  std::memcpy(address.bytes.data(), &name, sizeof name);
  address.size = sizeof name;
  address.family = AF_UNIX;
  address.text = path;
  return address;
}

void StreamSocket::fail(int error) noexcept {
  close();
  error_ = error;
}

void StreamSocket::close() noexcept {
  if (connected_) {  // unread bytes would make the system throw away what it has not sent yet
    constexpr int kMostReads = 16;
    std::array<std::uint8_t, 4096> rest;
    for (int i = 0; i<kMostReads&& ::recv(descriptor_, rest.data(), rest.size(), MSG_DONTWAIT)> 0; ++i)
      continue;
  }
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  connected_ = false;
  queued_ = 0;
}

bool StreamSocket::connect(const StreamAddress& address) noexcept {
  close();
  error_ = 0;
  descriptor_ = ::socket(address.family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (descriptor_ < 0) {
    error_ = errno;
    return false;
  }
  if (address.family != AF_UNIX) {
    const int on = 1;  // every message at once
    ::setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    ::setsockopt(descriptor_, SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
  }
  sockaddr_storage name{};
  std::memcpy(&name, address.bytes.data(), address.bytes.size());
  if (::connect(descriptor_, reinterpret_cast<const sockaddr*>(&name), address.size) == 0) {
    connected_ = true;
    return true;
  }
  if (errno == EINPROGRESS || errno == EAGAIN || errno == EINTR) return true;
  fail(errno);
  return false;
}

bool StreamSocket::advance() noexcept {
  if (descriptor_ < 0) return false;
  if (!connected_) {
    pollfd look{descriptor_, POLLOUT, 0};
    if (::poll(&look, 1, 0) <= 0) return false;
    int told = 0;
    socklen_t size = sizeof told;
    ::getsockopt(descriptor_, SOL_SOCKET, SO_ERROR, &told, &size);
    if (told != 0) {
      fail(told);
      return false;
    }
    connected_ = true;
  }
  flush();
  return connected_;
}

std::size_t StreamSocket::receive(std::span<std::uint8_t> into) noexcept {
  if (!connected_ || into.empty()) return 0;
  const ssize_t got = ::recv(descriptor_, into.data(), into.size(), MSG_DONTWAIT);
  if (got > 0) return static_cast<std::size_t>(got);
  if (got == 0) fail(0);
  if (got < 0 && errno != EAGAIN && errno != EINTR) fail(errno);
  return 0;
}

void StreamSocket::flush() noexcept {
  if (!connected_ || queued_ == 0) return;
  const ssize_t sent = ::send(descriptor_, queue_.data(), queued_, MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent < 0) {
    if (errno != EAGAIN && errno != EINTR) fail(errno);
    return;
  }
  std::copy(queue_.begin() + sent, queue_.begin() + static_cast<std::ptrdiff_t>(queued_), queue_.begin());
  queued_ -= static_cast<std::size_t>(sent);
}

bool StreamSocket::send(std::span<const std::uint8_t> message) noexcept {
  flush();
  if (!connected_ || message.size() > queue_.size() - queued_) return false;
  std::copy(message.begin(), message.end(), queue_.begin() + static_cast<std::ptrdiff_t>(queued_));
  queued_ += message.size();
  flush();
  return true;
}

void StreamSocket::wait(double seconds) const noexcept {
  if (descriptor_ < 0) return;
  const bool writes = !connected_ || queued_ > 0;
  pollfd look{descriptor_, static_cast<short>(POLLIN | (writes ? POLLOUT : 0)), 0};
  ::poll(&look, 1, static_cast<int>(1e3 * seconds));
}

void StreamSocket::drain(double seconds) noexcept {
  flush();
  if (!connected_ || queued_ == 0) return;
  pollfd look{descriptor_, POLLOUT, 0};  // not wait(): a server that talks would end it at once
  ::poll(&look, 1, static_cast<int>(1e3 * seconds));
  flush();
}

}  // namespace fuai
