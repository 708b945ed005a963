// Newton's method for the half strip: tridiagonal Hessian bordered by the end-distance constraint.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/buckling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/units/constants.h"

namespace fuai {

namespace {

constexpr int kMaxIterations = 60;
constexpr double kTolerance = 1e-10;        // of the largest moment (or weight term) and of the half length
constexpr double kAccepted = 1e-4;          // a step that stalls at a kink of the friction may stay here
constexpr int kMaxHalvings = 10;            // of one step of the path
constexpr int kVirginSteps = 12;            // from flat to the first clamp distance
constexpr double kVirginShortening = 2e-4;  // first point of the path [free lengths]

/// The half strip: unknowns, memory and work space. Symbols as in buckling.h.
class HalfStrip {
 public:
  HalfStrip(const BucklingStrip& strip, const PlayLaw& law)
      : law_(law),
        n_(static_cast<std::size_t>(strip.half_segments)),
        h_(0.5 * strip.free_length / static_cast<double>(n_)),
        half_length_(0.5 * strip.free_length),
        weight_(strip.areal_mass * kStandardGravity * (strip.upwards ? -1.0 : 1.0)),
        memory_(n_ + 1) {
    for (auto* v : {&theta_, &residual_, &diagonal_, &coupling_, &border_, &free_, &pull_, &pivot_, &base_}) {
      v->assign(n_, 0.0);
    }
  }

  /// Starts from the first buckling mode, sin(2 pi s / L), of a given shortening [free lengths].
  void guess(double shortening) {
    for (std::size_t i = 0; i < n_; ++i) {
      const double s = (static_cast<double>(i) + 0.5) / static_cast<double>(n_);
      theta_[i] = 2.0 * std::sqrt(shortening) * std::sin(std::numbers::pi * s);
    }
    // Rayleigh quotient of that mode: with H = 0 the residual is the gradient of Pi.
    force_ = 0.0;
    assemble(half_length_ * (1.0 - shortening));
    double bending = 0.0, axial = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      bending += residual_[i] * theta_[i], axial += border_[i] * theta_[i];
    }
    force_ = bending / axial;
  }

  /// Newton's method to half distance x.
  /// @return largest residual, in largest moments and half lengths
  double solve(double x) {
    double merit = assemble(x);
    for (int iteration = 0; iteration < kMaxIterations && worst_ > kTolerance; ++iteration) {
      const double force_step = newton_step();
      base_ = theta_;
      const double base_force = force_, base_merit = merit;
      // Backtracking; at a kink, where no step helps, the shortest one moves on to the other side.
      double t = 1.0;
      for (int k = 0; k < 7; ++k, t *= 0.5) {
        for (std::size_t i = 0; i < n_; ++i) theta_[i] = base_[i] + t * free_[i];
        force_ = base_force + t * force_step;
        merit = assemble(x);
        if (merit < (1.0 - 1e-4 * t) * base_merit) break;
      }
    }
    return worst_;
  }

  void commit() {
    for (std::size_t k = 0; k <= n_; ++k) law_.commit(curvature(k), memory_[k]);
  }
  double deflection() const {
    double y = 0.0;
    for (double t : theta_) y += h_ * std::sin(t);
    return y;
  }
  double curvature(std::size_t k) const {
    const double before = k == 0 ? clamp_angle_ : theta_[k - 1], after = k == n_ ? 0.0 : theta_[k];
    return (after - before) / hinge_length(k);
  }
  double force() const { return force_; }
  void turn_clamps(double angle) { clamp_angle_ = angle; }
  /// Unknowns, to go back to when a step fails.
  std::pair<std::vector<double>, double> unknowns() const { return {theta_, force_}; }
  void restore(const std::pair<std::vector<double>, double>& unknowns) {
    theta_ = unknowns.first, force_ = unknowns.second;
  }

 private:
  double hinge_length(std::size_t k) const { return k == 0 || k == n_ ? 0.5 * h_ : h_; }

  /// Residual, Hessian and constraint at (theta_, force_). @return merit: sum of squares of what must vanish
  double assemble(double x) {
    std::fill(residual_.begin(), residual_.end(), 0.0);
    std::fill(diagonal_.begin(), diagonal_.end(), 0.0);
    // Hinges: moment M and tangent T; hinge k turns theta_{k-1} back and theta_k on.
    double largest_moment = 0.0;
    for (std::size_t k = 0; k <= n_; ++k) {
      const Response r = law_.evaluate(curvature(k), memory_[k]);
      const double stiffness = r.tangent / hinge_length(k);
      largest_moment = std::max(largest_moment, std::abs(r.stress));
      if (k > 0) residual_[k - 1] -= r.stress, diagonal_[k - 1] += stiffness;
      if (k < n_) residual_[k] += r.stress, diagonal_[k] += stiffness;
      if (k > 0 && k < n_) coupling_[k - 1] = -stiffness;
    }
    // Weight of all that hangs beyond segment i (up to the middle), and the end force.
    double reach = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double c = std::cos(theta_[i]), s = std::sin(theta_[i]);
      const double load = weight_ * h_ * h_ * (static_cast<double>(n_ - i) - 0.5);
      residual_[i] += force_ * h_ * s - load * c;
      diagonal_[i] += force_ * h_ * c + load * s;
      border_[i] = -h_ * s;
      reach += h_ * c;
    }
    gap_ = x - reach;
    // Where weight rules, the rounding of its own terms is the limit.
    const double whole_weight = std::abs(weight_) * h_ * h_ * static_cast<double>(n_);
    largest_moment = std::max(largest_moment, whole_weight);
    if (largest_moment > 0.0) moment_scale_ = largest_moment;
    worst_ = std::abs(gap_) / half_length_;
    double merit = worst_ * worst_;
    for (double r : residual_) {
      worst_ = std::max(worst_, std::abs(r) / moment_scale_);
      merit += r * r / (moment_scale_ * moment_scale_);
    }
    return merit;
  }

  /// Factorises the tridiagonal Hessian plus a shift. @return number of pivots that are not positive
  int factorise(double shift) {
    int bad = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      pivot_[i] = diagonal_[i] + shift;
      if (i > 0) pivot_[i] -= coupling_[i - 1] * coupling_[i - 1] / pivot_[i - 1];
      bad += pivot_[i] > 0.0 ? 0 : 1;
    }
    return bad;
  }
  void back_solve(std::vector<double>& v) const {
    for (std::size_t i = 1; i < n_; ++i) v[i] -= coupling_[i - 1] / pivot_[i - 1] * v[i - 1];
    v[n_ - 1] /= pivot_[n_ - 1];
    for (std::size_t i = n_ - 1; i-- > 0;) v[i] = (v[i] - coupling_[i] * v[i + 1]) / pivot_[i];
  }

  /// Step of theta into free_; @return step of the force. The bordered system belongs to a minimum when the
  /// Hessian is positive, or has one negative pivot that the constraint removes; otherwise it is shifted.
  double newton_step() {
    const double scale = *std::max_element(diagonal_.begin(), diagonal_.end());
    for (double shift = 0.0;; shift = shift == 0.0 ? 1e-3 * scale : 4.0 * shift) {
      const int negative = factorise(shift);
      if (negative > 1) continue;
      pull_ = border_;
      back_solve(pull_);
      double across = 0.0;
      for (std::size_t i = 0; i < n_; ++i) across += border_[i] * pull_[i];
      if (negative == 0 ? across > 0.0 : across < 0.0) return combine(across);
    }
  }
  double combine(double across) {
    for (std::size_t i = 0; i < n_; ++i) free_[i] = -residual_[i];
    back_solve(free_);
    double gap = gap_;
    for (std::size_t i = 0; i < n_; ++i) gap -= border_[i] * free_[i];
    const double force_step = gap / across;
    for (std::size_t i = 0; i < n_; ++i) free_[i] += force_step * pull_[i];
    return force_step;
  }

  const PlayLaw& law_;
  std::size_t n_;
  double h_, half_length_, weight_;
  double clamp_angle_ = 0.0;
  double force_ = 0.0, gap_ = 0.0, worst_ = 0.0, moment_scale_ = 1.0;
  std::vector<double> theta_, residual_, diagonal_, coupling_, border_, free_, pull_, pivot_, base_;
  std::vector<PlayState> memory_;
};

void check_strip(const BucklingStrip& strip, std::span<const double> distances) {
  if (!(strip.free_length > 0.0) || !(strip.areal_mass >= 0.0) || strip.half_segments < 2 ||
      !(strip.largest_step > 0.0)) {
    throw Error(ErrorKind::kBadInput,
                "a buckling strip needs a positive length and step, a mass and at least two half segments");
  }
  for (double d : distances) {
    if (!(d > 0.0) || !(d < strip.free_length)) {
      throw Error(ErrorKind::kBadInput,
                  "the clamp distance " + std::to_string(d) + " m is not between 0 and the free length " +
                      std::to_string(strip.free_length) + " m",
                  {}, "drop the samples where the strip is taut");
    }
  }
}

/// Goes from half distance `from` to `to` in at most `largest` long steps, each halved when it fails.
double follow(HalfStrip& half, double from, double to, double largest) {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / largest)));
  double worst = 0.0, at = from;
  double step = (to - from) / steps;
  int halvings = 0;
  while (at != to) {
    const bool last = std::abs(to - at) <= std::abs(step) * (1.0 + 1e-9);
    const double next = last ? to : at + step;
    const auto before = half.unknowns();
    const double residual = half.solve(next);
    if (residual <= kAccepted) {
      half.commit();
      worst = std::max(worst, residual);
      at = next;
    } else if (++halvings > kMaxHalvings) {
      throw Error(ErrorKind::kCheckFailed, "a buckling step stopped at a residual of " +
                                               std::to_string(residual) + " of the largest moment");
    } else {
      half.restore(before);
      step *= 0.5;
    }
  }
  return worst;
}

}  // namespace

BucklingPath simulate_buckling(const BucklingStrip& strip, const PlayLaw& law,
                               std::span<const double> distances) {
  check_strip(strip, distances);
  BucklingPath path;
  if (distances.empty()) return path;
  HalfStrip half(strip, law);
  const double half_length = 0.5 * strip.free_length;
  const double largest = strip.largest_step * half_length;

  // From flat to the first distance: equal steps of the amplitude, which goes with the root of the
  // shortening.
  const double first = 1.0 - distances[0] / strip.free_length;
  const double start = std::min(kVirginShortening, first);
  half.guess(start);
  double at = half_length;
  for (int k = 0; k <= kVirginSteps; ++k) {
    const double root = std::sqrt(start) + (std::sqrt(first) - std::sqrt(start)) * k / kVirginSteps;
    const double next = k == kVirginSteps ? 0.5 * distances[0] : half_length * (1.0 - root * root);
    path.worst_residual = std::max(path.worst_residual, follow(half, at, next, half_length));
    at = next;
  }
  // Then the clamps turn.
  for (int k = 1; k <= kVirginSteps && strip.clamp_angle != 0.0; ++k) {
    half.turn_clamps(strip.clamp_angle * k / kVirginSteps);
    half.solve(at);
    half.commit();
  }
  for (double d : distances) {
    path.worst_residual = std::max(path.worst_residual, follow(half, at, 0.5 * d, largest));
    at = 0.5 * d;
    path.force.push_back(half.force());
    path.deflection.push_back(half.deflection());
    path.end_curvature.push_back(half.curvature(0));
  }
  return path;
}

}  // namespace fuai
