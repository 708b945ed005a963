// Chooses the step sizes of the relaxation and runs it.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", Eq. (6).
#include "fuai/solver/relaxation.h"

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
  node_weight_ = node_mass * kRelaxationGravity;
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

TripleReading SolverRelaxation::read_triple(const LatticeState& state, std::size_t triple) const noexcept {
  FUAI_ASSERT(model_ != nullptr && triple < model_->triples.size());
  const LatticeTriple& nodes = model_->triples[triple];
  const PlayLaw& law = laws_->bending[static_cast<std::size_t>(nodes.direction)];
  const auto at = [&](int node) -> const Vec3& { return state.positions[static_cast<std::size_t>(node)]; };
  const TripleCurvature c =
      evaluate_curvature(at(nodes.end_low), at(nodes.middle), at(nodes.end_high), model_->spacing,
                         lattice_normal(*model_, state.positions, nodes.middle), CurvatureForm::kC1);
  const double K = c.curvature;
  TripleReading reading{K, 0.0, 0.0, 0.0, c.gradient_p, c.gradient_r};
  if (options_.mode == PaperMode::kCorrected) {
    reading.moment = reading.conjugate_moment = law.evaluate(K, state.memory[triple]).stress;
    reading.energy = law.free_energy(K, state.memory[triple]);
  } else {
    const CurveValue t = ascending_branch(K, law.elastic().evaluate(K), law.friction().evaluate(K));
    const BendValue value = bend_as_printed(K, t);
    reading.moment = t.value;
    reading.conjugate_moment = value.moment;
    reading.energy = value.energy;
  }
  return reading;
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
