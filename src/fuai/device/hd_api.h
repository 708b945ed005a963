// Functions, types and numbers of OpenHaptics' HDAPI that are used, as the vendor's own reference names them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fuai {

/// What hdGetError gives, by value.
struct HdErrorInfo {
  unsigned error_code;
  int internal_error_code;
  unsigned handle;
};

/// Called by the scheduler's thread once a tick; kHdCallbackContinue to be called again.
using HdCallback = unsigned (*)(void* context);

/// Pointers into libHD.
struct HdApi {
  unsigned (*init_device)(const char* name) = nullptr;
  void (*disable_device)(unsigned device) = nullptr;
  void (*make_current_device)(unsigned device) = nullptr;
  void (*enable)(unsigned capability) = nullptr;
  void (*begin_frame)(unsigned device) = nullptr;
  void (*end_frame)(unsigned device) = nullptr;
  void (*get_doublev)(unsigned name, double* values) = nullptr;
  void (*set_doublev)(unsigned name, const double* values) = nullptr;
  void (*get_integerv)(unsigned name, int* values) = nullptr;
  const char* (*get_string)(unsigned name) = nullptr;
  HdErrorInfo (*get_error)() = nullptr;
  const char* (*get_error_string)(unsigned code) = nullptr;
  unsigned (*check_calibration)() = nullptr;
  void (*update_calibration)(unsigned style) = nullptr;
  void (*start_scheduler)() = nullptr;
  void (*stop_scheduler)() = nullptr;
  void (*set_scheduler_rate)(unsigned long rate) = nullptr;
  unsigned long (*schedule_asynchronous)(HdCallback callback, void* context,
                                         unsigned short priority) = nullptr;
  void (*unschedule)(unsigned long handle) = nullptr;
};

inline constexpr unsigned kHdInvalidHandle = 0xFFFFFFFF;
inline constexpr unsigned kHdCallbackDone = 0, kHdCallbackContinue = 1;
inline constexpr unsigned short kHdHighPriority = 65535;

/// Names of values; lengths in mm.
enum HdValue : unsigned {
  kHdCurrentButtons = 0x2000,
  kHdCurrentPosition = 0x2050,
  kHdCurrentVelocity = 0x2051,
  kHdCurrentTransform = 0x2052,  ///< 16, column by column
  kHdDeviceModelType = 0x2501,
  kHdUsableWorkspace = 0x2551,  ///< 6: lowest x, y, z, highest x, y, z
  kHdCalibrationStyle = 0x2555,
  kHdNominalMaxForce = 0x2603,
  kHdNominalMaxContinuousForce = 0x2604,
  kHdCurrentForce = 0x2700
};

/// What can be switched on.
enum HdCapability : unsigned {
  kHdForceOutput = 0x4000,
  kHdMaxForceClamping = 0x4001,
  kHdForceRamping = 0x4002,
  kHdSoftwareForceLimit = 0x4003
};

enum HdCalibration : unsigned {
  kHdCalibrationOk = 0x5000,
  kHdCalibrationNeedsUpdate = 0x5001,
  kHdCalibrationNeedsManualInput = 0x5002
};

/// Errors after which the device goes on; all others are the end of the connection.
enum HdError : unsigned {
  kHdSuccess = 0,
  kHdWarmMotors = 0x200,
  kHdExceededMaxForce = 0x201,
  kHdExceededMaxForceImpulse = 0x202,
  kHdExceededMaxVelocity = 0x203,
  kHdForceError = 0x204
};

}  // namespace fuai
