// The scenes by name, for programs: what there is, and how to run one to a moment.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "fuai/cloth/surface_mesh.h"
#include "fuai/core/progress.h"
#include "fuai/fabric/laws.h"
#include "fuai/solver/relaxation.h"

namespace fuai {

/// One line of the list of scenes.
struct SceneEntry {
  std::string_view name;
  std::string_view description;
};

/// All scenes. Thread class: any.
std::span<const SceneEntry> scene_entries();

/// What a scene shows at a moment.
struct SceneMoment {
  SurfaceMesh mesh;
  RelaxationResult relaxation;
};

/// Runs a scene of the paper. The descent has no time of its own: a second counts as ten steps, the paper's
/// update rate.
/// @param seconds moment to stop at [s]; nothing: when the cloth is at rest (as printed: 3000 s, it never is)
/// @throws Error (kUsage) with the nearest name for a scene that does not exist. Thread class: set-up.
SceneMoment run_scene(std::string_view name, const FabricLaws& laws, PaperMode mode,
                      std::optional<double> seconds, const Progress& progress = {});

}  // namespace fuai
