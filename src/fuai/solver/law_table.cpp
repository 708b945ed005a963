// Samples a play law into straight pieces.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/law_table.h"

#include <algorithm>
#include <cmath>

namespace fuai {
namespace {

/// Pieces over a curved measured range: twice as many while they leave the curves by more than this part of
/// the peak, but never more than one near cache holds of five laws.
constexpr std::size_t kFewestPieces = 512, kMostPieces = 4096;
constexpr double kTableTolerance = 1e-4;
/// Pieces from the end of the measured range to the jamming limit, and how far toward it they go: there the
/// force is 200 times its slope times the gap.
constexpr int kJammingPieces = 128;
constexpr double kJammingReach = 0.995;

/// How far a curve goes from straight pieces of its range, in their middles where a cubic goes farthest.
double largest_bow(const CurveTable& curve, double low, double high, std::size_t pieces) {
  const double step = (high - low) / static_cast<double>(pieces);
  double largest = 0.0, start = curve.evaluate(low).value;
  for (std::size_t i = 0; i < pieces; ++i) {
    const double x = low + step * static_cast<double>(i), end = curve.evaluate(x + step).value;
    largest = std::max(largest, std::abs(curve.evaluate(x + 0.5 * step).value - 0.5 * (start + end)));
    start = end;
  }
  return largest;
}

/// Pieces between two nodes of a law's tables: 1 for curves given by a few straight pieces.
std::size_t refinement(const PlayLaw& law) {
  const CurveTable& elastic = law.elastic();
  const std::size_t cells = elastic.node_count() - 1;
  if (cells <= 2) return 1;
  double peak = 0.0;
  for (double f : elastic.nodes()) peak = std::max(peak, std::abs(f));
  std::size_t parts = (kFewestPieces + cells - 1) / cells;
  while (2 * parts * cells <= kMostPieces &&
         std::max(largest_bow(elastic, elastic.low(), elastic.high(), parts * cells),
                  largest_bow(law.friction(), elastic.low(), elastic.high(), parts * cells)) >
             kTableTolerance * peak)
    parts *= 2;
  return parts;
}

/// Whether a curve is one straight line between its ends, to rounding.
bool is_straight(const CurveTable& curve) {
  const double low = curve.nodes().front(), rise = curve.nodes().back() - low;
  const double size = std::max(std::abs(low), std::abs(curve.nodes().back()));
  for (std::size_t i = 0; i < curve.node_count(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(curve.node_count() - 1);
    if (std::abs(curve.nodes()[i] - low - part * rise) > 1e-12 * size) return false;
  }
  return true;
}

/// End of the sampled region beyond one end of the measured range.
double outer_end(const CurveTable& curve, double end, double side) {
  const Extrapolation& rule = curve.extrapolation();
  if (rule.kind != Extrapolation::Kind::kJamming) return end + side * (curve.high() - curve.low());
  return end + kJammingReach * (side * rule.limit - end);
}

}  // namespace

template <class T>
LawTable<T>::LawTable(const PlayLaw& law) {
  const CurveTable& elastic = law.elastic();
  const CurveTable& friction = law.friction();
  LawTableView<T>& v = layout_;
  v.plays = static_cast<int>(law.elements().size());
  for (std::size_t j = 0; j < law.elements().size(); ++j) {
    v.radius[j] = static_cast<T>(law.elements()[j].radius);
    v.inverse_radius[j] = static_cast<T>(1.0 / law.elements()[j].radius);
    v.weight[j] = static_cast<T>(law.elements()[j].weight);
  }
  if (elastic.node_count() < 2) {  // a law without stiffness: three pieces of zero
    below_ = 1;
    pieces_.assign(12, T(0));
    v.count = 1;
    v.first_index = -1;
    v.last_index = 1;
    v.high = 1;
    return;
  }
  const double low = elastic.low(), high = elastic.high();
  const auto inner = static_cast<int>((elastic.node_count() - 1) * refinement(law));
  const bool jams = elastic.extrapolation().kind == Extrapolation::Kind::kJamming;
  const int outer = jams ? kJammingPieces : 1;
  const double step = (high - low) / inner;
  const double step_low = (low - outer_end(elastic, low, -1.0)) / outer;
  const double step_high = (outer_end(elastic, high, 1.0) - high) / outer;
  const auto position = [&](int index) {
    if (index < 0) return low + index * step_low;
    if (index > inner) return high + (index - inner) * step_high;
    return low + (high - low) * (static_cast<double>(index) / inner);
  };
  below_ = outer + 1;
  const int total = inner + 2 * outer + 2;
  pieces_.reserve(static_cast<std::size_t>(total) * 4);
  for (int index = -below_; index < total - below_; ++index) {
    const double x0 = position(index), x1 = position(index + 1), width = x1 - x0;
    const double f0 = elastic.evaluate(x0).value, f1 = elastic.evaluate(x1).value;
    const double y0 = friction.evaluate(x0).value, y1 = friction.evaluate(x1).value;
    for (double value : {f0, (f1 - f0) / width, y0, (y1 - y0) / width})
      pieces_.push_back(static_cast<T>(value));
  }
  if (is_straight(elastic) && friction.node_count() > 1 && is_straight(friction) &&
      friction.nodes().front() == friction.nodes().back()) {
    const double slope = (elastic.nodes().back() - elastic.nodes().front()) / (high - low);
    v.straight = true;
    v.slope = static_cast<T>(slope);
    v.offset = static_cast<T>(elastic.nodes().front() - slope * low);
    v.strength = static_cast<T>(friction.nodes().front());
  }
  v.low = static_cast<T>(low);
  v.high = static_cast<T>(high);
  v.step = static_cast<T>(step);
  v.step_low = static_cast<T>(step_low);
  v.step_high = static_cast<T>(step_high);
  v.inverse_step = static_cast<T>(1.0 / step);
  v.inverse_step_low = static_cast<T>(1.0 / step_low);
  v.inverse_step_high = static_cast<T>(1.0 / step_high);
  v.count = static_cast<T>(inner);
  v.first_index = static_cast<T>(-below_);
  v.last_index = static_cast<T>(inner + outer);
}

template <class T>
LawTableView<T> LawTable<T>::view() const noexcept {
  LawTableView<T> v = layout_;
  v.pieces = pieces_.data() + static_cast<std::ptrdiff_t>(4) * below_;
  return v;
}

template class LawTable<float>;
template class LawTable<double>;

}  // namespace fuai
