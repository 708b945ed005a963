// Drives an Inverse3.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/device_inverse3.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <random>

#include "fuai/core/error.h"
#include "fuai/device/device_simulated.h"
#include "fuai/device/system_findings.h"

namespace fuai {
namespace {

constexpr const char* kDriver = "inverse3";
constexpr std::size_t kMostMessage = 1 << 18;  ///< an inventory of many devices is a few KiB [bytes]
constexpr int kMostUnanswered = 2;
constexpr double kAgain = 1.0;              ///< between attempts to connect, and questions for a device [s]
constexpr double kDead = 2.0;               ///< of silence until the connection is given up [s]
constexpr double kPoll = 2e-3;              ///< without a write() until read() asks by itself [s]
constexpr double kLastWords = 0.1;          ///< for the last force at closing [s]
constexpr int kMostReads = 16;              ///< of 4 KiB each in one read()
constexpr const char* kRestPort = "10000";  ///< of the older service's HTTP

constexpr const char* kCure =
    "install and start Haply's Inverse Service (systemctl start haply-inverse-service), plug in and power "
    "the "
    "Inverse3, or name the service as inverse3:host:port, see docs/devices.md";

DeviceInfo make_info(const Inverse3State& state, const StreamAddress& address) {
  DeviceInfo info = find_device_preset("inverse3").info;
  info.driver = kDriver;
  info.model = "Haply Inverse3 " + std::string(state.id.text()) + " at " + address.text;
  info.rate = 1000.0;
  info.command_timeout = 0.0;  // the service does not say what it does with a force that is not renewed
  // The origin is the mounting plate, which stands behind the workspace: to be checked on a device.
  info.workspace_low = Vec3(-0.15, -0.3, 0.0);
  info.workspace_high = Vec3(0.15, 0.0, 0.3);
  const auto filter = [&](const char* name, double value) {
    if (value >= 0.0) info.sources += std::string("; the service's ") + name + " is " + std::to_string(value);
  };
  filter("force gate gain", state.force_gate);
  filter("damping", state.damping);
  return info;
}

/// What an HTTP server at this address says is its version.
DriverFinding ask_version(const std::string& host, const std::string& port) {
  const std::string what = "GET /version at " + host + ":" + port;
  StreamSocket socket;
  std::string answer;
  try {
    socket.connect(resolve_tcp(host, port));
  } catch (const Error& e) {
    return {what, e.problem(), false};
  }
  const std::string request = "GET /version HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n";
  const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(request.data()),
                                            request.size());
  bool asked = false;
  std::array<std::uint8_t, 1024> buffer;
  const double end = steady_seconds() + 0.1;
  while (socket.open() && answer.size() < buffer.size() && steady_seconds() < end) {
    socket.wait(0.01);
    if (socket.advance() && !asked) asked = socket.send(bytes);
    const std::size_t got = socket.receive(buffer);
    answer.append(reinterpret_cast<const char*>(buffer.data()), got);
  }
  if (answer.empty()) return {what, socket.error() != 0 ? std::strerror(socket.error()) : "no answer", false};
  const std::size_t body = answer.find("\r\n\r\n");
  std::string text =
      body == std::string::npos ? answer.substr(0, answer.find('\r')) : answer.substr(body + 4, 80);
  for (char& c : text) c = c < ' ' || c > '~' ? ' ' : c;
  return {what, text, answer.starts_with("HTTP/1.1 200") || answer.starts_with("HTTP/1.0 200")};
}

DriverReport probe() {
  DriverReport report;
  report.models = {"localhost:10001"};
  try {
    Inverse3Options options = parse_inverse3_name("");
    options.patience = 0.2;
    report.findings.push_back(ask_version(options.host, options.port));
    report.findings.push_back(ask_version(options.host, kRestPort));
    const DeviceInverse3 device(options);
    report.findings.push_back({"Inverse3", device.info().model, true});
    report.available = true;
  } catch (const Error& e) {
    report.why_not = e.problem();
    report.cure = e.cure();
    report.findings.push_back({"Inverse3", e.problem(), false});
  }
  find_device_nodes("ttyACM", true, report.findings);
  return report;
}

}  // namespace

Inverse3Options parse_inverse3_name(const std::string& text) {
  Inverse3Options options;
  take_address_variable(kInverse3AddressVariable, options.host, options.port);
  const std::size_t at = text.find('@');
  if (at != std::string::npos) {
    options.id = text.substr(0, at);
    Inverse3Id id;
    if (at > 0 && !id.set(options.id))
      throw Error(ErrorKind::kUsage, "'" + options.id + "' cannot be the id of an Inverse3",
                  {"", 0, 0, "device"}, "take the id that `fuai haptics devices --diagnose` shows");
  }
  take_address(std::string_view(text).substr(at == std::string::npos ? 0 : at + 1), "inverse3", options.host,
               options.port);
  return options;
}

DeviceInverse3::DeviceInverse3(const Inverse3Options& options)
    : options_(options), address_(resolve_tcp(options.host, options.port)), reader_(kMostMessage) {
  std::random_device random;
  std::array<std::uint8_t, 16> bytes;
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  mask_ = random() | 1u;
  const std::string key = websocket_key(bytes);
  request_ = websocket_request(address_.text, key);
  accept_ = websocket_accept(key);
  const double end = options_.clock() + options_.patience;
  while (counted_ == 0 && !bad_ && options_.clock() < end) {
    listen(options_.clock());
    if (!socket_.open()) break;  // no second attempt here: somebody waits for an answer
    if (options_.idle)
      options_.idle();
    else
      socket_.wait(0.01);
  }
  if (counted_ == 0) throw Error(ErrorKind::kNoDevice, problem(), {"", 0, 0, "device"}, kCure);
  info_ = make_info(state_, address_);
}

std::string DeviceInverse3::problem() const {
  if (open_ && messages_ > 0)
    return "the Inverse Service at " + address_.text + " has no " +
           (options_.id.empty() ? "Inverse3" : "Inverse3 '" + options_.id + "'");
  const std::string line(reader_.first_line());
  if (bad_ && !line.empty() && messages_ == 0)
    return "what answers at " + address_.text + " is no Inverse Service, it says: " + line;
  return no_answer("Inverse Service", socket_, address_);
}

DeviceInverse3::~DeviceInverse3() {
  if (!open_ || !socket_.connected()) return;
  socket_.drain(kLastWords);
  // A device that was only asked may be in another program's hand.
  if (forced_) send(WebSocketOpcode::kText, write_inverse3_force(text_, state_.id.text(), Vec3::Zero()));
  send(WebSocketOpcode::kClose, std::string_view("\x03\xe8", 2));  // 1000: done
  socket_.drain(kLastWords);
}

bool DeviceInverse3::send(WebSocketOpcode opcode, std::string_view payload) noexcept {
  // The mask only has to differ from frame to frame (xorshift, Marsaglia 2003).
  mask_ ^= mask_ << 13;
  mask_ ^= mask_ >> 17;
  mask_ ^= mask_ << 5;
  const std::span<const std::uint8_t> frame = write_websocket_frame(frame_, opcode, payload, mask_);
  return !frame.empty() && socket_.send(frame);
}

bool DeviceInverse3::send_counted(std::string_view message, double now) noexcept {
  if (message.empty() || !send(WebSocketOpcode::kText, message)) return false;
  ++unanswered_;
  sent_ = now;
  return true;
}

void DeviceInverse3::take(std::span<const std::uint8_t> bytes, double now) noexcept {
  std::string_view message;
  for (;;) {
    switch (reader_.read(bytes, message)) {
      case WebSocketRead::kNothing:
        return;
      case WebSocketRead::kOpen:
        open_ = true;
        break;
      case WebSocketRead::kText: {
        ++messages_;
        unanswered_ = std::max(0, unanswered_ - 1);
        // What cannot be understood is no state: samples get stale.
        read_inverse3_message(message, options_.id, state_);
        if (state_.count == counted_) break;
        counted_ = state_.count;
        stated_ = now;
        last_.position = state_.position;
        last_.velocity = state_.velocity;
        last_.orientation = state_.orientation;
        last_.buttons = state_.buttons;
        break;
      }
      case WebSocketRead::kPing:
        send(WebSocketOpcode::kPong, message);
        break;
      case WebSocketRead::kClose:
      case WebSocketRead::kBad:
        bad_ = true;
        open_ = false;
        socket_.close();
        return;
    }
  }
}

void DeviceInverse3::listen(double now) noexcept {
  if (!socket_.open()) {
    open_ = false;
    if (!retry_.due(now)) return;
    retry_.wait(now, kAgain);
    reader_.restart(accept_);
    asked_ = bad_ = false;
    unanswered_ = 0;
    state_.ready = false;  // until the service says so again
    heard_ = now;
    ask_.wait(now, kAgain);
    socket_.connect(address_);
  }
  if (now - heard_ > kDead) {
    socket_.close();
    open_ = false;
    return;
  }
  if (!socket_.advance()) return;
  if (!asked_)
    asked_ = socket_.send({reinterpret_cast<const std::uint8_t*>(request_.data()), request_.size()});
  std::array<std::uint8_t, 4096> bytes;
  for (int i = 0; i < kMostReads; ++i) {
    const std::size_t got = socket_.receive(bytes);
    if (got == 0) break;
    heard_ = now;
    take({bytes.data(), got}, now);
  }
}

/// Keeps the service talking: a question each second while there is no state, a probe when nobody writes.
void DeviceInverse3::ask(double now) noexcept {
  if (!open_) return;
  if (!trusted(now)) {
    if (!ask_.due(now)) return;
    ask_.wait(now, kAgain);
    unanswered_ = 0;  // whatever was asked before will not be answered any more
    send_counted(kInverse3AskAll, now);
    return;
  }
  ask_.wait(now, 0.0);
  if (unanswered_ == 0 && now - sent_ >= kPoll)
    send_counted(write_inverse3_probe(text_, state_.id.text()), now);
}

std::uint32_t DeviceInverse3::status() const noexcept {
  std::uint32_t told = saturated_ ? kDeviceSaturated : kDeviceReady;
  if (!state_.calibrated) told |= kDeviceUncalibrated;
  if (!state_.powered || !state_.ready || !state_.started) told |= kDeviceForceOff;
  return told;
}

DeviceSample DeviceInverse3::read() noexcept {
  const double now = options_.clock();
  listen(now);
  ask(now);
  last_.time = now;
  last_.status = trusted(now) ? status() : kDeviceDisconnected;
  return last_;
}

void DeviceInverse3::write(const DeviceCommand& command) noexcept {
  const double now = options_.clock();
  if (!open_ || counted_ == 0 || unanswered_ >= kMostUnanswered || !socket_.advance() || !socket_.drained())
    return;
  Vec3 force = Vec3::Zero();
  saturated_ = false;
  if (trusted(now) && status() == kDeviceReady) force = force_within(command, info_.peak_force, saturated_);
  forced_ = send_counted(write_inverse3_force(text_, state_.id.text(), force), now) || forced_;
}

DeviceDriver inverse3_driver() {
  return {kDriver, "Haply Inverse3, by its Inverse Service", true, probe,
          [](const DeviceRequest& request) -> std::unique_ptr<Device> {
            return std::make_unique<DeviceInverse3>(parse_inverse3_name(request.model));
          }};
}

}  // namespace fuai
