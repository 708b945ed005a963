// How the scenes are photographed: camera, table, colours.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuai/cloth/surface_mesh.h"
#include "fuai/fabric/fabric.h"
#include "fuai/picture/cloth_picture.h"
#include "fuai/scenes/engine_scene.h"

namespace fuai {

/// What the block of the corner drape lies on; it is drawn only, nothing keeps the cloth out of it.
enum class DrapeSupport {
  kTable,  ///< down to the ground, as in the paper
  kBoard,  ///< so thin that it hides no cloth that hangs where a table would stand
};

/// The corner drape seen from beyond its free corner, with what it hangs from.
/// @param aspect width over height of the picture
ClothPicture paper_drape_picture(SurfaceMesh mesh, const std::string& caption, double aspect,
                                 DrapeSupport support = DrapeSupport::kTable);

/// The bent strip seen from its side, with what clamps it and force arrows [m].
ClothPicture paper_bending_picture(SurfaceMesh mesh, std::vector<ArrowItem> arrows,
                                   const std::string& caption, double aspect);

/// The picture of a scene of scenes/catalogue.h by its name; an unknown name gets the bending scene's camera.
ClothPicture scene_picture(std::string_view scene, SurfaceMesh mesh, const std::string& caption,
                           double aspect);

/// A moment of a scene of the engine: the cloth with its true outline, tables and rails, single held nodes as
/// pegs, and the pull of each hand, against what it feels, as an arrow from where it holds.
/// @param hands readings of the hands that hold; others are left out
ClothPicture engine_scene_picture(const EngineScene& scene, const ClothState& state,
                                  std::span<const GraspReading> hands, const std::string& caption,
                                  double aspect);

/// What stands about the cloth of a scene of the engine: tables, rails, pegs, and a ground below it all; no
/// cloth, no camera.
/// @param positions of the cloth now [m]
ClothPicture scene_stage_picture(const EngineScene& scene, std::span<const Vec3> positions);

/// The yarns of a fabric for a cloth of a picture, see weave_of(). Thread class: any.
YarnItem yarns_of(const Fabric& fabric);

/// The pull of each hand, against what it feels, as an arrow from where it holds, with its newtons.
/// @param hands readings of the hands that hold; others are left out. Thread class: set-up.
void add_pull_arrows(const EngineScene& scene, std::span<const GraspReading> hands, ClothPicture& picture);

/// Forces of cloth go from a tenth of a millinewton to ten newtons: how long an arrow is, from 0 to 1, grows
/// with the logarithm. @param force [N]. Thread class: any.
double force_share(double force) noexcept;

}  // namespace fuai
