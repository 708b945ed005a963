// What a cloth shows slot by slot: strains, angles, curvatures, moments, stresses, energy and speed, for heat
// maps and plots; and the state of the cloth at one place, for live loops.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md, "Strain measures"; laws with their memory: fuai/fabric/play_law.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "fuai/cloth/cloth_model.h"
#include "fuai/solver/cloth_material.h"

namespace fuai {

/// A quantity of every place of the cloth.
enum class ClothField : std::uint8_t {
  kWarpStrain,     ///< of the warp yarns [-]
  kWeftStrain,     ///< [-]
  kShearAngle,     ///< [rad]
  kWarpCurvature,  ///< of the warp yarns, positive toward the face [1/m]
  kWeftCurvature,  ///< [1/m]
  kWarpMoment,     ///< per width, with friction [N]
  kWeftMoment,     ///< [N]
  kWarpStress,     ///< force per width [N/m]
  kWeftStress,     ///< [N/m]
  kShearStress,    ///< [N/m]
  kEnergy,         ///< free energy of all deformation per area [J/m2]
  kSpeed,          ///< [m/s]
};
inline constexpr int kClothFieldCount = 12;

/// Whether its sign means something: such fields are drawn with a diverging map about zero.
constexpr bool is_signed(ClothField field) noexcept {
  return field != ClothField::kEnergy && field != ClothField::kSpeed;
}

/// Means over the elements of each slot: the edges that meet in it, the cells about it, its own triple.
/// @param values out (slots); not a number where the slot carries nothing of the kind. Thread class:
/// real-time.
void evaluate_field(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                    ClothField field, std::span<double> values) noexcept;

/// Strain and stress of each law at a place: of the element that has most of a patch. Means over elements
/// that are strained unlike each other would lie beside the loop of the law.
struct ClothProbe {
  struct Pair {
    double strain = 0.0;  ///< curvature [1/m], angle [rad] or strain [-]
    double stress = 0.0;  ///< moment per width [N] or force per width [N/m]
  };
  Pair warp_bending, weft_bending, shear, warp_tension, weft_tension;
};
/// @param weights of the slots, summing to 1, e.g. those of a grasp. Thread class: real-time.
ClothProbe probe_cloth(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                       std::span<const int> slots, std::span<const double> weights) noexcept;

}  // namespace fuai
