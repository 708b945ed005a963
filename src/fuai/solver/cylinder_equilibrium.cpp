// Newton's method on the profile of a strip.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/cylinder_equilibrium.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/solver/cloth_energy.h"

namespace fuai {
namespace {

/// A station pulls on the two before and the two behind it: with two numbers each, six diagonals.
constexpr int kReach = 2, kColours = 2 * kReach + 1, kBand = 2 * kReach + 2;
/// Central differences over this part of a spacing either way: rounding of the positions then makes some 1e-9
/// of the stiffest, stretching, which must not hide the softest, bending, 1e7 times softer.
constexpr double kDifference = 1e-6;
constexpr double kGrowth = 4.0, kShrink = 0.25, kLongestDt = 1e4, kShortestDt = 1e-7;
constexpr int kHalvings = 5;
/// Rounding of an energy, as a part of the weight times the length of the strip.
constexpr double kEnergyRounding = 1e-13;

/// Symmetric band matrix, the lower half: rows of A(i, i), A(i, i-1) ... A(i, i-kBand+1).
using Band = std::vector<std::array<double, kBand>>;

/// Solves A x = b in place; false when A is not positive definite.
bool solve_band(Band& a, std::vector<double>& b) {
  const int n = static_cast<int>(b.size());
  const auto at = [&](int i, int j) -> double& {
    return a[static_cast<std::size_t>(i)][static_cast<std::size_t>(i - j)];
  };
  const auto entry = [&](int i) -> double& { return b[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < n; ++i) {
    for (int j = std::max(0, i - kBand + 1); j <= i; ++j) {
      double sum = at(i, j);
      for (int k = std::max(0, i - kBand + 1); k < j; ++k) sum -= at(i, k) * at(j, k);
      if (j == i && !(sum > 0.0)) return false;
      at(i, j) = j == i ? std::sqrt(sum) : sum / at(j, j);
    }
    for (int k = std::max(0, i - kBand + 1); k < i; ++k) entry(i) -= at(i, k) * entry(k);
    entry(i) /= at(i, i);
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < std::min(n, i + kBand); ++k) entry(i) -= at(k, i) * entry(k);
    entry(i) /= at(i, i);
  }
  return true;
}

class Strip {
 public:
  Strip(const ClothModel& model, const ClothMaterial& material, Direction along, const Vec3& gravity,
        ClothState& state)
      : model_(model), material_(material), state_(state), along_(along), gravity_(gravity) {
    const bool weft = along == Direction::kWeft;
    const int stations = weft ? model.columns : model.rows, across = weft ? model.rows : model.columns;
    for (int s = 0; s < stations; ++s) {
      std::vector<std::size_t> slots;
      for (int r = 0; r < across; ++r) {
        const auto slot = static_cast<std::size_t>(weft ? model.slot(s, r) : model.slot(r, s));
        if (model.live[slot] != 0 && model.fixed[slot] == 0) slots.push_back(slot);
      }
      if (!slots.empty()) {
        stations_.push_back(std::move(slots));
      } else if (stations_.empty()) {
        const Vec3& held =
            state.positions[static_cast<std::size_t>(weft ? model.slot(s, 0) : model.slot(0, s))];
        root_ = Vec2(held[axis()], held.z());
      }
    }
    for (const auto& station : stations_) {
      mass_.push_back(0.0);
      for (std::size_t slot : station) mass_.back() += model.areal_mass * model.node_area[slot];
      weight_ += mass_.back() * gravity.norm();
    }
    forces_.resize(state.positions.size());
  }

  double weight() const { return weight_; }
  int evaluations() const { return evaluations_; }
  std::size_t size() const { return 2 * stations_.size(); }
  double mass(std::size_t unknown) const { return mass_[unknown / 2]; }

  /// Energy [J]; force per unknown and residual over all slots [N].
  double evaluate(double share, std::vector<double>& force, double& residual) {
    ++evaluations_;
    const Vec3 g = share * gravity_;
    const ClothEnergy energy = evaluate_cloth(model_, material_, state_, state_.positions, {0.0, g}, forces_);
    force.assign(size(), 0.0);
    double square = 0.0;
    for (std::size_t s = 0; s < stations_.size(); ++s) {
      for (std::size_t slot : stations_[s]) {
        const Vec3 f = forces_[slot] + model_.areal_mass * model_.node_area[slot] * g;
        square += f.squaredNorm();
        force[2 * s] += f[axis()];
        force[2 * s + 1] += f.z();
      }
    }
    residual = std::sqrt(square);
    return energy.total();
  }

  void shift(std::size_t unknown, double by) {
    for (std::size_t slot : stations_[unknown / 2])
      state_.positions[slot][unknown % 2 == 0 ? axis() : 2] += by;
  }
  /// Moves the profile, each segment turned and stretched instead of sheared: a yarn is so much stiffer in
  /// tension than in bending that straight moves would have to be a hundred times smaller.
  void move(const std::vector<double>& by, double factor) {
    Vec2 before = root_, after = root_, last = Vec2::Zero();
    for (std::size_t s = 0; s < stations_.size(); ++s) {
      const Vec3& x = state_.positions[stations_[s].front()];
      const Vec2 here(x[axis()], x.z()), shift = factor * Vec2(by[2 * s], by[2 * s + 1]);
      const Vec2 segment = here - before, change = shift - last;
      const double length = segment.norm();
      const Vec2 along = segment / length, across(-along.y(), along.x());
      const double turn = change.dot(across) / length;
      after += (length + change.dot(along)) * (std::cos(turn) * along + std::sin(turn) * across);
      for (std::size_t slot : stations_[s]) {
        state_.positions[slot][axis()] = after.x();
        state_.positions[slot].z() = after.y();
      }
      before = here, last = shift;
    }
  }

  /// -d force / d unknown by differences of the force, symmetrised.
  Band stiffness(double share) {
    const double step = kDifference * model_.spacing;
    const std::size_t n = size();
    Band band(n, std::array<double, kBand>{});
    std::vector<double> ahead, behind;
    double residual = 0.0;
    for (std::size_t colour = 0; colour < kColours; ++colour) {
      for (std::size_t part = 0; part < 2; ++part) {
        const auto shift_all = [&](double by) {
          for (std::size_t s = colour; s < stations_.size(); s += kColours) shift(2 * s + part, by);
        };
        const std::vector<Vec3> kept = state_.positions;
        shift_all(step);
        evaluate(share, ahead, residual);
        state_.positions = kept;
        shift_all(-step);
        evaluate(share, behind, residual);
        state_.positions = kept;
        for (std::size_t s = colour; s < stations_.size(); s += kColours) {
          const std::size_t j = 2 * s + part;
          const std::size_t first = 2 * (s < kReach ? 0 : s - kReach),
                            last = std::min(n, 2 * (s + kReach + 1));
          for (std::size_t i = first; i < last; ++i) {
            const double value = -(ahead[i] - behind[i]) / (2.0 * step);
            const double half = i == j ? value : 0.5 * value;
            band[std::max(i, j)][std::max(i, j) - std::min(i, j)] += half;
          }
        }
      }
    }
    return band;
  }

 private:
  int axis() const { return along_ == Direction::kWeft ? 0 : 1; }

  const ClothModel& model_;
  const ClothMaterial& material_;
  ClothState& state_;
  Direction along_;
  Vec3 gravity_;
  std::vector<std::vector<std::size_t>> stations_;
  std::vector<double> mass_;
  Vec2 root_ = Vec2::Zero();  // the last held station: along, up
  std::vector<Vec3> forces_;
  double weight_ = 0.0;
  int evaluations_ = 0;
};

/// Newton's method at one load until the residual is below the limit. @return the residual [N]
double settle(Strip& strip, double share, double limit, double largest_move,
              const EquilibriumOptions& options, ClothState& state, EquilibriumReport& report) {
  std::vector<double> force, next_force;
  double residual = 0.0, next = 0.0, dt = options.first_dt;
  double energy = strip.evaluate(share, force, residual);
  while (residual > limit && report.steps < options.most_steps && dt > kShortestDt) {
    const Band stiffness = strip.stiffness(share);
    const std::vector<Vec3> kept = state.positions;
    for (bool taken = false; !taken && dt > kShortestDt;) {
      ++report.steps;
      Band damped = stiffness;
      for (std::size_t i = 0; i < damped.size(); ++i) damped[i][0] += strip.mass(i) / (dt * dt);
      std::vector<double> move = force;
      const bool definite = solve_band(damped, move);
      double longest = 0.0;
      for (double m : move) longest = std::max(longest, std::abs(m));
      // Along the move the energy must fall, half as far each time: laws have corners, and a Newton step
      // that looks only at the force runs to and fro across them.
      double part = std::min(1.0, largest_move / longest);
      for (int halving = 0; definite && !taken && halving < kHalvings; ++halving, part *= 0.5) {
        strip.move(move, part);
        const double lower = strip.evaluate(share, next_force, next);
        const double rounding =
            kEnergyRounding * strip.weight() * static_cast<double>(strip.size()) * largest_move;
        taken = std::isfinite(next) &&
                (lower < energy - rounding || (lower < energy + rounding && next < residual));
        if (taken) {
          energy = lower, residual = next, force = next_force;
        } else {
          state.positions = kept;
        }
      }
      dt = taken ? std::min(dt * kGrowth, kLongestDt) : dt * kShrink;
    }
  }
  return residual;
}

}  // namespace

EquilibriumReport find_cylinder_equilibrium(const ClothModel& model, const ClothMaterial& material,
                                            Direction along, ClothState& state,
                                            const EquilibriumOptions& options, const Progress& progress) {
  if (along == Direction::kBias || !(options.tolerance > 0.0) || options.most_steps < 1 ||
      options.load_steps < 1 || !(options.first_dt > 0.0) || !(options.largest_move > 0.0)) {
    throw Error(ErrorKind::kUsage,
                "a strip needs warp or weft along it, a positive tolerance, step and largest move, and at "
                "least one step");
  }
  Strip strip(model, material, along, options.gravity, state);
  EquilibriumReport report;
  report.converged = true;
  for (int load = 1; load <= options.load_steps; ++load) {
    const double share = static_cast<double>(load) / options.load_steps;
    const double limit = std::max(options.tolerance * strip.weight(), options.least_force);
    const double residual =
        settle(strip, share, limit, options.largest_move * model.spacing, options, state, report);
    report.residual = strip.weight() > 0.0 ? residual / strip.weight() : residual;
    report.converged = report.converged && residual <= limit;
    commit_cloth(model, material, state.positions, state);
    if (progress) progress("cantilever", share);
  }
  report.iterations = strip.evaluations();
  for (auto* field : {&state.velocities, &state.accelerations})
    for (Vec3& number : *field) number.setZero();
  state.carried.clear();
  return report;
}

}  // namespace fuai
