// Evaluates the modulated play law. The symbols are those of play_law.h.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/play_law.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "fuai/core/error.h"

namespace fuai {

PlayLaw make_play_law(CurveTable elastic, CurveTable friction, std::span<const PlayElement> elements) {
  if (elements.empty() || elements.size() > static_cast<std::size_t>(kMaxPlays)) {
    throw Error(ErrorKind::kBadInput, "a play law has 1 to " + std::to_string(kMaxPlays) + " elements, got " +
                                          std::to_string(elements.size()));
  }
  double sum = 0.0;
  for (const PlayElement& e : elements) {
    if (!(e.radius > 0.0) || !(e.weight >= 0.0)) {
      throw Error(ErrorKind::kBadInput,
                  "a play element needs a positive radius and a weight that is not negative");
    }
    sum += e.weight;
  }
  if (!(std::abs(sum - 1.0) <= 1e-9)) {
    throw Error(ErrorKind::kBadInput, "the weights of a play law must sum to 1, got " + std::to_string(sum));
  }
  for (double y : friction.nodes()) {
    if (y < 0.0) throw Error(ErrorKind::kBadInput, "friction strength is negative");
  }
  PlayLaw law;
  law.elastic_ = std::move(elastic);
  law.friction_ = std::move(friction);
  law.count_ = static_cast<int>(elements.size());
  for (std::size_t j = 0; j < elements.size(); ++j) {
    law.elements_[j] = elements[j];
    law.inverse_radius_[j] = 1.0 / elements[j].radius;
  }
  for (std::size_t i = 0; i < law.elastic_.node_count(); ++i) {
    law.max_stick_tangent_ =
        std::max(law.max_stick_tangent_, law.stick_tangent(law.elastic_.node_position(i)));
  }
  return law;
}

PlayLaw scaled(const PlayLaw& law, double elastic, double friction) {
  if (law.elements().empty()) return law;  // without stiffness and friction
  return make_play_law(scaled(law.elastic(), elastic), scaled(law.friction(), friction), law.elements());
}

Response PlayLaw::evaluate(double x, const PlayState& state) const noexcept {
  double S = 0.0, stick = 0.0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(count_); ++j) {
    const double s = (x - state.position[j]) * inverse_radius_[j];
    const double clamped = std::clamp(s, -1.0, 1.0);
    S += elements_[j].weight * clamped;
    stick += s == clamped ? elements_[j].weight * inverse_radius_[j] : 0.0;
  }
  const CurveValue e = elastic_.evaluate(x);
  const CurveValue y = friction_.evaluate(x);
  return {e.value + y.value * S, e.slope + y.slope * S + y.value * stick};
}

void PlayLaw::commit(double x, PlayState& state) const noexcept {
  for (std::size_t j = 0; j < static_cast<std::size_t>(count_); ++j) {
    state.position[j] = std::clamp(state.position[j], x - elements_[j].radius, x + elements_[j].radius);
  }
}

Response PlayLaw::advance(double x, PlayState& state) const noexcept {
  const Response response = evaluate(x, state);
  commit(x, state);
  return response;
}

double PlayLaw::free_energy(double x, const PlayState& state) const noexcept {
  // psi = int F_e + sum (w_j / r_j) int_{p_j}^{x} Y(k) (k - p_j) dk
  double energy = elastic_.integral(x);
  const double J0x = friction_.integral(x), J1x = friction_.first_moment(x);
  for (std::size_t j = 0; j < static_cast<std::size_t>(count_); ++j) {
    const double r = elements_[j].radius;
    const double p = std::clamp(state.position[j], x - r, x + r);
    const double lever = J1x - friction_.first_moment(p) - p * (J0x - friction_.integral(p));
    energy += elements_[j].weight * inverse_radius_[j] * lever;
  }
  return energy;
}

double PlayLaw::incremental_potential(double x, const PlayState& state) const noexcept {
  // Eq. H4: stick from p_j to kh_j, then slip at full strength from kh_j to x.
  double energy = elastic_.integral(x);
  const double J0x = friction_.integral(x);
  for (std::size_t j = 0; j < static_cast<std::size_t>(count_); ++j) {
    const double r = elements_[j].radius, p = state.position[j];
    const double kh = std::clamp(x, p - r, p + r);
    const double J0kh = friction_.integral(kh);
    const double stick =
        friction_.first_moment(kh) - friction_.first_moment(p) - p * (J0kh - friction_.integral(p));
    const double slip = x > kh ? J0x - J0kh : J0kh - J0x;
    energy += elements_[j].weight * (inverse_radius_[j] * stick + slip);
  }
  return energy;
}

double PlayLaw::dissipation(double x0, double x1, const PlayState& state) const noexcept {
  // D_j = int A_j dp_j, A_j = (w_j / r_j) int_{p}^{x} Y at the slipping distance; equals W - psi differences.
  PlayState after = state;
  commit(x1, after);
  return incremental_potential(x1, state) - incremental_potential(x0, state) -
         (free_energy(x1, after) - free_energy(x0, state));
}

double PlayLaw::stick_tangent(double x) const noexcept {
  double stick = 0.0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(count_); ++j) {
    stick += elements_[j].weight * inverse_radius_[j];
  }
  const CurveValue e = elastic_.evaluate(x);
  const CurveValue y = friction_.evaluate(x);
  return std::max(e.slope, 0.0) + std::abs(y.slope) + y.value * stick;
}

}  // namespace fuai
