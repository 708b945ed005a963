// Chooses the step sizes of the relaxation and runs it.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", Eq. (6).
#include "fuai/solver/relaxation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "fuai/core/assertion.h"
#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/energy/stretch.h"

namespace fuai {
namespace {

/// gamma1 and gamma2 at a fraction of the joint bound: gamma2 (8 k + 32 B / l0^2) = 2 fraction.
RelaxationSteps choose_steps(const RelaxationOptions& options, double stiffness, double spacing) {
  if (!(options.spring_stiffness > 0.0) || !std::isfinite(options.spring_stiffness)) {
    throw Error(ErrorKind::kUsage, "the springs need a positive stiffness", {"", 0, 0, "spring_stiffness"});
  }
  if (!(options.step_fraction > 0.0 && options.step_fraction < 1.0)) {
    throw Error(ErrorKind::kUsage, "the step fraction must lie between 0 and 1", {"", 0, 0, "step_fraction"});
  }
  const double k = options.spring_stiffness;
  const double gamma2 = 2.0 * options.step_fraction / (8.0 * k + 32.0 * stiffness / (spacing * spacing));
  return {0.5 * k * gamma2, gamma2};
}

void refuse_unstable(const RelaxationSteps& steps, double stiffness, double spacing) {
  const double number = relaxation_stability_number(steps, stiffness, spacing);
  if (number < 2.0) return;
  std::ostringstream text;
  text << "the steps gamma1 = " << steps.gamma1 << ", gamma2 = " << steps.gamma2
       << " m/N are unstable: 16 gamma1 + 32 B gamma2 / l0^2 = " << number << ", must be below 2";
  std::ostringstream cure;
  cure << "multiply both by less than " << 2.0 / number;
  throw Error(ErrorKind::kUsage, text.str(), {"", 0, 0, "steps"}, cure.str());
}

}  // namespace

double bending_stiffness_bound(const PlayLaw& law, double spacing, PaperMode mode) {
  constexpr int kSamples = 256;
  double bound = mode == PaperMode::kCorrected ? law.max_stick_tangent() : 0.0;
  const double reach = 2.0 / spacing;
  for (int i = -kSamples; i <= kSamples; ++i) {
    const double K = reach * i / kSamples;
    if (mode == PaperMode::kCorrected) {
      bound = std::max(bound, law.stick_tangent(K));
    } else {
      bound = std::max(bound, std::abs(law.elastic().evaluate(K).slope + law.friction().evaluate(K).slope));
    }
  }
  return bound;
}

void SolverRelaxation::prepare(const LatticeModel& model, const FabricLaws& laws,
                               const RelaxationOptions& options) {
  const PlayLaw& warp = laws.bending[static_cast<std::size_t>(Direction::kWarp)];
  const PlayLaw& weft = laws.bending[static_cast<std::size_t>(Direction::kWeft)];
  const double stiffness = std::max(bending_stiffness_bound(warp, model.spacing, options.mode),
                                    bending_stiffness_bound(weft, model.spacing, options.mode));
  if (options.steps) {
    if (!(options.steps->gamma1 >= 0.0) || !(options.steps->gamma2 > 0.0)) {
      throw Error(ErrorKind::kUsage, "gamma1 must not be negative and gamma2 must be positive",
                  {"", 0, 0, "steps"});
    }
    if (!options.allow_unstable) refuse_unstable(*options.steps, stiffness, model.spacing);
    steps_ = *options.steps;
  } else {
    steps_ = choose_steps(options, stiffness, model.spacing);
  }
  model_ = &model;
  laws_ = &laws;
  options_ = options;
  area_weights_ = options.area_weights.value_or(
      options.mode == PaperMode::kAsPrinted ? AreaWeights::kNone : AreaWeights::kEverything);
  const double node_mass = model.areal_mass * model.spacing * model.spacing;
  node_weight_ = node_mass * kStandardGravity;
  RelaxationKernel::SetUp set_up;
  set_up.spring_stiffness = spring_stiffness();
  set_up.mobility = steps_.gamma2;
  set_up.weight = node_mass * options.gravity;
  set_up.weigh_nodes = area_weights_ != AreaWeights::kNone;
  set_up.weigh_stencils = area_weights_ == AreaWeights::kEverything;
  set_up.as_printed = options.mode == PaperMode::kAsPrinted;
  set_up.laws = {&warp, &weft};
  kernel_.prepare(model, set_up);
}

void SolverRelaxation::step(LatticeState& state) noexcept {
  FUAI_ASSERT(model_ != nullptr);
  kernel_.load(state);
  kernel_.compute_forces();
  kernel_.move();
  kernel_.store(state);
}

void SolverRelaxation::compute_forces(const LatticeState& state) noexcept {
  FUAI_ASSERT(model_ != nullptr);
  kernel_.load(state);
  kernel_.compute_forces();
}

double SolverRelaxation::residual() const noexcept {
  const double force = std::sqrt(kernel_.largest_force_squared());
  return node_weight_ > 0.0 ? force / node_weight_ : force;
}

RelaxationResult SolverRelaxation::run(LatticeState& state, const RelaxationStop& stop,
                                       const Progress& progress) {
  FUAI_ASSERT(model_ != nullptr);
  const std::int64_t check_every = std::max(stop.check_every, 1);
  kernel_.load(state);
  RelaxationResult outcome;
  bool sharp = false;
  for (;;) {
    kernel_.compute_forces();
    if (outcome.steps % check_every == 0 || outcome.steps >= stop.max_steps) {
      outcome.residual = residual();
      outcome.converged = outcome.residual < stop.tolerance;
      sharp = kernel_.sharp_fold();
      if (progress) {
        progress("relaxation", static_cast<double>(outcome.steps) / static_cast<double>(stop.max_steps));
      }
      if (outcome.converged || !std::isfinite(outcome.residual) || outcome.steps >= stop.max_steps) break;
    }
    kernel_.move();
    ++outcome.steps;
  }
  kernel_.store(state);
  RelaxationResult result = measure(state);
  result.steps = outcome.steps;
  result.residual = outcome.residual;
  result.converged = outcome.converged;
  if (!std::isfinite(outcome.residual)) result.status |= kRelaxationNotFinite;
  if (!outcome.converged && outcome.steps >= stop.max_steps) result.status |= kRelaxationStepLimit;
  if (sharp) result.status |= kRelaxationSharpFold;
  return result;
}

CurvatureStencil SolverRelaxation::stencil(const LatticeState& state,
                                           const LatticeTriple& triple) const noexcept {
  const auto at = [&](int node) -> const Vec3& { return state.positions[static_cast<std::size_t>(node)]; };
  const LatticeTangents t = lattice_tangents(*model_, state.positions, triple.middle);
  return {at(triple.end_low), at(triple.middle), at(triple.end_high), t.weft, t.warp, model_->spacing};
}

TripleReading SolverRelaxation::read_triple(const LatticeState& state, std::size_t triple) const noexcept {
  FUAI_ASSERT(model_ != nullptr && triple < model_->triples.size());
  const LatticeTriple& nodes = model_->triples[triple];
  const PlayLaw& law = laws_->bending[static_cast<std::size_t>(nodes.direction)];
  const CurvatureStencil s = stencil(state, nodes);
  if (options_.mode == PaperMode::kCorrected) {
    const NormalCurvature k = evaluate_normal_curvature(s);
    const double in_plane = 0.5 * in_plane_stiffness(law) * k.in_plane_square;
    return {k.curvature, law.evaluate(k.curvature, state.memory[triple]).stress,
            law.free_energy(k.curvature, state.memory[triple]) + in_plane, in_plane};
  }
  const double K =
      evaluate_curvature(s.p, s.m, s.r, s.rest_leg, s.weft_tangent.cross(s.warp_tangent), CurvatureForm::kC1)
          .curvature;
  const CurveValue t = ascending_branch(K, law.elastic().evaluate(K), law.friction().evaluate(K));
  return {K, t.value, bend_as_printed(K, t).energy, 0.0};
}

TripleGradient SolverRelaxation::triple_gradient(const LatticeState& state,
                                                 std::size_t triple) const noexcept {
  FUAI_ASSERT(model_ != nullptr && triple < model_->triples.size());
  const LatticeTriple& nodes = model_->triples[triple];
  const PlayLaw& law = laws_->bending[static_cast<std::size_t>(nodes.direction)];
  const CurvatureStencil s = stencil(state, nodes);
  const double l0 = model_->spacing;
  const double area = l0 * l0 * (area_weights_ == AreaWeights::kEverything ? nodes.tributary_factor : 1.0);
  TripleGradient gradient;
  const auto add_ends = [&](const Vec3& p, const Vec3& r) {
    gradient.add(nodes.end_low, area * p);
    gradient.add(nodes.end_high, area * r);
    gradient.add(nodes.middle, -area * (p + r));
  };
  if (options_.mode == PaperMode::kAsPrinted) {
    const TripleCurvature c =
        evaluate_curvature(s.p, s.m, s.r, l0, s.weft_tangent.cross(s.warp_tangent), CurvatureForm::kC1);
    const double K = c.curvature;
    const double moment =
        bend_as_printed(K, ascending_branch(K, law.elastic().evaluate(K), law.friction().evaluate(K))).moment;
    add_ends(moment * c.gradient_p, moment * c.gradient_r);
    return gradient;
  }
  const double moment = law.evaluate(evaluate_normal_curvature(s).curvature, state.memory[triple]).stress;
  const NormalCurvatureGradient g = evaluate_normal_gradient(s, moment, in_plane_stiffness(law));
  add_ends(g.p, g.r);
  // Through the normal: each edge at the middle node turns its tangent.
  const auto add_edge = [&](int first, int second, const Vec3& by_unit) {
    const Vec3 d =
        state.positions[static_cast<std::size_t>(second)] - state.positions[static_cast<std::size_t>(first)];
    const Vec3 u = d.normalized(), by_end = area / d.norm() * (by_unit - by_unit.dot(u) * u);
    gradient.add(second, by_end);
    gradient.add(first, -by_end);
  };
  const int m = nodes.middle, columns = model_->columns, column = m % columns, row = m / columns;
  if (column > 0) add_edge(m - 1, m, g.weft_tangent);
  if (column + 1 < columns) add_edge(m, m + 1, g.weft_tangent);
  if (row > 0) add_edge(m - columns, m, g.warp_tangent);
  if (row + 1 < model_->rows) add_edge(m, m + columns, g.warp_tangent);
  return gradient;
}

RelaxationResult SolverRelaxation::measure(const LatticeState& state) const noexcept {
  FUAI_ASSERT(model_ != nullptr);
  const bool weigh = area_weights_ == AreaWeights::kEverything;
  const auto at = [&](int node) -> const Vec3& { return state.positions[static_cast<std::size_t>(node)]; };
  RelaxationResult result;
  for (const LatticeEdge& edge : model_->edges) {
    const double k = spring_stiffness() * (weigh ? edge.tributary_factor : 1.0);
    result.stretch_energy += evaluate_stretch(at(edge.first), at(edge.second), edge.rest_length, k).energy;
    result.max_stretch =
        std::max(result.max_stretch, (at(edge.first) - at(edge.second)).norm() / edge.rest_length - 1.0);
  }
  const double area = model_->spacing * model_->spacing;
  for (std::size_t t = 0; t < model_->triples.size(); ++t) {
    const double factor = weigh ? model_->triples[t].tributary_factor : 1.0;
    result.bending_energy += area * factor * read_triple(state, t).energy;
  }
  StateHash hash;
  for (std::size_t n = 0; n < state.positions.size(); ++n) {
    const double factor = area_weights_ == AreaWeights::kNone ? 1.0 : model_->tributary_factors[n];
    result.weight_energy -= model_->areal_mass * area * factor *
                            options_.gravity.dot(state.positions[n] - model_->rest_positions[n]);
    hash.add(state.positions[n].data(), sizeof(double) * 3);
  }
  result.position_hash = hash.value();
  return result;
}

}  // namespace fuai
