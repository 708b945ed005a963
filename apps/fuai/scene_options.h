// What the commands that run scenes share: finding a scene, its size and spacing, and moments in time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "command_line.h"
#include "fuai/scenes/catalogue.h"

namespace fuai_app {

/// Longest run [s], and most steps of one.
inline constexpr double kMostSeconds = 3600.0;
inline constexpr std::int64_t kMostSteps = 10'000'000;

/// The scene of that name. @throws Error (kUsage) with the nearest name and all names.
const fuai::SceneEntry& named_scene(const std::string& name);

/// The solver of that name.
/// @param precision "float", "double", or empty: the solver's own. The implicit solver has both.
/// @throws Error (kUsage) with the nearest name and all names, and for a precision that it does not have.
const fuai::SolverEntry& named_solver(const std::string& name, const std::string& precision);

/// The options --size and --spacing.
void declare_size(const Command& command, int& size, std::string& spacing);

/// @param spacing with unit, or empty. @throws Error (kUsage).
fuai::SceneOptions scene_options(int size, const std::string& spacing);

/// How wide a picture is on cloth, 1 mm to 10 m [m]. @throws Error (kUsage).
double picture_width_value(const std::string& text, const char* option);

/// A time of 0 or more [s]: "2s", or where `bare` a number of seconds too. @throws Error (kUsage).
double time_value(const std::string& text, const char* option, bool bare);

/// Steps of dt that last so long, at least one.
/// @param option that gave `seconds`. @throws Error (kUsage) beyond kMostSeconds or kMostSteps.
std::int64_t steps_of(double seconds, double dt, const char* option);

}  // namespace fuai_app
