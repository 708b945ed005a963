// The modulated play law: a measured elastic curve plus friction with memory, for bending, shear and tension
// alike.
// SPDX-License-Identifier: Apache-2.0
//
//   x  strain measure (curvature [1/m], shear angle [rad], strain [-])
//   F  work-conjugate stress (moment per width [N], shear force per width [N/m], tension per width [N/m])
//   p_j <- clamp(p_j, x - r_j, x + r_j)       memory of element j, moved only by commit()
//   s_j = (x - p_j) / r_j in [-1, 1],  S = sum w_j s_j
//   F(x)  = F_e(x) + Y(x) S                   F_e elastic mean curve, Y >= 0 friction strength
//   dF/dx = F_e' + Y' S + Y sum_{|s_j|<1} w_j / r_j
//
// Derivation, free energy and the proof that dissipation is never negative: docs/theory/play-law.md.
// Model and state apart: a PlayLaw is constant once built, a PlayState belongs to one stencil of the cloth.
#pragma once

#include <array>
#include <span>

#include "fuai/fabric/curve_table.h"

namespace fuai {

/// Most play elements a law can have; states are arrays of this size.
inline constexpr int kMaxPlays = 5;

/// Friction memory of one strain component: the play positions p_j [unit of x]. Virgin cloth is all zero.
struct PlayState {
  std::array<double, kMaxPlays> position{};
};

/// One play element.
struct PlayElement {
  double radius = 1.0;  ///< r_j > 0 [unit of x]: half the strain over which it slips through
  double weight = 1.0;  ///< w_j >= 0; the weights sum to 1
};

/// Stress and consistent tangent.
struct Response {
  double stress = 0.0;
  double tangent = 0.0;
};

/// The law. Copyable, immutable; evaluation is real-time safe (no allocation, no branch on the past).
class PlayLaw {
 public:
  /// A law without friction and stiffness; use make_play_law().
  PlayLaw() = default;

  /// Stress and tangent at strain x with the memory clamped to x on the fly; the state does not change.
  /// The tangent is the one-sided derivative in the direction of slip at a kink. Thread class: real-time.
  Response evaluate(double x, const PlayState& state) const noexcept;

  /// Accepts strain x: moves the memory. Thread class: real-time.
  void commit(double x, PlayState& state) const noexcept;

  /// evaluate() and commit() in one pass. Thread class: real-time.
  Response advance(double x, PlayState& state) const noexcept;

  /// Free energy psi(x, p) per area, of the memory after clamping to x, zero at the virgin flat state.
  /// [unit of x times unit of F]. Thread class: real-time.
  double free_energy(double x, const PlayState& state) const noexcept;

  /// Incremental potential W_n(x): dW_n/dx = evaluate().stress for a monotone path from the committed state;
  /// W_n(x1) - W_n(x0) = free energy difference + dissipation. Thread class: real-time.
  double incremental_potential(double x, const PlayState& state) const noexcept;

  /// Energy lost in going monotonically from x0 (the strain of the last commit) to x1; never negative.
  double dissipation(double x0, double x1, const PlayState& state) const noexcept;

  /// Largest tangent that any state can show at strain x (all elements sticking): bounds explicit steps.
  double stick_tangent(double x) const noexcept;
  /// Largest stick_tangent over the measured range.
  double max_stick_tangent() const noexcept { return max_stick_tangent_; }

  std::span<const PlayElement> elements() const noexcept {
    return {elements_.data(), static_cast<std::size_t>(count_)};
  }
  const CurveTable& elastic() const noexcept { return elastic_; }    ///< F_e with its extrapolation
  const CurveTable& friction() const noexcept { return friction_; }  ///< Y with its extrapolation

 private:
  friend PlayLaw make_play_law(CurveTable elastic, CurveTable friction,
                               std::span<const PlayElement> elements);

  CurveTable elastic_;
  CurveTable friction_;
  std::array<PlayElement, kMaxPlays> elements_{};
  std::array<double, kMaxPlays> inverse_radius_{};
  int count_ = 0;
  double max_stick_tangent_ = 0.0;
};

/// Builds a law from its parts. @throws Error (kBadInput) when a radius is not positive, weights are negative
/// or do not sum to 1 within 1e-9, there are more than kMaxPlays elements, or the friction table is negative.
/// Thread class: set-up.
/// @source docs/theory/play-law.md, Eq. H1
PlayLaw make_play_law(CurveTable elastic, CurveTable friction, std::span<const PlayElement> elements);

/// The law with its elastic curve and its friction times factors; plays and their radii stay. With factors of
/// 1 every bit is the same. @param elastic, friction finite; friction >= 0. Thread class: set-up.
PlayLaw scaled(const PlayLaw& law, double elastic, double friction);

}  // namespace fuai
