// Evaluates the force at a grasped particle, stencil by stencil.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/grasp_force.h"

#include <Eigen/Geometry>

#include "fuai/energy/curvature.h"
#include "fuai/energy/stretch.h"

namespace fuai {
GraspForce evaluate_grasp(const SolverRelaxation& solver, const LatticeState& state, int node) noexcept {
  const LatticeModel& model = solver.model();
  const bool weigh = solver.area_weights() == AreaWeights::kEverything;
  const double k = solver.spring_stiffness(), l0 = model.spacing;
  const auto at = [&](int n) -> const Vec3& { return state.positions[static_cast<std::size_t>(n)]; };
  GraspForce force;
  for (const LatticeEdge& edge : model.edges) {
    if (edge.first != node && edge.second != node) continue;
    const Vec3 to_other = at(edge.first == node ? edge.second : edge.first) - at(node);
    force.printed_stretch += k * (to_other.norm() - edge.rest_length) * to_other / kPaperLength;
    const double factor = weigh ? edge.tributary_factor : 1.0;
    force.reaction -=
        evaluate_stretch(at(node), at(node) + to_other, edge.rest_length, factor * k).gradient_first;
  }
  for (std::size_t t = 0; t < model.triples.size(); ++t) {
    const TripleGradient gradient = solver.triple_gradient(state, t);
    for (std::size_t i = 0; i < gradient.count; ++i) {
      if (gradient.nodes[i] == node) force.reaction -= gradient.values[i];
    }
    const LatticeTriple& triple = model.triples[t];
    if (triple.end_low != node && triple.end_high != node) continue;
    // N: across the leg at this end, toward the flat sheet.
    const LatticeTangents tangents = lattice_tangents(model, state.positions, triple.middle);
    const TripleCurvature K = evaluate_curvature(at(triple.end_low), at(triple.middle), at(triple.end_high),
                                                 l0, tangents.weft.cross(tangents.warp), CurvatureForm::kC1);
    const Vec3 N = -(triple.end_low == node ? K.gradient_p : K.gradient_r).normalized();
    force.printed_bending += solver.read_triple(state, t).moment * l0 / kPaperLength * N;
  }
  const double share = solver.area_weights() == AreaWeights::kNone
                           ? 1.0
                           : model.tributary_factors[static_cast<std::size_t>(node)];
  force.reaction += share * model.areal_mass * l0 * l0 * solver.options().gravity;
  return force;
}

}  // namespace fuai
