// The force at a grasped particle: Eq. (7) as printed, and the force that the hand really feels.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", Eq. (7).
//
//   printed   F_tns = K1 sum (l_ik - L_k) P_iQ_k     F_bnd = sum t_l l0 N_l
//
// Both are moments, not forces: P_iQ_k is not normalised, and t l0 is a moment per width times a width. So
// they shrink with l0, and inside a uniformly bent sheet F_bnd is 2 t l0 where a hand feels nothing. Read in
// the paper's units, gf cm as gf, they become forces: here the products [N m] are divided by 1 cm.
#pragma once

#include "fuai/cloth/lattice.h"
#include "fuai/solver/relaxation.h"

namespace fuai {

/// The paper's unit of length [m], by which Eq. (7) must be divided to be a force.
inline constexpr double kPaperLength = 0.01;

/// Forces of the cloth on the hand [N].
struct GraspForce {
  Vec3 printed_stretch = Vec3::Zero();  ///< Eq. (7), K1 = k of the springs
  Vec3 printed_bending = Vec3::Zero();  ///< Eq. (7), N_l toward the flat sheet
  Vec3 reaction = Vec3::Zero();  ///< -dE/dx of springs, bending and weight, every triple with full gradient
};

/// Evaluates all three. The moment t is the law's with memory, or as printed the ascending branch (and the
/// derivative of |t K / 2| in the reaction). Looks at every edge and triple of the model.
/// @param solver a prepared solver: model, laws, k, mode, area weights
/// @param node the grasped particle, usually a fixed one. Thread class: real-time.
/// @source Wada et al., Eq. (7)
GraspForce evaluate_grasp(const SolverRelaxation& solver, const LatticeState& state, int node) noexcept;

}  // namespace fuai
