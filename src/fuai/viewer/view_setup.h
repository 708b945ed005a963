// What lies on the table: scene, lattice, and one to four fabrics with what was changed about them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fuai/fabric/fabric.h"
#include "fuai/fabric/laws.h"
#include "fuai/scenes/engine_scene.h"

namespace fuai {

/// A number of the fabric that a slider multiplies.
enum class FabricFactor : std::uint8_t {
  kWeight,           ///< areal mass
  kWarpBending,      ///< B of warp
  kWeftBending,      ///< B of weft
  kBendingFriction,  ///< 2HB of both
  kShear,            ///< G
  kShearFriction,    ///< 2HG, 2HG5
  kWarpTension,      ///< stress of the tensile law, warp
  kWeftTension,      ///< the same, weft
};
inline constexpr std::size_t kFabricFactorCount = 8;
inline constexpr double kLeastFactor = 0.1, kMostFactor = 10.0;

/// Most fabrics side by side.
inline constexpr std::size_t kMostViewFabrics = 4;

/// A fabric, as measured, and its factors.
struct ViewFabric {
  std::string source;  ///< as load_fabric() takes it
  Fabric measured;
  std::array<double, kFabricFactorCount> factors;  ///< all 1: as measured
  ViewFabric() { factors.fill(1.0); }
  bool changed() const noexcept;
};

/// A bundled fabric, a fabric file, or what import_fabrics() makes one of; of a sheet the first. Measured
/// curves may follow, "wool-tropical + my.bending.warp.csv": each takes the place of what the fabric knows of
/// its test and direction. What it has to be known by stays in `source`. @throws Error as load_fabric(),
/// import_fabrics() and replace_by_curve(). Thread class: set-up.
ViewFabric load_view_fabric(const std::string& source);

/// `source` with a curve file behind it, where it stands once. Thread class: any.
std::string with_curve(std::string source, const std::string& path);

/// Laws with the factors applied: elastic curves and friction of the laws are scaled, so that measured curves
/// keep their shape. @throws Error as make_fabric_laws(), and (kUsage) for a factor out of range.
/// Thread class: set-up.
FabricLaws make_view_laws(const ViewFabric& fabric);

/// Everything that a session is built from; a value, of which undo keeps copies.
struct ViewSetup {
  std::string scene = "hanging_sheet";
  SceneOptions size;
  std::vector<ViewFabric> fabrics;  ///< 1 to kMostViewFabrics
  bool scene_moves = false;         ///< hands and pins of the scene do what the scene says
  bool felt = false;                ///< a device gives the force: stepped by make_felt_options()
};

}  // namespace fuai
