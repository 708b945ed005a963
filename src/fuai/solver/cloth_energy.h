// Energy and forces of the lattice in double, element by element: the reference that the vector kernels of
// the implicit solver are held against, and the force of the explicit solver.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md. Gradients: cloth_measures.h; laws and memory: fuai/fabric/play_law.h.
//
//   state        last committed step: positions x_n, velocities, friction memory
//   positions    trial positions x; may be the state's own
//   incremental  W_n(x) from the memory of the state, whose gradient is the force; the free energy is another
//                number, and the difference is what friction took
//   collapsed elements (see cloth_measures.h) add nothing
#pragma once

#include <cstddef>
#include <span>

#include "fuai/cloth/cloth_model.h"
#include "fuai/solver/cloth_material.h"

namespace fuai {

/// Parts of an energy [J].
struct ClothEnergy {
  double stretch = 0.0;    ///< tension of both yarn directions
  double viscosity = 0.0;  ///< A eta (eps - eps_n)^2 / (2 dt); zero in a free energy
  double shear = 0.0;
  double bending = 0.0;  ///< both directions and their coupling B12
  double twist = 0.0;
  double weight = 0.0;  ///< -sum m g.x, zero at the origin of coordinates

  /// All that internal forces are the gradient of [J].
  double internal() const noexcept { return stretch + viscosity + shear + bending + twist; }
  double total() const noexcept { return internal() + weight; }
};

/// What an evaluation depends on besides the cloth.
struct ClothLoad {
  double dt = 0.0;              ///< [s], of the step from x_n to x, for the viscosity; 0: no viscosity
  Vec3 gravity = Vec3::Zero();  ///< [m/s2]; enters the weight energy, not the internal forces
};

/// Incremental energy at trial positions, and the internal forces -d internal / dx there, of free, fixed and
/// dead slots (zero). The sum over fixed slots is the force of the cloth on what holds it. Nothing is
/// committed.
/// @param positions [m] (slots)  @param forces out [N] (slots), or empty. Thread class: real-time.
ClothEnergy evaluate_cloth(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                           std::span<const Vec3> positions, const ClothLoad& load,
                           std::span<Vec3> forces) noexcept;

/// Free energy of the state, with its memory clamped to its positions; dt plays no role.
/// Thread class: real-time.
ClothEnergy cloth_free_energy(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                              const Vec3& gravity) noexcept;

/// An element, named by the slot that cloth_model.h files it under.
enum class ClothElement {
  kWeftEdge,  ///< from the slot along the weft
  kWarpEdge,  ///< from the slot along the warp
  kCell,      ///< its shear and twist
  kTriples,   ///< bending of both directions
};

/// The part of the free energy that one element has [J]; zero where there is no such element. All of them sum
/// to ClothEnergy::internal() of cloth_free_energy(). Thread class: real-time.
double element_free_energy(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                           ClothElement element, std::size_t slot) noexcept;

/// sum m v^2 / 2 over the live slots [J]. Thread class: real-time.
double cloth_kinetic_energy(const ClothModel& model, const ClothState& state) noexcept;

/// Moves the friction memory of the state to the strains at these positions; nothing else of the state
/// changes. Thread class: real-time.
void commit_cloth(const ClothModel& model, const ClothMaterial& material, std::span<const Vec3> positions,
                  ClothState& state) noexcept;

/// Internal forces without viscosity at the state's own positions, committing its memory in the same pass.
/// @param forces out [N] (slots). Thread class: real-time.
void advance_cloth(const ClothModel& model, const ClothMaterial& material, ClothState& state,
                   std::span<Vec3> forces) noexcept;

}  // namespace fuai
