// Understands the Inverse Service.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/inverse3_wire.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "fuai/device/json_walk_rt.h"

namespace fuai {
namespace {

constexpr std::size_t kMostDevices = 8;  ///< of a kind that are looked at
constexpr double kReason = 1000.0;       ///< nothing that a hand does is larger [m, m/s]

/// What one message says of one device: sub-fields that are left out have their default.
struct Told {
  Inverse3Id id;
  bool has_state = false, has_status = false;
  Inverse3State state;
};

struct Message {
  std::array<Told, kMostDevices> devices;
  std::array<double, 4> turn{0.0, 0.0, 0.0, 1.0};  // x, y, z, w
  bool has_turn = false, has_buttons = false;
  std::uint32_t buttons = 0;
};

/// "x" -> 0 and so on; -1 for another name.
int axis_of(std::string_view name) noexcept {
  constexpr std::string_view kAxes = "xyzw";
  const std::size_t place = name.size() == 1 ? kAxes.find(name[0]) : kAxes.npos;
  return place == kAxes.npos ? -1 : static_cast<int>(place);
}

void take_device(const JsonItem& item, Told& told) noexcept {
  const std::string_view part = item.depth > 2 ? item.path[2].key : std::string_view{};
  if (item.depth == 3 && part == "device_id" && item.kind == JsonKind::kString) told.id.set(item.text);
  if (item.depth == 3 && item.kind == JsonKind::kObject) {
    told.has_state = told.has_state || part == "state";
    told.has_status = told.has_status || part == "status";
  }
  if (part == "state" && item.depth == 5 && item.kind == JsonKind::kNumber) {
    const int axis = axis_of(item.key());
    if (axis < 0 || axis > 2) return;
    if (item.key(1) == "cursor_position") told.state.position[axis] = item.number;
    if (item.key(1) == "cursor_velocity") told.state.velocity[axis] = item.number;
  }
  if (part == "status" && item.depth == 4 && item.kind == JsonKind::kBool) {
    if (item.key() == "calibrated") told.state.calibrated = item.truth;
    if (item.key() == "power_supply") told.state.powered = item.truth;
    if (item.key() == "ready") told.state.ready = item.truth;
    if (item.key() == "started") told.state.started = item.truth;
  }
  if (part == "config" && item.kind == JsonKind::kNumber) {
    if (item.key(1) == "force_gate" && item.key() == "gain") told.state.force_gate = item.number;
    if (item.key(1) == "damping" && item.key() == "scalar") told.state.damping = item.number;
  }
}

/// Of the first grip: wired ones have one button, wireless ones three or four, by either name.
void take_grip(const JsonItem& item, Message& message) noexcept {
  if (item.path[2].key != "state") return;
  if (item.depth == 5 && item.key(1) == "orientation" && item.kind == JsonKind::kNumber) {
    const int axis = axis_of(item.key());
    if (axis < 0) return;
    // The first of them: what is left out is zero.
    if (!message.has_turn) message.turn = {};
    message.turn[static_cast<std::size_t>(axis)] = item.number;
    message.has_turn = true;
  }
  if (item.kind == JsonKind::kObject && item.depth == 3) message.has_buttons = true;
  if (item.kind != JsonKind::kBool || !item.truth) return;
  constexpr std::array<std::string_view, 4> kLetters{"a", "b", "c", "d"};
  constexpr std::array<std::string_view, 4> kNumbers{"button_0", "button_1", "button_2", "button_3"};
  if (item.depth == 4 && item.key() == "button") message.buttons |= 1;
  for (std::size_t i = 0; i < 4; ++i)
    if (item.depth == 5 && item.key(1) == "buttons" &&
        (item.key() == kLetters[i] || item.key() == kNumbers[i]))
      message.buttons |= std::uint32_t{1} << i;
}

bool within_reason(const Vec3& v) noexcept { return v.allFinite() && v.cwiseAbs().maxCoeff() < kReason; }

/// Text that grows in a given room, whatever the locale says of decimal points.
class Line {
 public:
  explicit Line(std::span<char> room) noexcept : room_(room) {}
  Line& add(std::string_view text) noexcept {
    fits_ = fits_ && text.size() <= room_.size() - size_;
    if (fits_) size_ += text.copy(room_.data() + size_, text.size());
    return *this;
  }
  Line& add(double number) noexcept {
    char digits[32];
    const std::to_chars_result end =
        std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 9);
    return add(std::string_view(digits, static_cast<std::size_t>(end.ptr - digits)));
  }
  std::string_view text() const noexcept {
    return fits_ ? std::string_view(room_.data(), size_) : std::string_view{};
  }

 private:
  std::span<char> room_;
  std::size_t size_ = 0;
  bool fits_ = true;
};

}  // namespace

bool Inverse3Id::set(std::string_view id) noexcept {
  if (id.empty() || id.size() >= letters.size()) return false;
  for (const char c : id) {
    const bool good = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                      c == '-' || c == '_' || c == '.';
    if (!good) return false;
  }
  letters.fill('\0');
  std::copy(id.begin(), id.end(), letters.begin());
  return true;
}

bool read_inverse3_message(std::string_view json, std::string_view wanted, Inverse3State& state) noexcept {
  Message message;
  const bool good = walk_json(json, [&](const JsonItem& item) noexcept {
    if (item.depth < 3 || !item.path[1].key.empty()) return;
    const std::string_view kind = item.path[0].key;
    const std::size_t index = item.path[1].index;
    if (kind == "inverse3" && index < kMostDevices) take_device(item, message.devices[index]);
    if ((kind == "verse_grip" || kind == "wireless_verse_grip") && index == 0) take_grip(item, message);
  });
  if (!good) return false;
  for (const Told& told : message.devices) {
    const std::string_view id = told.id.text();
    if (id.empty() || (!wanted.empty() ? id != wanted : (!state.id.text().empty() && id != state.id.text())))
      continue;
    if (!within_reason(told.state.position) || !within_reason(told.state.velocity)) return false;
    state.id = told.id;
    if (told.state.force_gate >= 0.0) state.force_gate = told.state.force_gate;
    if (told.state.damping >= 0.0) state.damping = told.state.damping;
    if (told.has_status) {
      state.calibrated = told.state.calibrated;
      state.powered = told.state.powered;
      state.ready = told.state.ready;
      state.started = told.state.started;
    }
    if (told.has_state) {
      state.position = told.state.position;
      state.velocity = told.state.velocity;
      ++state.count;
    }
    break;
  }
  if (message.has_buttons) state.buttons = message.buttons;
  if (message.has_turn) {
    const Eigen::Quaterniond turn(message.turn[3], message.turn[0], message.turn[1], message.turn[2]);
    const double size = turn.norm();
    if (std::isfinite(size) && size > 1e-6 && size < 1e6)
      state.orientation = turn.normalized().toRotationMatrix();
  }
  return true;
}

std::string_view write_inverse3_force(std::span<char> out, std::string_view id, const Vec3& force) noexcept {
  return Line(out)
      .add(R"({"inverse3":[{"device_id":")")
      .add(id)
      .add(R"(","commands":{"set_cursor_force":{"values":{"x":)")
      .add(force.x())
      .add(R"(,"y":)")
      .add(force.y())
      .add(R"(,"z":)")
      .add(force.z())
      .add("}}}}]}")
      .text();
}

std::string_view write_inverse3_probe(std::span<char> out, std::string_view id) noexcept {
  return Line(out)
      .add(R"({"inverse3":[{"device_id":")")
      .add(id)
      .add(R"(","commands":{"probe_position":{}}}]})")
      .text();
}

}  // namespace fuai
