// What the system knows of plugged devices: USB ids, permissions of device nodes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuai/device/registry.h"

namespace fuai {

/// A device on the USB bus.
struct UsbId {
  std::string_view vendor;   ///< four hexadecimal digits, small letters
  std::string_view product;  ///< the same; empty: any of this vendor
  std::string_view name;     ///< for people
};

/// Where the system lists things; tests give other folders.
struct SystemPaths {
  std::string usb = "/sys/bus/usb/devices";
  std::string devices = "/dev";
};

/// Adds a finding for each plugged device of the list, and whether this user may open it; one that says
/// "none" with all ids when there is none. Never throws for what it finds. Thread class: set-up.
/// @return whether one is there
bool find_usb_devices(std::span<const UsbId> ids, std::vector<DriverFinding>& findings,
                      const SystemPaths& paths = {});

/// Adds a finding for each device node whose path under `paths.devices` begins with `prefix` ("ttyACM",
/// "input/js"): whether this user may read it (and write it, if `write`). Thread class: set-up.
/// @return the paths that may be opened, sorted
std::vector<std::string> find_device_nodes(std::string_view prefix, bool write,
                                           std::vector<DriverFinding>& findings,
                                           const SystemPaths& paths = {});

}  // namespace fuai
