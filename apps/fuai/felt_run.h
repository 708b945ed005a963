// Runs a felt scene: hands on devices, paths and cloth, in virtual time or in real time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "felt_setup.h"
#include "fuai/haptics/force_error.h"
#include "fuai/runtime/realtime_session.h"

namespace fuai_app {

/// Who says whether a hand holds cloth.
enum class HoldBy {
  kScene,   ///< the scene, by time
  kAlways,  ///< nobody lets go
  kButton   ///< any button of the device, or its gripper more than half closed
};

/// A run to be done.
struct FeltPlan {
  FeltSetup setup;
  std::string device, hand;  ///< --device and --hand
  std::int64_t ticks = 0;
  std::vector<std::vector<fuai::Vec3>> ways;  ///< of the simulated hands' devices [m] (hands, ticks)
  HoldBy hold = HoldBy::kScene;
  bool virtual_time = false, reference = true;
};

/// What a run was.
struct FeltResult {
  std::vector<fuai::TickRecord> records;  ///< by tick, and within a tick by hand
  std::size_t hands = 1;
  fuai::ForceCounters counters;  ///< of the first hand, as is the map
  fuai::WorkspaceMap map;
  std::uint64_t cloth_steps = 0, failed_steps = 0, state_hash = 0;
  std::optional<fuai::ForceError> error;
  std::optional<fuai::RealtimeReport> realtime;  ///< none: in virtual time
  bool stopped = false;                          ///< by a signal, before its ticks were done
};

/// Before the scene's motion begins the hand rests, so that it is felt at full force: the ramp [s].
double rest_time();
/// Whether the device is a simulated one. @throws fuai::Error (kUsage) for a driver that does not exist.
bool is_simulated(const std::string& device);
/// "simulated:touch" -> the preset. @throws fuai::Error (kUsage).
const fuai::SimulatedDeviceSpec& simulated_spec(const std::string& device);
/// Lays the scene's hands into the device's workspace: ways, scale, centres, stiffness of the holds.
/// @param plan device info, ticks and force gain are set
void fit_plan(FeltPlan& plan, const fuai::EngineScene& scene);

/// @param listener hears of everything; may be null
FeltResult run_felt(const Console& console, const fuai::EngineScene& scene, const FeltPlan& plan,
                    fuai::SessionListener* listener);

}  // namespace fuai_app
