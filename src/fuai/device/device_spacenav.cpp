// Reads a 3D mouse.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/device_spacenav.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "fuai/core/error.h"
#include "fuai/device/system_findings.h"

namespace fuai {
namespace {

constexpr const char* kDriver = "spacenav";
constexpr double kAgain = 1.0;  ///< between attempts to connect [s]
constexpr int kMostReads = 16;  ///< of 1 KiB each in one read()
constexpr const char* kCure = "install and start the daemon (apt install spacenavd), plug the 3D mouse in";

std::string usual_path() {
  const char* const chosen = std::getenv(kSpacenavVariable);
  return chosen != nullptr && *chosen != '\0' ? chosen : "/var/run/spnav.sock";
}

DriverReport probe() {
  DriverReport report;
  constexpr std::array<UsbId, 2> kIds{
      {{"256f", "", "3Dconnexion"}, {"046d", "c62b", "3Dconnexion SpaceMouse Pro"}}};
  const std::string path = usual_path();
  report.models = {path};
  find_usb_devices(kIds, report.findings);
  try {
    const DeviceSpacenav device(path);
    report.available = true;
    report.findings.push_back({"spacenavd", "listens at " + path, true});
  } catch (const Error& e) {
    report.why_not = e.problem();
    report.cure = e.cure();
    report.findings.push_back({"spacenavd", e.problem(), false});
  }
  return report;
}

}  // namespace

DeviceSpacenav::DeviceSpacenav(const std::string& path, DeviceClock clock)
    : address_(unix_address(path.empty() ? usual_path() : path)),
      clock_(clock),
      info_(RateControl::info(kDriver, "3D mouse at " + address_.text)) {
  if (socket_.connect(address_) && socket_.connected()) return;
  // A queue that is full does not wait either.
  throw Error(ErrorKind::kNoDevice,
              "no spacenavd listens at " + address_.text + ": " +
                  std::strerror(socket_.error() != 0 ? socket_.error() : EAGAIN),
              {"", 0, 0, "device"}, kCure);
}

DeviceSample DeviceSpacenav::read() noexcept {
  const double now = clock_();
  if (!socket_.open() && retry_.due(now)) {
    retry_.wait(now, kAgain);
    reader_.restart();
    socket_.connect(address_);
  }
  socket_.advance();
  std::array<std::uint8_t, 1024> bytes;
  for (int i = 0; i < kMostReads; ++i) {
    const std::size_t got = socket_.receive(bytes);
    if (got == 0) break;
    if (!reader_.take({bytes.data(), got})) socket_.close();
  }
  if (!socket_.connected()) reader_.restart();  // nothing is pushed any more
  return hand_.sample(reader_.state(), now, socket_.connected());
}

DeviceDriver spacenav_driver() {
  return {kDriver, "3D mouse by spacenavd, input only", false, probe,
          [](const DeviceRequest& request) -> std::unique_ptr<Device> {
            return std::make_unique<DeviceSpacenav>(request.model);
          }};
}

}  // namespace fuai
