// The scenes of the cloth engine, one builder each. Lengths that a scene's text names hold for its own size
// and spacing; another size scales the hand's path with the cloth where the text says so.
// SPDX-License-Identifier: Apache-2.0
//
//   z is up. A sheet that lies has its face up; a sheet that hangs has its top edge at z = 0 along x and
//   looks to -y.
#pragma once

#include "fuai/fabric/laws.h"
#include "fuai/scenes/engine_scene.h"

namespace fuai {

// All: @throws Error (kUsage) for options out of their range (SceneOptions). Thread class: set-up.

/// Square sheet, 33 x 33 at 1 cm, let go from level, held by two corners that come 10 % closer in 0.5 s.
EngineScene make_hanging_sheet(const FabricLaws& laws, const SceneOptions& options = {});

/// Strip of `size` (64) rows and size / 8 + 1 columns (3 or more) that hangs from its top edge, unstretched
/// at first.
EngineScene make_hanging_strip(const FabricLaws& laws, const SceneOptions& options = {});

/// 32 x 32 at 1 cm, top edge clamped with 5 % slack (in waves); a fingertip at the middle of the bottom edge
/// goes 6 cm aside, 2 cm forward and 4 mm down and back, twice a second, with an upright tremor of 1 mm at 8
/// Hz. The pull scales with the sheet, the tremor does not.
EngineScene make_taut_patch(const FabricLaws& laws, const SceneOptions& options = {});

/// The sheet of taut_patch; at 0.1 s the fingertip goes forward at 5 m/s for 20 ms and stops.
EngineScene make_yank(const FabricLaws& laws, const SceneOptions& options = {});

/// The sheet of taut_patch; the fingertip zig-zags between the corners of a cube of 30 cm at 5 m/s and rests
/// 20 ms in each. What the cloth cannot follow slips.
EngineScene make_shake(const FabricLaws& laws, const SceneOptions& options = {});

/// 17 x 17 at 1 cm without gravity, two rows clamped; a fingertip lifts the middle of the free edge by 4 cm
/// (scales with the sheet) in 1 s and brings it back in another.
EngineScene make_bending(const FabricLaws& laws, const SceneOptions& options = {});

/// The founding paper's drape on the engine: a sheet of 17 cm, a corner block of 4 cm held, let go from
/// level. The clamp ends at the edge of the block whatever the spacing (1 cm). With a size, the sheet is
/// (size - 1) spacings wide and the block scales with it.
EngineScene make_corner_drape(const FabricLaws& laws, const SceneOptions& options = {});

/// 33 x 33 at 1 cm, far edge held; a hand that holds it near a corner lets it sag from level, lifts the
/// corner by 15 cm (scales with the sheet), holds it, and lets go at 2.5 s.
EngineScene make_grasp_and_lift(const FabricLaws& laws, const SceneOptions& options = {});

/// 33 x 33 at 1 cm, two fifths pinned flat on a table, the rest falls over its edge.
EngineScene make_table_edge(const FabricLaws& laws, const SceneOptions& options = {});

/// The drape tester of BS 5058: a round specimen of 30 cm on a disc of 18 cm, yarns at 1 cm, let go from flat
/// with the small unevenness of drape_specimen.h. With a size, the specimen is (size - 1) spacings wide and
/// the disc scales with it. Nothing keeps the cloth out of the pedestal.
EngineScene make_drape_tester(const FabricLaws& laws, const SceneOptions& options = {});

}  // namespace fuai
