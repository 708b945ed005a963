// Rectangular sheets for the scenes of the engine: sizes, ways to start, and where hands take hold.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/cloth/cloth_piece.h"
#include "fuai/core/smooth_rise.h"
#include "fuai/fabric/laws.h"
#include "fuai/scenes/engine_scene.h"

namespace fuai {

/// Options with the scene's own values filled in. @throws Error (kUsage) out of range. Thread class: set-up.
SceneOptions fill_scene_options(const SceneOptions& options, int own_size, double own_spacing = 0.01);

/// Rectangle of columns x rows nodes, nothing held yet. Thread class: set-up.
ClothPieceSpec make_sheet_spec(const FabricLaws& laws, int columns, int rows, double spacing);

/// Model, material, flat start at z = 0 and a name. Thread class: set-up.
EngineScene make_sheet_scene(const char* name, const FabricLaws& laws, const ClothPieceSpec& spec);

/// The edge at y = height held as a hem is by a rail: one row of slots. Thread class: set-up.
Clamp make_top_edge_clamp(double height, double spacing);

/// Puts the cloth upright, top edge (largest y) at z = 0, face to -y. Thread class: set-up.
void hang_upright(EngineScene& scene);

/// Upright, in waves without strain that take `slack` off its width. Thread class: set-up.
void hang_in_waves(EngineScene& scene, double slack);

/// The sheet of taut_patch, yank and shake: upright, top edge clamped with 5 % slack, one fingertip at the
/// middle of the bottom edge. Thread class: set-up.
EngineScene make_clamped_sheet(const char* name, const FabricLaws& laws, const SceneOptions& options);

/// Where a point of the cloth is when the scene starts [m]. Thread class: set-up.
Vec3 start_position(const EngineScene& scene, const Vec2& material);

}  // namespace fuai
