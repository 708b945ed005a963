// Assembles and solves the linear systems of SolverStatic.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/static_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fuai/solver/cloth_energy.h"
#include "fuai/solver/static_hessian.h"

namespace fuai {
namespace {

using Vector = Eigen::VectorXd;

/// No slot moves further than this in one iteration [spacings].
constexpr double kLargestMove = 0.5;
/// So many whole steps may be worse than the best before.
constexpr int kPatience = 4;
/// A step is halved so often at most while the force out of balance does not fall.
constexpr int kHalvings = 8;
/// What is added to the diagonal where the Hessian is not positive, as a part of its largest entry.
constexpr double kFirstShift = 1e-6, kShiftGrowth = 10.0;
/// What is always added: slack yarns have no stiffness at all along themselves, and nothing pulls on them.
constexpr double kLeastShift = 1e-12;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A row of a block and what it follows.
struct Row {
  Eigen::Index place;
  StaticFollows to;
};

}  // namespace

void StaticSystem::map_unknowns() {
  if (mapped) return;
  follows.assign(3 * state.positions.size(), {});
  unknowns = 0;
  for (std::size_t slot = 0; slot < state.positions.size(); ++slot) {
    if (model.live[slot] == 0 || model.fixed[slot] != 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (options.axes[axis]) follows[3 * slot + axis].push_back({unknowns++, 1.0});
    }
  }
  for (StaticClamp& clamp : clamps) {
    for (StaticClamp::Freedom& freedom : clamp.freedoms) {
      freedom.unknown = unknowns++;
      for (std::size_t slot : clamp.slots) {
        for (int axis = 0; axis < 3; ++axis) {
          if (freedom.direction[axis] != 0.0)
            follows[3 * slot + at(axis)].push_back({freedom.unknown, freedom.direction[axis]});
        }
      }
    }
  }
  mapped = true;
}

void StaticSystem::place_clamps() {
  for (const StaticClamp& clamp : clamps) {
    const Vec3 centre = clamp.pivot + clamp.whole_shift();
    for (std::size_t i = 0; i < clamp.slots.size(); ++i)
      state.positions[clamp.slots[i]] = centre + clamp.rotation * clamp.arms[i];
  }
}

void StaticSystem::evaluate() {
  scratch.positions = state.positions;
  scratch.weft_bending = state.weft_bending, scratch.warp_bending = state.warp_bending;
  scratch.shear = state.shear;
  scratch.weft_tension = state.weft_tension, scratch.warp_tension = state.warp_tension;
  advance_cloth(model, material, scratch, forces);
}

double StaticSystem::residual(Vector& r) {
  r.setZero(unknowns);
  double reactions = 0.0;
  for (std::size_t slot = 0; slot < state.positions.size(); ++slot) {
    if (model.live[slot] == 0) continue;
    if (model.fixed[slot] != 0) reactions += forces[slot].squaredNorm();
    const Vec3 f = forces[slot] + model.areal_mass * model.node_area[slot] * options.gravity;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const StaticFollows& to : follows[3 * slot + axis])
        r[to.unknown] += to.factor * f[static_cast<Eigen::Index>(axis)];
    }
  }
  for (const StaticClamp& clamp : clamps) {
    for (const StaticClamp::Freedom& freedom : clamp.freedoms) {
      r[freedom.unknown] += freedom.force;
      reactions += freedom.force * freedom.force;
    }
  }
  scale = std::sqrt(reactions);
  return r.norm();
}

void StaticSystem::assemble(bool safe, const std::vector<Vec3>& known, Vector& pull) {
  const HessianPoint point{model, material, state, state.positions, options.axes, safe};
  entries.clear();
  pull.setZero(unknowns);
  HessianBlock block;
  std::vector<Row> rows;
  const auto add = [&] {
    rows.clear();
    for (std::size_t a = 0; a < 3 * block.count; ++a) {
      for (const StaticFollows& to : follows[3 * block.slots[a / 3] + a % 3])
        rows.push_back({static_cast<Eigen::Index>(a), to});
    }
    for (const Row& i : rows) {
      for (const Row& j : rows) {
        if (j.to.unknown <= i.to.unknown) {
          const double value = i.to.factor * block.values(i.place, j.place) * j.to.factor;
          entries.emplace_back(i.to.unknown, j.to.unknown, value);
        }
      }
    }
    for (std::size_t b = 0; !known.empty() && b < 3 * block.count; ++b) {
      const double way = known[block.slots[b / 3]][static_cast<Eigen::Index>(b % 3)];
      if (way == 0.0) continue;
      for (const Row& i : rows)
        pull[i.to.unknown] -= i.to.factor * block.values(i.place, static_cast<Eigen::Index>(b)) * way;
    }
  };
  for (std::size_t slot = 0; slot < state.positions.size(); ++slot) {
    if (edge_block(point, slot, 0, block)) add();
    if (edge_block(point, slot, 1, block)) add();
    if (cell_block(point, slot, block)) add();
    if (bend_block(point, slot, block)) add();
  }
  matrix.resize(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
}

bool StaticSystem::factorise() {
  // A collapsed element leaves its entries out, so the pattern is compared each time.
  const auto* outer = matrix.outerIndexPtr();
  const auto* inner = matrix.innerIndexPtr();
  const std::vector<int> now_outer(outer, outer + matrix.outerSize() + 1),
      now_inner(inner, inner + matrix.nonZeros());
  if (now_outer != pattern_outer || now_inner != pattern_inner) {
    factor.analyzePattern(matrix);
    pattern_outer = now_outer, pattern_inner = now_inner;
  }
  factor.factorize(matrix);
  return factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 0.0;
}

StaticSystem::Step StaticSystem::solve(const Vector& rhs, Vector& step) {
  Vector unused;
  for (bool safe : {false, true}) {
    assemble(safe, {}, unused);
    const double largest = matrix.diagonal().cwiseAbs().maxCoeff();
    for (double shift = kLeastShift; shift < 1.0; shift = std::max(kFirstShift, shift * kShiftGrowth)) {
      matrix.diagonal().array() += shift * largest;
      if (factorise()) {
        step = factor.solve(rhs);
        if (step.allFinite()) return safe ? Step::kSafe : Step::kExact;
      }
      if (!safe) break;
    }
  }
  return Step::kNone;
}

double StaticSystem::potential() {
  double energy = evaluate_cloth(model, material, state, state.positions, {0.0, options.gravity}, {}).total();
  for (const StaticClamp& clamp : clamps) {
    for (const StaticClamp::Freedom& freedom : clamp.freedoms) energy -= freedom.force * freedom.way;
  }
  return energy;
}

/// Goes along a step, half as far each time until it is of use, and no less far than kHalvings allow: at the
/// corner of a law nothing helps but to go past it. Of an exact step the force out of balance must fall, of a
/// safe one the potential: beside a saddle, where the strip is about to buckle, the force rises on the way.
/// @param residual before, and after [N]
void StaticSystem::take(Step kind, const Vector& step, Vector& force, double& residual_now) {
  double share = largest_share(step), last = 0.0;
  const double energy = kind == Step::kSafe ? potential() : 0.0;
  Vector next;
  for (int halving = 0; halving <= kHalvings; ++halving, share *= 0.5) {
    move(step, share - last);
    last = share;
    evaluate();
    const double now = residual(next);
    const bool falls = kind == Step::kSafe ? potential() < energy : now < residual_now;
    if (std::isfinite(now) && (falls || halving == kHalvings)) {
      residual_now = now;
      force = next;
      return;
    }
  }
}

double StaticSystem::limit() const { return std::max(options.least_force, options.tolerance * scale); }

double StaticSystem::largest_share(const Vector& step) const {
  return std::min(1.0, kLargestMove * model.spacing / step.cwiseAbs().maxCoeff());
}

double StaticSystem::find_rest(int& iterations_done) {
  Vector force, step;
  evaluate();
  double now = residual(force);
  // The best shape so far. Cloth turns where a linear step shears it: a whole step overstretches the yarns
  // for once, and the next takes that back. So some steps in a row may be worse than the best before it is
  // gone back to.
  double best = now;
  std::vector<Vec3> best_positions = state.positions;
  std::vector<StaticClamp> best_clamps = clamps;
  int worse = 0;
  while (now > limit() && iterations_done < options.most_iterations) {
    ++iterations_done;
    if (worse > kPatience) {
      state.positions = best_positions;
      clamps = best_clamps;
      evaluate();
      now = residual(force);
    }
    const Step kind = solve(force, step);
    if (kind == Step::kNone) break;
    if (kind == Step::kSafe || worse > kPatience) {
      take(kind, step, force, now);
      worse = -1;
    } else {
      move(step, largest_share(step));
      evaluate();
      now = residual(force);
    }
    if (std::isfinite(now) && (now < best || worse < 0)) {
      best = now;
      best_positions = state.positions;
      best_clamps = clamps;
      worse = 0;
    } else {
      ++worse;
    }
  }
  return now;
}

void StaticSystem::move(const Vector& step, double share) {
  for (std::size_t slot = 0; slot < state.positions.size(); ++slot) {
    if (model.fixed[slot] != 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const StaticFollows& to : follows[3 * slot + axis])
        state.positions[slot][static_cast<Eigen::Index>(axis)] += share * to.factor * step[to.unknown];
    }
  }
  for (StaticClamp& clamp : clamps) {
    for (StaticClamp::Freedom& freedom : clamp.freedoms) freedom.way += share * step[freedom.unknown];
  }
  place_clamps();
}

void StaticSystem::predict(const std::vector<Vec3>& from) {
  std::vector<Vec3> known(state.positions.size(), Vec3::Zero());
  double moved = 0.0;
  for (const StaticClamp& clamp : clamps) {
    for (std::size_t slot : clamp.slots) {
      known[slot] = state.positions[slot] - from[slot];
      moved = std::max(moved, known[slot].norm());
    }
  }
  if (moved == 0.0) return;
  const std::vector<Vec3> placed = std::exchange(state.positions, from);
  Vector pull;
  assemble(true, known, pull);
  state.positions = placed;
  if (!factorise()) return;
  const Vector step = factor.solve(pull);
  if (step.allFinite() && step.cwiseAbs().maxCoeff() < 4.0 * moved + model.spacing) move(step, 1.0);
}

}  // namespace fuai
