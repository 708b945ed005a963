// Drives Force Dimension's devices.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/device_forcedimension.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "fuai/core/error.h"
#include "fuai/device/device_simulated.h"
#include "fuai/device/system_findings.h"
#include "fuai/device/vendor_library.h"

namespace fuai {
namespace {

constexpr const char* kDriver = "forcedimension";
constexpr double kPause = 0.5;  ///< before a lost device is opened again [s]
/// Reads between looks at the status: one more transfer on the bus each.
constexpr unsigned kStatusEvery = 50;
/// Of the grippers of omega.7 and sigma.7 when open [m]; assumed.
constexpr double kOpenGap = 0.025;

/// libdrd holds libdhd's functions too and knows whether a device is calibrated: first.
constexpr std::array kNames{"libdrd.so", "libdrd.so.3", "libdhd.so", "libdhd.so.3"};
constexpr std::array<UsbId, 2> kUsbIds{{{"1451", "", "Force Dimension"}, {"0403", "cb48", "Novint Falcon"}}};
constexpr const char* kCure =
    "install the vendor's SDK (forcedimension.com/software/sdk) and set FUAI_DHD_LIBRARY to its libdrd.so or "
    "libdhd.so, see docs/devices.md";

/// A type of the vendor's, and where its numbers come from.
struct Type {
  int number;
  std::string_view model;
  std::string_view preset;  ///< of device_simulated.h whose numbers hold; empty: the ones here
  bool wrist, gripper;
  double peak = 0.0;              // [N]
  double stiffness = 0.0;         // [N/m]
  double damping = 0.0;           // [N s/m]
  Vec3 workspace = Vec3::Zero();  // [m]
};

const std::array kTypes{
    Type{33, "omega.3", "omega.3", false, false},
    Type{34, "omega.6", "omega.3", true, false},
    Type{36, "omega.6", "omega.3", true, false},
    Type{35, "omega.7", "omega.3", true, true},
    Type{37, "omega.7", "omega.3", true, true},
    Type{60, "falcon", "falcon", false, false},
    Type{63, "delta.3", "", false, false, 20.0, 5000.0, 30.0, Vec3(0.4, 0.4, 0.26)},
    Type{206, "sigma.3", "", false, false, 12.0, 4000.0, 30.0, Vec3::Constant(0.15)},
    Type{104, "sigma.7", "", true, true, 12.0, 4000.0, 30.0, Vec3::Constant(0.15)},
    Type{105, "sigma.7", "", true, true, 12.0, 4000.0, 30.0, Vec3::Constant(0.15)},
    Type{203, "lambda.3", "", false, false, 12.0, 4000.0, 30.0, Vec3::Constant(0.15)},
    Type{108, "lambda.7", "", true, true, 12.0, 4000.0, 30.0, Vec3::Constant(0.15)},
    Type{109, "lambda.7", "", true, true, 12.0, 4000.0, 30.0, Vec3::Constant(0.15)},
};
/// Of a type that the table does not have: what every one of the vendor's gives.
const Type kUnknownType{0, "unknown", "", false, false, 5.0, 1000.0, 5.0, Vec3::Constant(0.1)};

const Type& type_of(int number) noexcept {
  for (const Type& type : kTypes)
    if (type.number == number) return type;
  return kUnknownType;
}

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const Type& type : kTypes)
    if (names.empty() || names.back() != type.model) names.emplace_back(type.model);
  return names;
}

bool load_functions(VendorLibrary& library, DhdApi& api) {
  library.find("dhdGetDeviceCount", api.get_device_count);
  library.find("dhdGetSystemName", api.get_system_name);
  library.find("dhdGetSystemType", api.get_system_type);
  library.find("dhdErrorGetLastStr", api.error_get_last_str);
  library.find("dhdEnableForce", api.enable_force);
  library.find("dhdGetPosition", api.get_position);
  library.find("dhdGetLinearVelocity", api.get_linear_velocity);
  library.find("dhdGetButtonMask", api.get_button_mask);
  library.find("dhdSetForce", api.set_force);
  library.find("dhdGetStatus", api.get_status);
  // A device that libdrd is to know of must be opened by it.
  if (!library.find_optional("drdOpenID", api.open_id) || !library.find_optional("drdClose", api.close) ||
      !library.find_optional("drdIsInitialized", api.is_initialized)) {
    api.is_initialized = nullptr;
    library.find("dhdOpenID", api.open_id);
    library.find("dhdClose", api.close);
  }
  library.find_optional("dhdGetSDKVersion", api.get_sdk_version);
  library.find_optional("dhdSetGravityCompensation", api.set_gravity_compensation);
  library.find_optional("dhdGetMaxForce", api.get_max_force);
  library.find_optional("dhdGetOrientationFrame", api.get_orientation_frame);
  library.find_optional("dhdGetGripperGap", api.get_gripper_gap);
  return library.loaded() && library.missing_functions().empty();
}

std::string vendor_text(const DhdApi& api) {
  const char* const text = api.error_get_last_str();
  return text != nullptr && *text != '\0' ? text : "no reason given";
}

/// Ours from the device's: x towards the user, y right, z up.
Vec3 from_device(double x, double y, double z) noexcept { return {y, -x, z}; }

DeviceInfo make_info(const Type& type, const char* vendor_name, double max_force) {
  DeviceInfo info;
  if (!type.preset.empty()) {
    info = find_device_preset(type.preset).info;
  } else {
    info.peak_force = info.continuous_force = type.peak;
    info.stable_stiffness = type.stiffness;
    info.stable_damping = type.damping;
    info.workspace_low = -0.5 * type.workspace;
    info.workspace_high = 0.5 * type.workspace;
    info.resolution = 20e-6;
    info.mass = 0.1;
    info.sources = "force, stiffness, damping, workspace: maker's figures and CHAI3D; the rest: assumed";
  }
  info.driver = kDriver;
  info.model = vendor_name != nullptr ? vendor_name : std::string(type.model);
  info.rate = 1000.0;
  info.command_timeout = 0.0;  // nothing is known of one: forces stay until the next command
  if (std::isfinite(max_force) && max_force > 0.0) {
    info.peak_force = std::min(info.peak_force, max_force);
    info.continuous_force = std::min(info.continuous_force, info.peak_force);
  }
  return info;
}

DriverReport probe() {
  DriverReport report;
  VendorLibrary library(kDhdLibraryVariable, kNames);
  DhdApi api;
  const bool usable = load_functions(library, api);
  report.findings = library.findings();
  report.models = model_names();
  if (usable && api.get_sdk_version != nullptr) {
    int v[4] = {};
    api.get_sdk_version(&v[0], &v[1], &v[2], &v[3]);
    report.findings.push_back({"SDK version",
                               std::to_string(v[0]) + "." + std::to_string(v[1]) + "." +
                                   std::to_string(v[2]) + "." + std::to_string(v[3]),
                               true});
  }
  find_usb_devices(kUsbIds, report.findings);
  report.why_not = library.problem();
  report.cure = report.why_not.empty() ? "" : kCure;
  if (!usable) return report;
  const int count = api.get_device_count();
  report.findings.push_back({"devices that the library sees",
                             count > 0 ? std::to_string(count) : "none (" + vendor_text(api) + ")",
                             count > 0});
  if (count <= 0) {
    report.why_not = "the vendor's library sees no device: " + vendor_text(api);
    report.cure = "plug the device in and switch it on; if it is, see the USB lines of --diagnose";
  }
  report.available = report.why_not.empty();
  return report;
}

/// -1 when `model` is no number.
int index_in(const std::string& model) {
  int index = -1;
  const std::from_chars_result read = std::from_chars(model.data(), model.data() + model.size(), index);
  return read.ec == std::errc{} && read.ptr == model.data() + model.size() && index >= 0 && index < 64 ? index
                                                                                                       : -1;
}

void check_model(const std::string& model) {
  const std::vector<std::string> names = model_names();
  if (model.empty() || index_in(model) >= 0 || std::find(names.begin(), names.end(), model) != names.end())
    return;
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  throw Error(ErrorKind::kUsage, "there is no Force Dimension device '" + model + "'", {"", 0, 0, "device"},
              "take one of " + all + " or its number, from 0");
}

}  // namespace

DeviceForceDimension::DeviceForceDimension(const std::string& model, DeviceClock clock) : clock_(clock) {
  check_model(model);
  VendorLibrary library(kDhdLibraryVariable, kNames);
  if (!load_functions(library, api_))
    throw Error(ErrorKind::kNoDevice, library.problem(), {"", 0, 0, "device"}, kCure);
  const int count = api_.get_device_count(), wanted = index_in(model);
  std::string seen;
  for (int i = 0; i < std::min(count, 64); ++i) {
    if (wanted >= 0 && i != wanted) continue;
    if (!open_index(i)) {
      seen += (seen.empty() ? "" : "; ") + ("device " + std::to_string(i) + ": " + vendor_text(api_));
      continue;
    }
    type_ = api_.get_system_type(id_);
    const Type& type = type_of(type_);
    if (model.empty() || wanted >= 0 || type.model == model) {
      has_wrist_ = type.wrist && api_.get_orientation_frame != nullptr;
      has_gripper_ = type.gripper && api_.get_gripper_gap != nullptr;
      info_ = make_info(type, api_.get_system_name(id_),
                        api_.get_max_force != nullptr ? api_.get_max_force(id_) : -1.0);
      if (start()) return;
      seen += (seen.empty() ? "" : "; ") + ("device " + std::to_string(i) + ": " + vendor_text(api_));
    } else {
      seen += (seen.empty() ? "" : "; ") + ("device " + std::to_string(i) + " is of type " +
                                            std::string(type.model) + " (" + std::to_string(type_) + ")");
    }
    close();
  }
  throw Error(ErrorKind::kNoDevice,
              "no Force Dimension device could be opened: " + (seen.empty() ? vendor_text(api_) : seen),
              {"", 0, 0, "device"},
              "plug the device in, switch it on, close other programs that use it; see `fuai haptics devices "
              "--diagnose`");
}

DeviceForceDimension::~DeviceForceDimension() {
  if (!open_) return;
  api_.set_force(0.0, 0.0, 0.0, id_);
  api_.enable_force(0, id_);
  api_.close(id_);
}

bool DeviceForceDimension::open_index(int index) noexcept {
  const int id = api_.open_id(static_cast<char>(index));
  if (id < 0) return false;
  id_ = static_cast<char>(id);
  index_ = index;
  open_ = true;
  return true;
}

/// Forces on, at zero.
bool DeviceForceDimension::start() noexcept {
  if (api_.set_gravity_compensation != nullptr) api_.set_gravity_compensation(1, id_);  // not all have it
  saturated_ = false;
  reads_ = 0;
  if (api_.set_force(0.0, 0.0, 0.0, id_) < 0 || api_.enable_force(1, id_) < 0) return false;
  look_at_status();
  return open_;
}

bool DeviceForceDimension::open_again() noexcept {
  if (api_.get_device_count() <= index_ || !open_index(index_)) return false;
  // Another device in its place would get forces that were not made for it.
  if (api_.get_system_type(id_) == type_ && start()) return true;
  close();
  return false;
}

/// Once: its number may be another device's afterwards.
void DeviceForceDimension::close() noexcept {
  if (open_) api_.close(id_);
  open_ = false;
}

void DeviceForceDimension::lose() noexcept {
  api_.set_force(0.0, 0.0, 0.0, id_);
  api_.enable_force(0, id_);
  close();
  retry_.wait(clock_(), kPause);
}

void DeviceForceDimension::look_at_status() noexcept {
  int status[kDhdStatusLength] = {};
  slow_status_ = kDeviceReady;
  if (api_.get_status(status, id_) < 0) {
    lose();
    return;
  }
  if (status[kDhdPower] == 0 || status[kDhdForce] == 0 || status[kDhdForceOffCause] != 0)
    slow_status_ |= kDeviceForceOff;
  if (api_.is_initialized != nullptr && !api_.is_initialized(id_)) slow_status_ |= kDeviceUncalibrated;
  if (status[kDhdConnected] == 0) lose();
}

bool DeviceForceDimension::read_pose() noexcept {
  double x = 0.0, y = 0.0, z = 0.0;
  if (api_.get_position(&x, &y, &z, id_) < 0 || !std::isfinite(x + y + z)) return false;
  const Vec3 position = from_device(x, y, z);
  last_.velocity.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (api_.get_linear_velocity(&x, &y, &z, id_) >= 0) last_.velocity = from_device(x, y, z);
  if (has_wrist_) {
    double frame[3][3] = {};
    if (api_.get_orientation_frame(frame, id_) < 0) return false;
    for (int j = 0; j < 3; ++j) last_.orientation.col(j) = from_device(frame[0][j], frame[1][j], frame[2][j]);
    if (!last_.orientation.allFinite()) {
      last_.orientation.setIdentity();
      return false;
    }
    // The same turn on the right: an untwisted hand has the identity.
    const Mat3 turned = last_.orientation;
    last_.orientation.col(0) = turned.col(1);
    last_.orientation.col(1) = -turned.col(0);
  }
  if (has_gripper_) {
    double gap = 0.0;
    if (api_.get_gripper_gap(&gap, id_) < 0 || !std::isfinite(gap)) return false;
    last_.pinch = std::clamp(1.0 - gap / kOpenGap, 0.0, 1.0);
  }
  last_.buttons = api_.get_button_mask(id_);
  last_.position = position;
  return true;
}

DeviceSample DeviceForceDimension::read() noexcept {
  const double now = clock_();
  last_.time = now;
  if (!open_ && retry_.due(now) && !open_again()) retry_.wait(now, kPause);
  if (open_ && reads_++ % kStatusEvery == kStatusEvery - 1) look_at_status();
  if (open_ && !read_pose()) lose();
  last_.status = open_ ? slow_status_ | (saturated_ ? kDeviceSaturated : kDeviceReady) : kDeviceDisconnected;
  return last_;
}

void DeviceForceDimension::write(const DeviceCommand& command) noexcept {
  if (!open_) return;
  const Vec3 force = force_within(command, info_.peak_force, saturated_);
  // To the device's: x towards the user is minus our y.
  const int done = api_.set_force(-force.y(), force.x(), force.z(), id_);
  if (done < 0) lose();
  if (done == kDhdMotorSaturated) saturated_ = true;
}

DeviceDriver forcedimension_driver() {
  return {kDriver, "Force Dimension omega, delta, sigma, lambda and Novint Falcon, by the vendor's library",
          true, probe, [](const DeviceRequest& request) -> std::unique_ptr<Device> {
            return std::make_unique<DeviceForceDimension>(request.model);
          }};
}

}  // namespace fuai
