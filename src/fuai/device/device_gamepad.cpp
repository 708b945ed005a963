// Reads a gamepad.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/device_gamepad.h"

#include <fcntl.h>
#include <linux/joystick.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "fuai/core/error.h"
#include "fuai/device/system_findings.h"

namespace fuai {
namespace {

constexpr const char* kDriver = "gamepad";
constexpr double kAgain = 1.0;  ///< between attempts to open [s]
constexpr int kMostReads = 16;  ///< of 1 KiB each in one read()
constexpr const char* kCure =
    "plug a gamepad in; if /dev/input/js0 is there, add yourself to the group input; give another node as "
    "gamepad:/dev/input/js1";

std::vector<std::string> nodes(std::vector<DriverFinding>& findings) {
  return find_device_nodes("input/js", false, findings);
}

DriverReport probe() {
  DriverReport report;
  report.models = nodes(report.findings);
  report.available = !report.models.empty();
  if (report.available) return report;
  report.why_not = report.findings.back().found;
  report.cure = kCure;
  return report;
}

}  // namespace

DeviceGamepad::DeviceGamepad(const std::string& path, DeviceClock clock) : path_(path), clock_(clock) {
  if (path_.empty()) {
    std::vector<DriverFinding> findings;
    const std::vector<std::string> found = nodes(findings);
    if (found.empty())
      throw Error(ErrorKind::kNoDevice, "no gamepad: " + findings.back().found, {"", 0, 0, "device"}, kCure);
    path_ = found.front();
  }
  if (!open_node())
    throw Error(ErrorKind::kNoDevice, "the gamepad " + path_ + " cannot be opened: " + std::strerror(errno),
                {"", 0, 0, "device"}, kCure);
  std::array<char, 128> name{};
  const bool named = ::ioctl(descriptor_, JSIOCGNAME(name.size() - 1), name.data()) > 0;
  info_ = RateControl::info(kDriver, named ? std::string(name.data()) : path_);
}

DeviceGamepad::~DeviceGamepad() { close_node(); }

bool DeviceGamepad::open_node() noexcept {
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  return descriptor_ >= 0;
}

void DeviceGamepad::close_node() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

DeviceSample DeviceGamepad::read() noexcept {
  const double now = clock_();
  if (descriptor_ < 0 && retry_.due(now)) {
    retry_.wait(now, kAgain);
    open_node();  // the kernel tells the state of all sticks and buttons again
  }
  std::array<std::uint8_t, 1024> bytes;
  for (int i = 0; i < kMostReads && descriptor_ >= 0; ++i) {
    const ssize_t got = ::read(descriptor_, bytes.data(), bytes.size());
    if (got > 0) {
      reader_.take({bytes.data(), static_cast<std::size_t>(got)});
      continue;
    }
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) break;
    close_node();
    retry_.wait(now, kAgain);
  }
  if (descriptor_ < 0) reader_.restart();  // nothing is pushed any more
  return hand_.sample(reader_.state(), now, descriptor_ >= 0);
}

DeviceDriver gamepad_driver() {
  return {kDriver, "gamepad by the kernel's joystick nodes, input only", false, probe,
          [](const DeviceRequest& request) -> std::unique_ptr<Device> {
            return std::make_unique<DeviceGamepad>(request.model);
          }};
}

}  // namespace fuai
