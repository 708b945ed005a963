// Loads libHD and keeps its scheduler.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/hd_session.h"

#include <array>
#include <clocale>
#include <cstdio>

#include "fuai/core/error.h"
#include "fuai/device/device_openhaptics.h"

namespace fuai {
namespace {

constexpr std::array kNames{"libHD.so", "libHD.so.3.4", "libHD.so.3.0"};
constexpr unsigned long kRate = 1000;  // [Hz]
constexpr int kMostErrors = 64;        ///< that are drained at a time

}  // namespace

std::span<const char* const> hd_library_names() noexcept { return kNames; }

std::string hd_library_cure(const VendorLibrary& library) {
  const std::string& part = library.missing_dependency();
  if (part.find("ncurses") != std::string::npos || part.find("tinfo") != std::string::npos)
    return "install libncurses5 and libtinfo5 (Debian 12 still has them), see docs/devices.md";
  if (part.find("hantom") != std::string::npos || part.find("HANToM") != std::string::npos)
    return "install the device driver of 3D Systems, which has " + part + ", see docs/devices.md";
  return "install OpenHaptics and the device driver of 3D Systems, or set FUAI_HD_LIBRARY to its libHD.so, "
         "see "
         "docs/devices.md";
}

std::string HdSession::problem_of(VendorLibrary& library, HdApi& api) {
  library.find("hdInitDevice", api.init_device);
  library.find("hdDisableDevice", api.disable_device);
  library.find("hdMakeCurrentDevice", api.make_current_device);
  library.find("hdEnable", api.enable);
  library.find("hdBeginFrame", api.begin_frame);
  library.find("hdEndFrame", api.end_frame);
  library.find("hdGetDoublev", api.get_doublev);
  library.find("hdSetDoublev", api.set_doublev);
  library.find("hdGetIntegerv", api.get_integerv);
  library.find("hdGetString", api.get_string);
  library.find("hdGetError", api.get_error);
  library.find("hdGetErrorString", api.get_error_string);
  library.find("hdCheckCalibration", api.check_calibration);
  library.find("hdUpdateCalibration", api.update_calibration);
  library.find("hdStartScheduler", api.start_scheduler);
  library.find("hdStopScheduler", api.stop_scheduler);
  library.find("hdSetSchedulerRate", api.set_scheduler_rate);
  library.find("hdScheduleAsynchronous", api.schedule_asynchronous);
  library.find("hdUnschedule", api.unschedule);
  return library.problem();
}

std::shared_ptr<HdSession> HdSession::get() {
  static std::weak_ptr<HdSession> shared;
  if (std::shared_ptr<HdSession> session = shared.lock()) return session;
  // The vendor's driver reads its calibration with the program's locale: a decimal comma breaks the angles.
  std::setlocale(LC_NUMERIC, "C");
  VendorLibrary library(kHdLibraryVariable, kNames);
  auto session = std::make_shared<HdSession>();
  const std::string problem = problem_of(library, session->api_);
  if (!problem.empty())
    throw Error(ErrorKind::kNoDevice, problem, {"", 0, 0, "device"}, hd_library_cure(library));
  shared = session;
  return session;
}

void HdSession::pause() noexcept {
  if (running_) api_.stop_scheduler();
  running_ = false;
}

void HdSession::resume(int change) noexcept {
  devices_ += change;
  if (devices_ <= 0) return;
  api_.set_scheduler_rate(kRate);
  api_.start_scheduler();
  running_ = true;
}

void HdSession::forget_errors() const noexcept {
  for (int i = 0; i < kMostErrors && api_.get_error().error_code != kHdSuccess; ++i) continue;
}

std::string HdSession::take_error() const {
  std::string text;
  for (int i = 0; i < kMostErrors; ++i) {
    const HdErrorInfo error = api_.get_error();
    if (error.error_code == kHdSuccess) break;
    if (!text.empty()) continue;
    const char* const told = api_.get_error_string(error.error_code);
    char number[64];
    std::snprintf(number, sizeof number, " (error 0x%x, internal %d)", error.error_code,
                  error.internal_error_code);
    text = std::string(told != nullptr ? told : "no text") + number;
  }
  return text;
}

}  // namespace fuai
