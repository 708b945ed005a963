// Collects the material of the engine from the laws of a fabric.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/cloth_material.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace fuai {

PlayLaw with_buckling_onset(const PlayLaw& tension, double buckling_stress) {
  const CurveTable& elastic = tension.elastic();
  const double k0 = elastic.node_count() > 1 ? elastic.evaluate(0.0).slope : 0.0;
  const double kc = elastic.extrapolation().slope_low;
  if (elastic.low() != 0.0 || !(k0 > kc) || !(buckling_stress > 0.0)) return tension;
  // From slope k0 at zero down to kc at -e0, where the stress is -buckling_stress; straight beyond.
  const double e0 = 2.0 * buckling_stress / (k0 + kc), spacing = elastic.spacing();
  const auto extra = static_cast<std::size_t>(std::ceil(e0 / spacing)) + 1;
  const std::size_t count = elastic.node_count() + extra;
  std::vector<double> stress(count), strength(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double strain = (static_cast<double>(i) - static_cast<double>(extra)) * spacing;
    const double bent = std::max(strain, -e0);
    stress[i] = i < extra ? k0 * bent + 0.5 * (k0 - kc) * bent * bent / e0 + kc * (strain - bent)
                          : elastic.nodes()[i - extra];
    strength[i] = tension.friction().evaluate(std::max(strain, 0.0)).value;
  }
  const double low = -static_cast<double>(extra) * spacing;
  return make_play_law(make_curve_table(low, elastic.high(), stress, elastic.extrapolation()),
                       make_curve_table(low, elastic.high(), strength, constant_outside()),
                       tension.elements());
}

ClothMaterial make_cloth_material(const FabricLaws& laws) {
  constexpr auto kWarp = static_cast<std::size_t>(Direction::kWarp);
  constexpr auto kWeft = static_cast<std::size_t>(Direction::kWeft);
  constexpr auto kBias = static_cast<std::size_t>(Direction::kBias);
  ClothMaterial material;
  material.weft_bending = laws.bending[kWeft];
  material.warp_bending = laws.bending[kWarp];
  material.shear = laws.shear;
  const auto onset = [](const PlayLaw& tension, const PlayLaw& bending) {
    const double wave_number = 2.0 * std::numbers::pi / assumed::kCompressionWavelength;
    return with_buckling_onset(tension, bending_rigidity(bending) * wave_number * wave_number);
  };
  material.weft_tension = onset(laws.tensile[kWeft], laws.bending[kWeft]);
  material.warp_tension = onset(laws.tensile[kWarp], laws.bending[kWarp]);
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

double tension_toe(const PlayLaw& tension) noexcept {
  // A tensile table starts at zero strain, and the table's own first cell answers there: the slope from
  // above.
  return std::max(tension.elastic().evaluate(0.0).slope, 0.0);
}

double tension_viscosity(const PlayLaw& tension, double viscosity_time) noexcept {
  return viscosity_time * tension_toe(tension);
}

double free_edge_softening(const ClothMaterial& material, const PlayLaw& other) noexcept {
  const double coupling = material.poisson_bending;
  if (coupling == 0.0) return 0.0;
  const double slope = other.elastic().evaluate(0.0).slope;
  return slope > 0.0 ? coupling * coupling / slope : 0.0;
}

}  // namespace fuai
