// Drives devices of OpenHaptics.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/device_openhaptics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fuai/core/error.h"
#include "fuai/device/device_axes.h"
#include "fuai/device/device_simulated.h"
#include "fuai/device/hd_session.h"
#include "fuai/device/system_findings.h"

namespace fuai {
namespace {

constexpr const char* kDriver = "openhaptics";
constexpr double kMetres = 1e-3;        ///< of the vendor's millimetres
constexpr double kPause = 0.5;          ///< before a lost device is opened again [s]
constexpr double kStale = 0.1;          ///< without a tick, or a command, until nothing is trusted [s]
constexpr int kSilentTicks = 500;       ///< without force after warm motors or a limit: half a second
constexpr int kCalibrationEvery = 100;  ///< ticks between looks at the calibration
constexpr int kMostErrors = 16;         ///< that are taken a tick

/// Tried when no name is given; nullptr is the vendor's own default.
constexpr std::array<const char*, 3> kUsualNames{"Default Device", "Default PHANToM", nullptr};
constexpr std::array<UsbId, 3> kUsbIds{
    {{"2988", "0304", "Touch"}, {"2988", "0302", "Touch, older"}, {"2988", "", "3D Systems"}}};

/// Whose stiffness and damping hold for a model of the vendor's.
struct Model {
  std::string_view part;  ///< of its name, small letters
  std::string_view preset;
};
constexpr std::array<Model, 5> kModels{{{"touch x", "touch-x"},
                                        {"desktop", "touch-x"},
                                        {"touch", "touch"},
                                        {"omni", "touch"},
                                        {"premium", "premium"}}};

/// Of a model that nobody knows: CHAI3D's limits of an unknown PHANToM, the weakest motors of all.
DeviceInfo unknown_info() {
  DeviceInfo info;
  info.peak_force = 3.3;
  info.continuous_force = 0.88;
  info.stable_stiffness = 1000.0;
  info.stable_damping = 8.0;
  info.workspace_low = Vec3::Constant(-0.05);
  info.workspace_high = Vec3::Constant(0.05);
  info.resolution = 55e-6;
  info.mass = 0.045;
  return info;
}

DeviceInfo info_of_model(const std::string& model) {
  std::string small = model;
  for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  for (const Model& known : kModels)
    if (small.find(known.part) != std::string::npos) return find_device_preset(known.preset).info;
  return unknown_info();
}

std::string shown(const char* name) {
  return name == nullptr ? "the default" : "'" + std::string(name) + "'";
}

DriverReport probe() {
  DriverReport report;
  VendorLibrary library(kHdLibraryVariable, hd_library_names());
  HdApi api;
  report.why_not = HdSession::problem_of(library, api);
  report.findings = library.findings();
  find_usb_devices(kUsbIds, report.findings);
  find_device_nodes("ttyACM", true, report.findings);
  std::string names;
  for (const char* name : kUsualNames) names += (names.empty() ? "" : ", ") + shown(name);
  report.findings.push_back({"names that are tried", names, true});
  report.available = report.why_not.empty();
  if (!report.available) report.cure = hd_library_cure(library);
  report.models = {"Default Device", "Default PHANToM"};
  return report;
}

}  // namespace

DeviceOpenHaptics::DeviceOpenHaptics(const std::string& name, DeviceClock clock)
    : session_(HdSession::get()), clock_(clock), name_(name) {
  const char* const given = name_.c_str();
  const std::span<const char* const> names =
      name_.empty() ? std::span<const char* const>(kUsualNames) : std::span<const char* const>(&given, 1);
  std::string tried;
  for (const char* one : names) {
    const std::string problem = open_device_named(one);
    if (problem.empty()) {
      used_name_ = one;
      make_info();
      if (start()) return;
      tried += (tried.empty() ? "" : "; ") + shown(one) + ": " + "its forces could not be switched on";
      continue;
    }
    tried += (tried.empty() ? "" : "; ") + shown(one) + ": " + problem;
  }
  session_->resume(0);
  throw Error(
      ErrorKind::kNoDevice, "OpenHaptics opens no device: " + tried, {"", 0, 0, "device"},
      "pair the device with the vendor's set-up program, give its name there as openhaptics:NAME, allow "
      "its node to you; see `fuai haptics devices --diagnose` and docs/devices.md");
}

DeviceOpenHaptics::~DeviceOpenHaptics() { stop(); }

std::string DeviceOpenHaptics::open_device_named(const char* name) {
  session_->pause();
  session_->take_error();
  handle_ = session_->api().init_device(name);
  const std::string error = session_->take_error();
  if (error.empty() && handle_ != kHdInvalidHandle) return {};
  if (handle_ != kHdInvalidHandle) session_->api().disable_device(handle_);
  handle_ = kHdInvalidHandle;
  return error.empty() ? "no device, and no error told" : error;
}

/// With the device current and the scheduler standing.
void DeviceOpenHaptics::make_info() {
  const HdApi& api = session_->api();
  const char* const model = api.get_string(kHdDeviceModelType);
  info_ = info_of_model(model != nullptr ? model : "");
  info_.driver = kDriver;
  info_.model = model != nullptr && *model != '\0' ? model : "unknown device of OpenHaptics";
  info_.sources =
      "forces, workspace: the vendor's driver; stiffness, damping: CHAI3D; mass, thermal time: assumed";
  info_.command_timeout = kStale;
  const auto positive = [&](HdValue name, double& value) {
    double told = 0.0;
    api.get_doublev(name, &told);
    if (std::isfinite(told) && told > 0.0) value = told;
  };
  positive(kHdNominalMaxForce, info_.peak_force);
  positive(kHdNominalMaxContinuousForce, info_.continuous_force);
  info_.continuous_force = std::min(info_.continuous_force, info_.peak_force);
  double box[6] = {};
  api.get_doublev(kHdUsableWorkspace, box);
  const Vec3 one = kMetres * from_y_up(Vec3(box[0], box[1], box[2]));
  const Vec3 other = kMetres * from_y_up(Vec3(box[3], box[4], box[5]));
  const Vec3 low = one.cwiseMin(other), high = one.cwiseMax(other);
  if ((high - low).minCoeff() > 0.0 && (high - low).allFinite()) {
    info_.workspace_low = low;
    info_.workspace_high = high;
  }
  session_->take_error();  // what a device does not tell is assumed
}

/// Scheduler standing, device current. It runs afterwards, whatever comes out.
bool DeviceOpenHaptics::start() noexcept {
  const HdApi& api = session_->api();
  api.make_current_device(handle_);
  for (const unsigned capability :
       {kHdMaxForceClamping, kHdForceRamping, kHdSoftwareForceLimit, kHdForceOutput}) {
    api.enable(capability);
    const bool done = api.get_error().error_code == kHdSuccess;
    if (!done && capability == kHdForceOutput) {
      api.disable_device(handle_);
      handle_ = kHdInvalidHandle;
      session_->resume(0);
      return false;
    }
  }
  silent_ticks_ = ticks_ = 0;
  calibrated_ = false;
  commands_.put({});  // what was wanted before is not wanted now
  callback_ = api.schedule_asynchronous(&DeviceOpenHaptics::scheduled, this, kHdHighPriority);
  started_ = clock_();
  running_ = true;
  session_->resume(1);
  return true;
}

void DeviceOpenHaptics::stop() noexcept {
  if (!running_) return;
  const HdApi& api = session_->api();
  session_->pause();
  api.unschedule(callback_);
  // The scheduler stands: this thread may have a frame of its own.
  constexpr double kNone[3] = {};
  api.begin_frame(handle_);
  api.set_doublev(kHdCurrentForce, kNone);
  api.end_frame(handle_);
  api.disable_device(handle_);
  handle_ = kHdInvalidHandle;
  session_->forget_errors();
  running_ = false;
  session_->resume(-1);
}

unsigned DeviceOpenHaptics::scheduled(void* self) noexcept {
  return static_cast<DeviceOpenHaptics*>(self)->tick();
}

void DeviceOpenHaptics::read_state(DeviceSample& sample) noexcept {
  const HdApi& api = session_->api();
  double position[3] = {}, velocity[3] = {}, transform[16] = {};
  int buttons = 0;
  api.get_doublev(kHdCurrentPosition, position);
  api.get_doublev(kHdCurrentVelocity, velocity);
  api.get_doublev(kHdCurrentTransform, transform);
  api.get_integerv(kHdCurrentButtons, &buttons);
  sample.position = kMetres * from_y_up(Vec3(position[0], position[1], position[2]));
  sample.velocity = kMetres * from_y_up(Vec3(velocity[0], velocity[1], velocity[2]));
  Mat3 turn;
  for (std::size_t j = 0; j < 3; ++j)
    turn.col(static_cast<Eigen::Index>(j)) =
        Vec3(transform[4 * j], transform[4 * j + 1], transform[4 * j + 2]);
  sample.orientation = turn_from_y_up(turn);
  sample.buttons = static_cast<std::uint32_t>(buttons);
}

Vec3 DeviceOpenHaptics::wanted_force(double now, DeviceSample& sample) noexcept {
  commands_.fetch();
  const Timed& given = commands_.value();
  if (now - given.time > kStale) {
    if (given.time >= started_) sample.status |= kDeviceTimedOut;
    return Vec3::Zero();
  }
  if (silent_ticks_ > 0 || !calibrated_) return Vec3::Zero();
  bool cut = false;
  Vec3 force = force_within(given.command, info_.peak_force, cut);
  if (cut) sample.status |= kDeviceSaturated;
  return force;
}

/// @return whether the device is still there
bool DeviceOpenHaptics::take_errors(DeviceSample& sample) noexcept {
  for (int i = 0; i < kMostErrors; ++i) {
    const unsigned code = session_->api().get_error().error_code;
    if (code == kHdSuccess) return true;
    if (code < kHdWarmMotors || code > kHdForceError) return false;
    silent_ticks_ = kSilentTicks;
    silent_reason_ = kDeviceForceOff | (code == kHdWarmMotors ? kDeviceWarm : kDeviceReady);
    sample.status |= silent_reason_;
  }
  return false;  // errors without end
}

unsigned DeviceOpenHaptics::tick() noexcept {
  const HdApi& api = session_->api();
  const double now = clock_();
  DeviceSample sample;
  sample.time = now;
  api.begin_frame(handle_);
  read_state(sample);
  if (!calibrated_ || ticks_ % kCalibrationEvery == 0) {
    const unsigned calibration = api.check_calibration();
    calibrated_ = calibration == kHdCalibrationOk;
    if (calibration == kHdCalibrationNeedsUpdate && ticks_ % kCalibrationEvery == 0) {
      int style = 0;
      api.get_integerv(kHdCalibrationStyle, &style);
      api.update_calibration(static_cast<unsigned>(style));
    }
  }
  ++ticks_;
  if (!calibrated_) sample.status |= kDeviceUncalibrated;
  if (silent_ticks_ > 0) {
    --silent_ticks_;
    sample.status |= silent_reason_;
  }
  const Vec3 force = wanted_force(now, sample);
  const Vec3 to_device = to_y_up(force);
  api.set_doublev(kHdCurrentForce, to_device.data());
  api.end_frame(handle_);
  if (take_errors(sample) && sample.position.allFinite()) {
    samples_.put(sample);
    return kHdCallbackContinue;
  }
  sample.status = kDeviceDisconnected;
  constexpr double kNone[3] = {};
  api.begin_frame(handle_);
  api.set_doublev(kHdCurrentForce, kNone);
  api.end_frame(handle_);
  session_->forget_errors();  // the next device's tick must not take them for its own
  samples_.put(sample);
  return kHdCallbackDone;
}

/// Once: the device by the name that it had. Whatever comes out, the scheduler runs again for the others.
void DeviceOpenHaptics::open_again() noexcept {
  const HdApi& api = session_->api();
  session_->pause();
  handle_ = api.init_device(used_name_);
  if (handle_ != kHdInvalidHandle && api.get_error().error_code == kHdSuccess) {
    start();
    return;
  }
  if (handle_ != kHdInvalidHandle) api.disable_device(handle_);
  handle_ = kHdInvalidHandle;
  session_->forget_errors();
  session_->resume(0);
}

DeviceSample DeviceOpenHaptics::read() noexcept {
  const double now = clock_();
  if (running_) {
    bool lost = false;
    if (samples_.fetch()) {
      lost = (samples_.value().status & kDeviceDisconnected) != 0;
      if (!lost) last_ = samples_.value();
    }
    if (lost || now - std::max(last_.time, started_) > kStale) {
      stop();
      retry_.wait(now, kPause);
    }
  } else if (retry_.due(now)) {
    retry_.wait(now, kPause);
    open_again();
  }
  // Nothing is to be trusted before the first tick after opening.
  if (!running_ || last_.time < started_) last_.status = kDeviceDisconnected;
  return last_;
}

void DeviceOpenHaptics::write(const DeviceCommand& command) noexcept { commands_.put({command, clock_()}); }

DeviceDriver openhaptics_driver() {
  return {kDriver, "3D Systems Touch, Touch X and PHANToM, by OpenHaptics", true, probe,
          [](const DeviceRequest& request) -> std::unique_ptr<Device> {
            return std::make_unique<DeviceOpenHaptics>(request.model);
          }};
}

}  // namespace fuai
