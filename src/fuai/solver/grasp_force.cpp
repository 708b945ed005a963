// Evaluates the force at a grasped particle, stencil by stencil.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/grasp_force.h"

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
  for (std::size_t i = 0; i < model.triples.size(); ++i) {
    const LatticeTriple& triple = model.triples[i];
    if (triple.end_low != node && triple.middle != node && triple.end_high != node) continue;
    const TripleReading reading = solver.read_triple(state, i);
    const double area = l0 * l0 * (weigh ? triple.tributary_factor : 1.0);
    if (triple.middle == node) {
      force.reaction += area * reading.conjugate_moment * (reading.gradient_p + reading.gradient_r);
      continue;
    }
    const Vec3& gradient = triple.end_low == node ? reading.gradient_p : reading.gradient_r;
    force.reaction -= area * reading.conjugate_moment * gradient;
    force.printed_bending -= reading.moment * l0 / kPaperLength * gradient.normalized();
  }
  const double share = solver.area_weights() == AreaWeights::kNone
                           ? 1.0
                           : model.tributary_factors[static_cast<std::size_t>(node)];
  force.reaction += share * model.areal_mass * l0 * l0 * solver.options().gravity;
  return force;
}

}  // namespace fuai
