// All drivers by name: which are available, and if not, why.
// SPDX-License-Identifier: Apache-2.0
//
//   A driver is one file that defines a DeviceDriver, and one line in registry.cpp.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuai/device/device.h"

namespace fuai {

/// One thing that was looked at: a library, a USB id, a permission, a name.
struct DriverFinding {
  std::string what;
  std::string found;
  bool fine = false;
};

/// Whether a driver can be opened.
struct DriverReport {
  bool available = false;
  std::string why_not;  ///< empty when available
  std::string cure;     ///< what the user can do about it
  std::vector<DriverFinding> findings;
  std::vector<std::string> models;  ///< what it can open; names for DeviceRequest::model
};

/// Which device is wanted.
struct DeviceRequest {
  std::string model;  ///< empty: the driver's first
};

/// A driver. Plain functions, so that drivers need no registration at run time.
struct DeviceDriver {
  std::string_view name;
  std::string_view description;  ///< one line
  bool force = false;            ///< it can give force; else input only
  /// Looks, and asks servers; gives no force, leaves nothing open, never throws for what it finds. Thread
  /// class: set-up.
  DriverReport (*probe)();
  /// @throws Error (kNoDevice) with the reason, the vendor's own text where there is one, and a cure;
  /// (kUsage) for a model that does not exist. Thread class: set-up.
  std::unique_ptr<Device> (*open)(const DeviceRequest& request);
};

/// All drivers, the simulated one first. Thread class: any.
std::span<const DeviceDriver> device_drivers();
/// @throws Error (kUsage) with all names for a driver that does not exist. Thread class: set-up.
const DeviceDriver& find_device_driver(std::string_view name);
/// Opens a device; "driver" or "driver:model". @throws Error as find_device_driver and DeviceDriver::open do.
/// Thread class: set-up.
std::unique_ptr<Device> open_device(std::string_view name);

/// The driver of computed devices, see device_simulated.h. The hand it opens with rests in the middle.
DeviceDriver simulated_driver();
/// Force Dimension and Falcon, see device_forcedimension.h.
DeviceDriver forcedimension_driver();
/// PHANToM and Touch, see device_openhaptics.h.
DeviceDriver openhaptics_driver();
/// Haply Inverse3, see device_inverse3.h.
DeviceDriver inverse3_driver();
/// Devices behind a VRPN server, see device_vrpn.h.
DeviceDriver vrpn_driver();
/// 3D mouse, see device_spacenav.h.
DeviceDriver spacenav_driver();
/// Gamepad, see device_gamepad.h.
DeviceDriver gamepad_driver();
/// Mouse, see device_mouse.h. A window makes its own, to have set().
DeviceDriver mouse_driver();

}  // namespace fuai
