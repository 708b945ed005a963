// Understands what a VRPN server says.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/vrpn_client.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// What a number of the server's can mean to us.
enum Known : std::uint8_t { kOther, kPose, kVelocity, kButton, kButtons, kForce, kForceError };
struct KnownName {
  std::string_view name;
  Known type;
};
constexpr std::array<KnownName, 6> kKnown{{{"vrpn_Tracker Pos_Quat", kPose},
                                           {"vrpn_Tracker Velocity", kVelocity},
                                           {"vrpn_Button Change", kButton},
                                           {"vrpn_Button States", kButtons},
                                           {"vrpn_ForceDevice Force", kForce},
                                           {"vrpn_ForceDevice Force_Error", kForceError}}};

/// Our own numbers, described in the greeting.
enum Ours : std::int32_t { kOurDevice = 0 };
enum OurType : std::int32_t { kOurForceField = 0, kOurPing = 1, kOurRate = 2 };

constexpr std::size_t kMostName = 100;

}  // namespace

VrpnClient::VrpnClient(std::string name) : name_(std::move(name)) {
  if (name_.empty() || name_.size() > kMostName)
    throw Error(ErrorKind::kUsage, "'" + name_ + "' cannot be the name of a VRPN device",
                {"", 0, 0, "device"}, "give the name that the server's configuration has, such as Phantom0");
  const auto add = [&](std::span<const std::uint8_t> bytes) {
    greeting_.insert(greeting_.end(), bytes.begin(), bytes.end());
  };
  std::array<std::uint8_t, 256> out;
  const auto cookie = vrpn_cookie();
  add(cookie);
  add(write_vrpn_description(out, kVrpnSenderDescription, kOurDevice, name_));
  add(write_vrpn_description(out, kVrpnTypeDescription, kOurForceField, "vrpn_ForceDevice Force_Field"));
  add(write_vrpn_description(out, kVrpnTypeDescription, kOurPing, "vrpn_Base ping_message"));
  add(write_vrpn_description(out, kVrpnTypeDescription, kOurRate, "vrpn_Tracker set_update_rate"));
  constexpr std::array<std::uint8_t, 8> kThousand{0x40, 0x8f, 0x40, 0, 0, 0, 0, 0};  // 1000.0 Hz
  add(write_vrpn_message(out, kOurDevice, kOurRate, kThousand));
  restart();
}

void VrpnClient::restart() noexcept {
  reader_.restart();
  state_ = VrpnState{};
  wrong_version_ = false;
  sender_ = -1;
  types_.fill(kOther);
}

bool VrpnClient::take(std::span<const std::uint8_t> bytes) noexcept {
  VrpnMessage message;
  for (;;) {
    switch (reader_.read(bytes, message)) {
      case VrpnRead::kNothing:
        return true;
      case VrpnRead::kCookie:
        break;
      case VrpnRead::kBad:
        wrong_version_ = state_.message_count == 0;
        return false;
      case VrpnRead::kMessage:
        ++state_.message_count;
        if (!take_message(message)) return false;
        break;
    }
  }
}

void VrpnClient::describe_type(std::int32_t id, std::string_view name) noexcept {
  if (id < 0 || static_cast<std::size_t>(id) >= types_.size()) return;
  std::uint8_t& type = types_[static_cast<std::size_t>(id)];
  type = kOther;
  for (const KnownName& known : kKnown)
    if (known.name == name) type = known.type;
  if (type == kForce) state_.knows_forces = true;
}

void VrpnClient::describe_sender(std::int32_t id, std::string_view name) noexcept {
  if (names_.size() < names_.capacity() && names_.size() < kMostNames)
    names_.emplace_back(name.substr(0, kMostName));
  if (name == name_ && id >= 0) {
    sender_ = id;
    state_.knows_device = true;
  } else if (id == sender_) {
    sender_ = -1;  // its number means another one now
    state_.knows_device = false;
  }
}

bool VrpnClient::take_message(const VrpnMessage& message) noexcept {
  const std::span<const std::uint8_t> payload = message.payload;
  if (message.type == kVrpnSenderDescription) describe_sender(message.sender, read_vrpn_description(payload));
  if (message.type == kVrpnTypeDescription) describe_type(message.sender, read_vrpn_description(payload));
  if (message.type < 0 || static_cast<std::size_t>(message.type) >= types_.size()) return true;
  if (sender_ < 0 || message.sender != sender_) return true;
  switch (types_[static_cast<std::size_t>(message.type)]) {
    case kPose:
      return take_pose(payload);
    case kVelocity:
      if (payload.size() < 32 || read_vrpn_int(payload, 0) != 0) return true;
      for (std::size_t i = 0; i < 3; ++i)
        state_.velocity[static_cast<int>(i)] = read_vrpn_double(payload, 8 + 8 * i);
      return true;
    case kButton:
      if (payload.size() >= 8) {
        const std::int32_t number = read_vrpn_int(payload, 0);
        if (number < 0 || number > 31) return true;
        const std::uint32_t bit = std::uint32_t{1} << number;
        state_.buttons = read_vrpn_int(payload, 4) != 0 ? state_.buttons | bit : state_.buttons & ~bit;
      }
      return true;
    case kButtons:
      take_buttons(payload);
      return true;
    case kForceError:
      if (payload.size() < 4) return true;
      state_.force_error = read_vrpn_int(payload, 0);
      ++state_.force_error_count;
      return true;
    default:
      return true;
  }
}

void VrpnClient::take_buttons(std::span<const std::uint8_t> payload) noexcept {
  if (payload.size() < 4) return;
  const std::int32_t told = read_vrpn_int(payload, 0);
  const std::size_t there = (payload.size() - 4) / 4;
  state_.buttons = 0;
  for (std::size_t i = 0; i < there && i < 32 && static_cast<std::int64_t>(i) < told; ++i)
    if (read_vrpn_int(payload, 4 + 4 * i) != 0) state_.buttons |= std::uint32_t{1} << i;
}

bool VrpnClient::take_pose(std::span<const std::uint8_t> payload) noexcept {
  if (payload.size() < 64 || read_vrpn_int(payload, 0) != 0) return true;  // of another sensor
  Vec3 position;
  for (std::size_t i = 0; i < 3; ++i) position[static_cast<int>(i)] = read_vrpn_double(payload, 8 + 8 * i);
  if (!position.allFinite()) return false;
  Eigen::Quaterniond turn(read_vrpn_double(payload, 56), read_vrpn_double(payload, 32),
                          read_vrpn_double(payload, 40), read_vrpn_double(payload, 48));
  const double size = turn.norm();
  state_.orientation = Mat3::Identity();
  // A quaternion of no length, or beyond reason, is no turn.
  if (std::isfinite(size) && size > 1e-6 && size < 1e6)
    state_.orientation = turn.normalized().toRotationMatrix();
  state_.position = position;
  state_.poses = true;
  ++state_.pose_count;
  return true;
}

std::span<const std::uint8_t> VrpnClient::force_field(const VrpnForceField& field) noexcept {
  return write_vrpn_message(out_, kOurDevice, kOurForceField, vrpn_force_field(field));
}

std::span<const std::uint8_t> VrpnClient::ping() noexcept {
  return write_vrpn_message(out_, kOurDevice, kOurPing, {});
}

}  // namespace fuai
