// Numbers of the devices that laboratories own.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/haptics.md, "Presets": makers' figures as cited in the literature, CHAI3D's tuned limits.
#include <array>
#include <string>

#include "fuai/core/error.h"
#include "fuai/device/device_simulated.h"

namespace fuai {
namespace {

/// The numbers of a row, in SI.
struct Row {
  std::string_view name;
  const char* model;
  Vec3 workspace;  // width, depth, height [m]
  double peak, continuous;
  double stiffness, damping;  // CHAI3D's limits
  double resolution, rate, mass;
  double viscous, friction;
  const char* sources;
};

constexpr const char* kMaker =
    "forces, workspace, resolution, mass, friction: maker's figures as cited; "
    "stiffness, damping: CHAI3D; viscous damping, thermal time: assumed";

SimulatedDeviceSpec make_spec(const Row& row) {
  SimulatedDeviceSpec spec;
  DeviceInfo& info = spec.info;
  info.driver = "simulated";
  info.model = row.model;
  info.sources = row.sources;
  info.workspace_low = -0.5 * row.workspace;
  info.workspace_high = 0.5 * row.workspace;
  info.peak_force = row.peak;
  info.continuous_force = row.continuous;
  info.stable_stiffness = row.stiffness;
  info.stable_damping = row.damping;
  info.resolution = row.resolution;
  info.rate = row.rate;
  info.mass = row.mass;
  info.command_timeout = 0.1;
  spec.damping = row.viscous;
  spec.friction = row.friction;
  return spec;
}

std::array<DevicePreset, 6> make_presets() {
  const std::array<Row, 6> rows{
      Row{"premium",
          "PHANToM Premium 1.5",
          {0.381, 0.191, 0.267},
          8.5,
          1.4,
          800.0,
          5.0,
          30e-6,
          1000.0,
          0.075,
          0.1,
          0.04,
          kMaker},
      Row{"touch",
          "3D Systems Touch",
          {0.160, 0.070, 0.120},
          3.3,
          0.88,
          400.0,
          4.0,
          55e-6,
          1000.0,
          0.045,
          0.1,
          0.26,
          kMaker},
      Row{"touch-x",
          "3D Systems Touch X",
          {0.160, 0.120, 0.120},
          7.9,
          1.75,
          1000.0,
          5.0,
          23e-6,
          1000.0,
          0.045,
          0.1,
          0.06,
          kMaker},
      Row{"omega.3",
          "Force Dimension omega.3",
          {0.160, 0.160, 0.110},
          12.0,
          12.0,
          5000.0,
          30.0,
          10e-6,
          4000.0,
          0.1,
          0.2,
          0.02,
          "forces, workspace, resolution, rate: maker's figures as cited; stiffness, damping: CHAI3D; mass, "
          "viscous damping, friction: assumed"},
      Row{"falcon",
          "Novint Falcon",
          {0.102, 0.102, 0.102},
          8.9,
          4.5,
          3000.0,
          20.0,
          60e-6,
          1000.0,
          0.15,
          0.5,
          0.3,
          "peak force, workspace, resolution, rate: maker's figures as cited; stiffness, damping: CHAI3D; "
          "continuous force, mass, viscous damping, friction: assumed"},
      Row{"inverse3",
          "Haply Inverse3",
          {0.30, 0.30, 0.30},
          10.0,
          5.0,
          1000.0,
          6.0,
          10e-6,
          3000.0,
          0.1,
          0.2,
          0.05,
          "peak force, workspace, stiffness, damping: CHAI3D's fork for Haply; resolution, rate: as cited; "
          "continuous force, mass, viscous damping, friction: assumed"},
  };
  std::array<DevicePreset, 6> presets;
  for (std::size_t i = 0; i < rows.size(); ++i) presets[i] = {rows[i].name, make_spec(rows[i])};
  return presets;
}

}  // namespace

std::span<const DevicePreset> device_presets() {
  static const std::array<DevicePreset, 6> presets = make_presets();
  return presets;
}

const SimulatedDeviceSpec& find_device_preset(std::string_view name) {
  std::string names;
  for (const DevicePreset& preset : device_presets()) {
    if (preset.name == name) return preset.spec;
    names += (names.empty() ? "" : ", ") + std::string(preset.name);
  }
  throw Error(ErrorKind::kUsage, "there is no simulated device '" + std::string(name) + "'",
              {"", 0, 0, "device"}, "take one of " + names);
}

}  // namespace fuai
