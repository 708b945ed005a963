// Collects the material of the engine from the laws of a fabric.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/cloth_material.h"

#include <algorithm>
#include <cstddef>

namespace fuai {

ClothMaterial make_cloth_material(const FabricLaws& laws) {
  constexpr auto kWarp = static_cast<std::size_t>(Direction::kWarp);
  constexpr auto kWeft = static_cast<std::size_t>(Direction::kWeft);
  constexpr auto kBias = static_cast<std::size_t>(Direction::kBias);
  ClothMaterial material;
  material.weft_bending = laws.bending[kWeft];
  material.warp_bending = laws.bending[kWarp];
  material.shear = laws.shear;
  material.weft_tension = laws.tensile[kWeft];
  material.warp_tension = laws.tensile[kWarp];
  material.notes.emplace_back("bending coupling B12 was not measured: taken as 0");
  const double twist = 0.25 * (4.0 * bending_rigidity(laws.bending[kBias]) -
                               bending_rigidity(laws.bending[kWarp]) - bending_rigidity(laws.bending[kWeft]));
  material.twist_stiffness = std::max(twist, 0.0);
  if (twist < 0.0) {
    material.notes.emplace_back(
        "the bias is softer in bending than warp and weft allow: twist stiffness taken as 0");
  }
  return material;
}

double tension_viscosity(const PlayLaw& tension, double viscosity_time) noexcept {
  // A tensile table starts at zero strain, and the table's own first cell answers there: the slope from
  // above.
  return viscosity_time * std::max(tension.elastic().evaluate(0.0).slope, 0.0);
}

double free_edge_softening(const ClothMaterial& material, const PlayLaw& other) noexcept {
  const double coupling = material.poisson_bending;
  if (coupling == 0.0) return 0.0;
  const double slope = other.elastic().evaluate(0.0).slope;
  return slope > 0.0 ? coupling * coupling / slope : 0.0;
}

}  // namespace fuai
