// What is said of USB devices and device nodes, on folders made up like the system's.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "fuai/device/system_findings.h"

using namespace fuai;

namespace {

/// A folder with usb/1-2/{idVendor, ...} and dev/; removed at the end.
struct System {
  System() : top(std::filesystem::temp_directory_path() / ("fuai-usb-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(top / "usb" / "1-2");
    std::filesystem::create_directories(top / "dev" / "bus" / "usb" / "001");
    std::filesystem::create_directories(top / "usb" / "usb1");  // without ids
    paths = {(top / "usb").string(), (top / "dev").string()};
  }
  System(const System&) = delete;
  System& operator=(const System&) = delete;
  ~System() { std::filesystem::remove_all(top); }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(top / name) << text << "\n";
  }

  std::filesystem::path top;
  SystemPaths paths;
};

constexpr std::array<UsbId, 2> kIds{{{"1451", "", "Force Dimension"}, {"0403", "cb48", "Novint Falcon"}}};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("USB devices by vendor and product, with their permissions") {
    const System system;
    std::vector<DriverFinding> findings;
    CHECK(!find_usb_devices(kIds, findings, {"/nowhere", "/nowhere"}));
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].found == "none of 1451 (Force Dimension), 0403:cb48 (Novint Falcon) is plugged in");
    CHECK(!findings[0].fine);

    findings.clear();
    system.put("usb/1-2/idVendor", "0403");
    system.put("usb/1-2/idProduct", "6001");  // the vendor's chip in something else
    system.put("usb/1-2/busnum", "1");
    system.put("usb/1-2/devnum", "7");
    CHECK(!find_usb_devices(kIds, findings, system.paths));

    findings.clear();
    system.put("usb/1-2/idProduct", "cb48");
    CHECK(find_usb_devices(kIds, findings, system.paths));
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].what == "USB 0403:cb48 (Novint Falcon)");
    CHECK(!findings[0].fine);  // no node

    findings.clear();
    system.put("dev/bus/usb/001/007", "");
    find_usb_devices(kIds, findings, system.paths);
    CHECK(findings[0].fine);
    CHECK(findings[0].found.find("/bus/usb/001/007") != std::string::npos);
  }

  TEST_CASE("device nodes: none, allowed, forbidden") {
    const System system;
    std::vector<DriverFinding> findings;
    CHECK(find_device_nodes("ttyACM", true, findings, system.paths).empty());
    CHECK(findings.at(0).found.find("there is no ") == 0);
    system.put("dev/ttyACM0", "");
    system.put("dev/ttyS0", "");
    findings.clear();
    CHECK(find_device_nodes("ttyACM", true, findings, system.paths) ==
          std::vector<std::string>{system.paths.devices + "/ttyACM0"});
    if (::geteuid() == 0) return;  // root may open everything
    std::filesystem::permissions(system.top / "dev" / "ttyACM0", std::filesystem::perms::none);
    findings.clear();
    CHECK(find_device_nodes("ttyACM", true, findings, system.paths).empty());
    CHECK(findings.at(0).found.find("no permission") == 0);
  }
}
