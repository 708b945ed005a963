// Looks at sysfs and at device nodes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/system_findings.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace fuai {
namespace {

/// The first word of a small file; empty when there is none.
std::string read_word(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string word;
  file >> word;
  return word;
}

DriverFinding permission(const std::string& what, const std::string& node, bool write) {
  if (::access(node.c_str(), F_OK) != 0) return {what, "plugged, but there is no " + node, false};
  if (::access(node.c_str(), write ? R_OK | W_OK : R_OK) == 0) return {what, "may open " + node, true};
  return {what, "no permission for " + node + ": add a udev rule, or yourself to its group", false};
}

/// "/dev/bus/usb/001/007"
std::string usb_node(const SystemPaths& paths, const std::filesystem::path& device) {
  char node[32];
  std::snprintf(node, sizeof node, "/bus/usb/%03d/%03d", std::atoi(read_word(device / "busnum").c_str()),
                std::atoi(read_word(device / "devnum").c_str()));
  return paths.devices + node;
}

std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> entries;
  std::error_code error;
  for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    entries.push_back(at->path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

std::string id_text(const UsbId& id) {
  return std::string(id.vendor) + (id.product.empty() ? "" : ":" + std::string(id.product));
}

}  // namespace

bool find_usb_devices(std::span<const UsbId> ids, std::vector<DriverFinding>& findings,
                      const SystemPaths& paths) {
  bool any = false;
  for (const std::filesystem::path& device : entries_of(paths.usb)) {
    const std::string vendor = read_word(device / "idVendor");
    if (vendor.empty()) continue;
    const std::string product = read_word(device / "idProduct");
    for (const UsbId& id : ids) {
      if (vendor != id.vendor || (!id.product.empty() && product != id.product)) continue;
      std::string name = "USB ";
      name.append(vendor).append(":").append(product).append(" (").append(id.name).append(")");
      findings.push_back(permission(name, usb_node(paths, device), true));
      any = true;
      break;
    }
  }
  if (any) return true;
  std::string all;
  for (const UsbId& id : ids)
    all += (all.empty() ? "" : ", ") + id_text(id) + " (" + std::string(id.name) + ")";
  findings.push_back({"USB", "none of " + all + " is plugged in", false});
  return false;
}

std::vector<std::string> find_device_nodes(std::string_view prefix, bool write,
                                           std::vector<DriverFinding>& findings, const SystemPaths& paths) {
  const std::filesystem::path begin = std::filesystem::path(paths.devices) / prefix;
  std::vector<std::string> nodes;
  bool any = false;
  for (const std::filesystem::path& path : entries_of(begin.parent_path())) {
    if (path.filename().string().rfind(begin.filename().string(), 0) != 0) continue;
    any = true;
    findings.push_back(permission("device node", path.string(), write));
    if (findings.back().fine) nodes.push_back(path.string());
  }
  if (!any) findings.push_back({"device node", "there is no " + begin.string() + "*", false});
  return nodes;
}

}  // namespace fuai
