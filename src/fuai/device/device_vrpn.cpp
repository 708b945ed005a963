// Drives a remote device by VRPN.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/device_vrpn.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "fuai/core/error.h"
#include "fuai/device/device_axes.h"

namespace fuai {
namespace {

constexpr const char* kDriver = "vrpn";
constexpr double kSilence = 0.25;      ///< of a force device until its samples are not trusted [s]
constexpr double kDead = 10.0;         ///< of any server until the connection is given up [s]
constexpr double kAgain = 1.0;         ///< between attempts to connect, and between pings [s]
constexpr double kTrouble = 0.5;       ///< that an error of force counts, as not all servers take it back [s]
constexpr double kRadius = 0.01;       ///< of the force field [m]
constexpr double kLastWords = 0.1;     ///< for the last field at closing [s]
constexpr int kMostReads = 16;         ///< of 4 KiB each in one read()
constexpr double kServerLimit = 10.0;  ///< to which its PHANToM server cuts any force [N]

/// As the server numbers its errors of force.
enum ForceError { kOutOfRange = 0, kDutyCycle = 1, kForceOrMotor = 2, kOtherError = 3 };

std::uint32_t status_of(int force_error) noexcept {
  switch (force_error) {
    case kOutOfRange:
      return kDeviceSaturated;
    case kDutyCycle:
      return kDeviceWarm;
    case kForceOrMotor:
    case kOtherError:
      return kDeviceForceOff;
    default:
      return kDeviceReady;
  }
}

DeviceInfo make_info(const VrpnOptions& options, const StreamAddress& address, bool force) {
  DeviceInfo info;
  info.driver = kDriver;
  info.model = options.name + " at " + address.text;
  info.sources = "a server tells no numbers: all assumed, those of the weakest desktop device";
  info.workspace_low = Vec3(-0.08, -0.035, -0.06);
  info.workspace_high = Vec3(0.08, 0.035, 0.06);
  info.peak_force = force ? std::min(3.3, kServerLimit) : 0.0;
  info.continuous_force = force ? 0.88 : 0.0;
  info.stable_stiffness = force ? 200.0 : 0.0;  // a network in the loop: half of a Touch's
  info.stable_damping = force ? 2.0 : 0.0;
  info.resolution = 55e-6;
  info.mass = 0.045;
  info.force_freedoms = force ? 3 : 0;
  return info;
}

constexpr const char* kServerCure =
    "start vrpn_server on the device's computer and name it as vrpn:NAME@host:port, see docs/devices.md";

DriverReport probe() {
  DriverReport report;
  report.models = {"Phantom0@localhost"};
  VrpnOptions options;
  StreamAddress address;
  try {
    options = parse_vrpn_name("");
    address = resolve_tcp(options.host, options.port);
  } catch (const Error& e) {
    report.findings.push_back({kVrpnAddressVariable, e.problem(), false});
    report.why_not = e.problem();
    report.cure = e.cure();
    return report;
  }
  StreamSocket socket;
  VrpnClient client(options.name);
  client.collect_names();
  bool good = socket.connect(address);
  bool greeted = false;
  // A tenth of a second is plenty on this machine, and nobody waits long for a diagnosis.
  const double end = steady_seconds() + 0.1;
  std::array<std::uint8_t, 4096> bytes;
  while (good && socket.open() && client.names().empty() && steady_seconds() < end) {
    socket.wait(0.01);
    if (socket.advance() && !greeted) greeted = socket.send(client.greeting());
    good = client.take({bytes.data(), socket.receive(bytes)});
  }
  for (const std::string& name : client.names()) {
    report.findings.push_back({"device on the server", name, true});
    report.models.push_back(name + "@" + address.text);
  }
  if (!client.names().empty()) {
    report.available = true;
    report.findings.push_back({"VRPN server at " + address.text, "answers", true});
    return report;
  }
  report.why_not = client.wrong_version()
                       ? "what answers at " + address.text + " is no VRPN server of version 07"
                       : no_answer("VRPN server", socket, address);
  report.cure = kServerCure;
  report.findings.push_back({"VRPN server at " + address.text, report.why_not, false});
  return report;
}

}  // namespace

VrpnOptions parse_vrpn_name(const std::string& text) {
  VrpnOptions options;
  take_address_variable(kVrpnAddressVariable, options.host, options.port);
  const std::size_t at = text.find('@');
  if (at != 0 && !text.empty()) options.name = text.substr(0, at);
  if (at == std::string::npos) return options;
  std::string_view address = std::string_view(text).substr(at + 1);
  constexpr std::string_view kTcp = "tcp:", kSlashes = "//";  // as VRPN's own programs take them
  if (address.starts_with(kTcp)) address.remove_prefix(kTcp.size());
  if (address.starts_with(kSlashes)) address.remove_prefix(kSlashes.size());
  take_address(address, "vrpn", options.host, options.port);
  return options;
}

DeviceVrpn::DeviceVrpn(const VrpnOptions& options)
    : options_(options), address_(resolve_tcp(options.host, options.port)), client_(options.name) {
  client_.collect_names();
  info_ = make_info(options_, address_, false);
  const double end = options_.clock() + options_.patience;
  // Types are described before the first position, so that one tells whether there is force.
  while (!client_.state().poses && !refused_ && options_.clock() < end) {
    listen(options_.clock());
    if (!socket_.open()) break;  // no second attempt here: somebody waits for an answer
    if (options_.idle)
      options_.idle();
    else
      socket_.wait(0.01);
  }
  if (!client_.state().poses) throw Error(ErrorKind::kNoDevice, problem(), {"", 0, 0, "device"}, kServerCure);
  has_force_ = client_.state().knows_forces;
  info_ = make_info(options_, address_, has_force_);
  client_.stop_collecting();
}

std::string DeviceVrpn::problem() const {
  if (client_.wrong_version()) return "what answers at " + address_.text + " is no VRPN server of version 07";
  if (!greeted_ || client_.state().message_count == 0) return no_answer("VRPN server", socket_, address_);
  if (client_.state().knows_device) return "the VRPN server sends no position of '" + options_.name + "'";
  std::string names;
  for (const std::string& name : client_.names()) names += (names.empty() ? "" : ", ") + name;
  return "the VRPN server at " + address_.text + " has no '" + options_.name + "' but " +
         (names.empty() ? "nothing" : names);
}

DeviceVrpn::~DeviceVrpn() {
  if (!socket_.connected() || !has_force_) return;
  socket_.drain(kLastWords);
  socket_.send(client_.force_field({}));
  socket_.drain(kLastWords);
}

void DeviceVrpn::listen(double now) noexcept {
  if (!socket_.open()) {
    if (!retry_.due(now)) return;
    retry_.wait(now, kAgain);
    client_.restart();
    greeted_ = false;
    pose_count_ = error_count_ = 0;
    heard_ = now;
    socket_.connect(address_);
  }
  if (!socket_.advance()) {
    if (socket_.open() && now - heard_ > kDead) socket_.close();
    return;
  }
  if (!greeted_) {
    greeted_ = socket_.send(client_.greeting());
    ping_.wait(now, kAgain);
  }
  std::array<std::uint8_t, 4096> bytes;
  for (int i = 0; i < kMostReads; ++i) {
    const std::size_t got = socket_.receive(bytes);
    if (got == 0) break;
    heard_ = now;
    if (client_.take({bytes.data(), got})) continue;
    refused_ = true;
    socket_.close();
    break;
  }
  const VrpnState& state = client_.state();
  if (state.force_error_count != error_count_) troubled_ = now;
  error_count_ = state.force_error_count;
  if (state.pose_count == pose_count_) return;
  pose_count_ = state.pose_count;
  posed_ = now;
  last_.position = from_y_up(state.position);
  last_.velocity = from_y_up(state.velocity);
  last_.orientation = turn_from_y_up(state.orientation);
}

void DeviceVrpn::keep_alive(double now) noexcept {
  if (!socket_.connected()) return;
  if (now - heard_ > kDead) {
    socket_.send(client_.force_field({}));
    socket_.close();
    retry_.wait(now, 0.0);
    return;
  }
  if (!ping_.due(now)) return;
  ping_.wait(now, kAgain);
  socket_.send(client_.ping());
}

bool DeviceVrpn::trusted(double now) const noexcept {
  return socket_.connected() && pose_count_ > 0 && client_.state().knows_device &&
         now - posed_ <= (has_force_ ? kSilence : kDead);
}

DeviceSample DeviceVrpn::read() noexcept {
  const double now = options_.clock();
  listen(now);
  keep_alive(now);
  last_.time = now;
  last_.buttons = client_.state().buttons;
  if (!trusted(now))
    last_.status = kDeviceDisconnected;
  else
    last_.status = (now - troubled_ <= kTrouble ? status_of(client_.state().force_error) : kDeviceReady) |
                   (saturated_ ? kDeviceSaturated : kDeviceReady);
  return last_;
}

void DeviceVrpn::write(const DeviceCommand& command) noexcept {
  if (!has_force_ || !socket_.connected()) return;
  // Behind one that has not left yet this would only be late; the next one is a millisecond away.
  if (!socket_.advance() || !socket_.drained()) return;
  VrpnForceField field;
  saturated_ = false;
  if (trusted(options_.clock())) {
    field.origin = client_.state().position;
    field.force = to_y_up(force_within(command, info_.peak_force, saturated_));
    field.radius = kRadius;
  }
  socket_.send(client_.force_field(field));
}

DeviceDriver vrpn_driver() {
  return {kDriver, "any device behind a VRPN server, here or on the network", true, probe,
          [](const DeviceRequest& request) -> std::unique_ptr<Device> {
            return std::make_unique<DeviceVrpn>(parse_vrpn_name(request.model));
          }};
}

}  // namespace fuai
