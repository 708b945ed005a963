// The other end of a stream socket, served by hand: a free port of loopback, or a path.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fuai_test {

/// Takes one connection at a time; never blocks for long. Nothing happens outside of pump() and send().
class FakeStreamServer {
 public:
  FakeStreamServer() { listen(); }
  explicit FakeStreamServer(std::string path) : path_(std::move(path)) { listen(); }
  FakeStreamServer(const FakeStreamServer&) = delete;
  FakeStreamServer& operator=(const FakeStreamServer&) = delete;
  ~FakeStreamServer() {
    drop();
    refuse();
  }

  /// Opens the door, at the same port again if there was one.
  void listen() {
    const bool local = !path_.empty();
    listener_ = ::socket(local ? AF_UNIX : AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (local) {
      sockaddr_un name{};
      name.sun_family = AF_UNIX;
      std::copy(path_.begin(), path_.end(), name.sun_path);
      ::unlink(path_.c_str());
      ::bind(listener_, reinterpret_cast<const sockaddr*>(&name), sizeof name);
    } else {
      const int on = 1;
      ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
      sockaddr_in name{};
      name.sin_family = AF_INET;
      name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      name.sin_port = htons(port_);
      ::bind(listener_, reinterpret_cast<const sockaddr*>(&name), sizeof name);
      socklen_t size = sizeof name;
      ::getsockname(listener_, reinterpret_cast<sockaddr*>(&name), &size);
      port_ = ntohs(name.sin_port);
    }
    ::listen(listener_, 1);
  }
  /// Shuts the door: who knocks is refused.
  void refuse() {
    if (listener_ >= 0) ::close(listener_);
    listener_ = -1;
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  /// Ends the connection.
  void drop() {
    if (peer_ >= 0) ::close(peer_);
    peer_ = -1;
  }
  /// Takes who knocks and what has come. @return true when there is a new connection
  bool pump() {
    bool fresh = false;
    if (listener_ >= 0) {
      const int knocked = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (knocked >= 0) {
        drop();
        peer_ = knocked;
        const int on = 1;  // what is sent is there at once
        if (path_.empty()) ::setsockopt(peer_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        received.clear();
        fresh = true;
        ++connections;
      }
    }
    std::uint8_t bytes[4096];
    while (peer_ >= 0) {
      const ssize_t got = ::recv(peer_, bytes, sizeof bytes, MSG_DONTWAIT);
      if (got == 0) drop();
      if (got <= 0) break;
      received.insert(received.end(), bytes, bytes + got);
    }
    return fresh;
  }
  void send(std::span<const std::uint8_t> bytes) const {
    if (peer_ >= 0) ::send(peer_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  void send(const std::string& text) const {
    send(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  }

  bool connected() const { return peer_ >= 0; }
  int port() const { return port_; }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

  std::vector<std::uint8_t> received;  ///< and not yet used up by the test
  int connections = 0;

 private:
  std::string path_;
  int listener_ = -1, peer_ = -1;
  std::uint16_t port_ = 0;
};

}  // namespace fuai_test
