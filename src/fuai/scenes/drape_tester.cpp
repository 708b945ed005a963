// The drape tester: a round specimen on a smaller disc.
// SPDX-License-Identifier: Apache-2.0
// Source: BS 5058; docs/theory/drape.md.
#include <cmath>
#include <numbers>

#include "fuai/scenes/drape_specimen.h"
#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/scene_sheet.h"

namespace fuai {
namespace {

/// Which of the uneven specimens: any would do.
constexpr std::uint64_t kSeed = 1;
/// The pedestal as it is seen, in parts of the disc: its plate, and the stem below.
constexpr double kPlate = 0.045, kStem = 0.3;

}  // namespace

EngineScene make_drape_tester(const FabricLaws& laws, const SceneOptions& options) {
  // Without a size, the specimen of the standard at any spacing; a disc cuts cells anyway.
  SceneOptions o = fill_scene_options(options, 31);
  DrapeGeometry geometry = kCusickGeometry;
  if (options.size == 0) {
    o = fill_scene_options({static_cast<int>(std::ceil(geometry.specimen / o.spacing - 1e-6)) + 1, o.spacing},
                           0);
  } else {
    const double scale = (o.size - 1) * o.spacing / geometry.specimen;
    geometry.specimen *= scale;
    geometry.disc *= scale;
  }
  geometry.spacing = o.spacing;
  EngineScene scene = make_sheet_scene("drape_tester", laws, make_drape_spec(geometry, laws.areal_mass));
  scene.start = make_drape_start(geometry, scene.model, kSeed);
  scene.seconds = 3.0;
  scene.view.azimuth = -90.0 * std::numbers::pi / 180.0;
  scene.view.elevation = 16.0 * std::numbers::pi / 180.0;
  const double side = 0.45 * geometry.specimen, radius = 0.5 * geometry.disc;
  const SceneColumn plate{Vec3(0.0, 0.0, -0.001), radius, kPlate * geometry.disc};
  const SceneColumn stem{plate.top - Vec3(0.0, 0.0, plate.height), kStem * radius, 1.3 * geometry.overhang()};
  scene.view.columns = {plate, stem};
  scene.view.low = Vec3(-side, -side, stem.top.z() - stem.height);
  scene.view.high = Vec3(side, side, 0.0);
  return scene;
}

}  // namespace fuai
