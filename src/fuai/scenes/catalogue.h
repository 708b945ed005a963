// The scenes by name, for programs: what there is, and how to run one to a moment.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "fuai/cloth/surface_mesh.h"
#include "fuai/core/progress.h"
#include "fuai/fabric/laws.h"
#include "fuai/scenes/engine_scene.h"
#include "fuai/solver/relaxation.h"

namespace fuai {

/// What runs a scene.
enum class SceneKind {
  kEngine,  ///< the cloth engine: make_engine_scene()
  kPaper,   ///< the founding paper's descent: run_scene()
};

/// One line of the list of scenes.
struct SceneEntry {
  std::string_view name;
  std::string_view description;
  SceneKind kind;
};

/// All scenes, those of the engine first. Thread class: any.
std::span<const SceneEntry> scene_entries();

/// @throws Error (kUsage) with all names for a scene that does not exist. Thread class: set-up.
const SceneEntry& find_scene(std::string_view name);

/// Builds a scene of the engine. @throws Error (kUsage) for a scene that does not exist or is the paper's,
/// and for options out of range. Thread class: set-up.
EngineScene make_engine_scene(std::string_view name, const FabricLaws& laws,
                              const SceneOptions& options = {});

/// What a scene shows at a moment.
struct SceneMoment {
  SurfaceMesh mesh;
  RelaxationResult relaxation;
};

/// Runs a scene of the paper. The descent has no time of its own: a second counts as ten steps, the paper's
/// update rate.
/// @param seconds moment to stop at [s]; nothing: when the cloth is at rest (as printed: 3000 s, it never is)
/// @throws Error (kUsage) for a scene that does not exist or is the engine's. Thread class: set-up.
SceneMoment run_scene(std::string_view name, const FabricLaws& laws, PaperMode mode,
                      std::optional<double> seconds, const Progress& progress = {});

}  // namespace fuai
