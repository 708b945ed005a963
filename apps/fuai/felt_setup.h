// A scene in the hand: which device lies how to which cloth, and how to build it all, the first time or for a
// replay.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fuai/device/device_simulated.h"
#include "fuai/haptics/cloth_hand.h"
#include "fuai/haptics/force_path_rt.h"
#include "session_files.h"

namespace fuai_app {

/// The program's own tick [s]: every preset does at least this rate.
inline constexpr double kTick = 1e-3;

/// Everything that a felt run depends on besides what the hands do: numbers that a recording keeps.
struct FeltSetup {
  SceneSetup scene;
  fuai::DeviceInfo device;
  double force_gain = 1.0;
  double scale = 1.0;                      ///< metres of cloth to a metre of the device
  double cloth_period = 0.0;               ///< [s]; 0: with every tick, without a tangent
  double hold_stiffness = 0.0;             ///< most that a hold may have [N/m]
  double reach = 0.0;                      ///< ClothHandOptions::reach [m]
  bool control = true;                     ///< of the passivity controller
  std::vector<fuai::Vec3> device_centres;  ///< of the hands' maps [m]
};

/// The cloth with the hands of a scene. @throws fuai::Error.
std::unique_ptr<fuai::ClothHand> make_cloth(const fuai::EngineScene& scene, const FeltSetup& setup);
/// How a hand of the scene grips, softened to what the device renders.
fuai::GraspSpec make_grasp(const fuai::EngineScene& scene, const FeltSetup& setup, std::size_t hand);
/// The path of a hand. @param cloth as it is at the start
fuai::ForcePathOptions make_path_options(const FeltSetup& setup, const fuai::ClothHand& cloth,
                                         std::size_t hand);

/// The setup as a recording keeps it, and back. @throws fuai::Error (kBadInput) when something is missing.
fuai::SessionLogInfo felt_info(const FeltSetup& setup, const fuai::Fabric& fabric);
FeltSetup felt_setup_of(const fuai::SessionLogInfo& info);

}  // namespace fuai_app
