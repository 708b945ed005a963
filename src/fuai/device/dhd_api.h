// Functions of Force Dimension's library, as the vendor's own documentation names them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fuai {

/// Pointers into libdhd or libdrd. Lengths in metres, forces in newtons; `char id` is what the open call
/// returned, never -1 ("the current one"): plain char has no sign on ARM.
struct DhdApi {
  int (*get_device_count)() = nullptr;
  int (*open_id)(char index) = nullptr;
  int (*close)(char id) = nullptr;
  const char* (*get_system_name)(char id) = nullptr;
  int (*get_system_type)(char id) = nullptr;
  const char* (*error_get_last_str)() = nullptr;
  int (*enable_force)(unsigned char on, char id) = nullptr;
  int (*get_position)(double* x, double* y, double* z, char id) = nullptr;
  int (*get_linear_velocity)(double* x, double* y, double* z, char id) = nullptr;
  unsigned (*get_button_mask)(char id) = nullptr;
  int (*set_force)(double x, double y, double z, char id) = nullptr;
  int (*get_status)(int status[32], char id) = nullptr;
  // May be missing.
  void (*get_sdk_version)(int* major, int* minor, int* release, int* revision) = nullptr;
  int (*set_gravity_compensation)(int on, char id) = nullptr;
  double (*get_max_force)(char id) = nullptr;
  int (*get_orientation_frame)(double frame[3][3], char id) = nullptr;
  int (*get_gripper_gap)(double* gap, char id) = nullptr;
  bool (*is_initialized)(char id) = nullptr;  ///< of libdrd only
};

/// What its functions return besides 0 for "done"; anything negative is an error.
enum DhdReturn { kDhdTimeGuard = 1, kDhdMotorSaturated = 2 };

/// Places in the array of dhdGetStatus that are looked at.
enum DhdStatusIndex { kDhdPower = 0, kDhdConnected = 1, kDhdForce = 5, kDhdForceOffCause = 14 };

/// The longest array that any version fills is 17; a margin, as older headers have less.
inline constexpr int kDhdStatusLength = 32;

}  // namespace fuai
