// A bending law unfolded for the inner loop: the same cubics as its tables, evaluated inline.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fuai/energy/bend.h"
#include "fuai/fabric/play_law.h"

namespace fuai {

/// One curve: cubics between the nodes, the table's own rule outside.
class InlineCurve {
 public:
  InlineCurve() = default;
  /// Thread class: set-up.
  explicit InlineCurve(const CurveTable& table) : table_(table) {
    if (table.node_count() < 2) return;
    low_ = table.low();
    inverse_spacing_ = 1.0 / table.spacing();
    count_ = static_cast<double>(table.node_count() - 1);
    // A cubic is fixed by the values and slopes at its two nodes.
    for (std::size_t i = 0; i + 1 < table.node_count(); ++i) {
      const CurveValue left = table.evaluate(table.node_position(i));
      const CurveValue right = table.evaluate(table.node_position(i + 1));
      const double m0 = left.slope * table.spacing(), m1 = right.slope * table.spacing();
      const double df = table.nodes()[i + 1] - table.nodes()[i];
      cells_.push_back({table.nodes()[i], m0, 3.0 * df - 2.0 * m0 - m1, m0 + m1 - 2.0 * df});
    }
  }

  /// Thread class: real-time.
  CurveValue evaluate(double x) const noexcept {
    const double u = (x - low_) * inverse_spacing_;
    if (!(u >= 0.0 && u < count_)) return table_.evaluate(x);
    const auto i = static_cast<std::size_t>(static_cast<int>(u));
    const double t = u - static_cast<double>(static_cast<int>(i));
    const Cell& c = cells_[i];
    return {c.c0 + t * (c.c1 + t * (c.c2 + t * c.c3)),
            (c.c1 + t * (2.0 * c.c2 + t * 3.0 * c.c3)) * inverse_spacing_};
  }

 private:
  struct Cell {
    double c0, c1, c2, c3;
  };
  CurveTable table_;
  double low_ = 0.0, inverse_spacing_ = 0.0, count_ = 0.0;
  std::vector<Cell> cells_{};
};

/// True when a curve is one straight line through zero, outside its nodes as well.
inline bool is_line(const CurveTable& table) noexcept {
  if (table.node_count() < 2) return true;
  const Extrapolation& outside = table.extrapolation();
  if (outside.kind != Extrapolation::Kind::kLinear) return false;
  const double slope = table.evaluate(0.0).slope;
  const auto differs = [&](double a, double b) {
    return std::abs(a - b) > 1e-12 * std::abs(slope);
  };  // rounding
  bool line = !differs(outside.slope_low, slope) && !differs(outside.slope_high, slope);
  for (std::size_t i = 0; i < table.node_count(); ++i) {
    const double x = table.node_position(i);
    line = line && !differs(table.nodes()[i] / table.high(), slope * x / table.high());
  }
  return line;
}

/// What resists the bending of a thread within the sheet [N m]: the elastic slope at zero curvature, no
/// friction.
inline double in_plane_stiffness(const PlayLaw& law) noexcept {
  return std::max(law.elastic().evaluate(0.0).slope, 0.0);
}

/// The moment of one thread direction; agrees with PlayLaw to rounding.
class BendTable {
 public:
  BendTable() = default;
  /// Thread class: set-up.
  explicit BendTable(const PlayLaw& law) : elastic_(law.elastic()), friction_(law.friction()) {
    in_plane_stiffness_ = fuai::in_plane_stiffness(law);
    for (double y : law.friction().nodes()) frictional_ = frictional_ || y > 0.0;
    linear_ = !frictional_ && is_line(law.elastic());
    if (!frictional_) return;
    for (const PlayElement& e : law.elements()) {
      radius_[count_] = e.radius;
      slope_[count_++] = e.weight / e.radius;
    }
  }

  /// PlayLaw::advance().stress: moves the memory and gives the moment. Thread class: real-time.
  double advance(double curvature, PlayState& state) const noexcept {
    const double moment = elastic_.evaluate(curvature).value;
    if (!frictional_) return moment;
    double S = 0.0;
    for (std::size_t j = 0; j < count_; ++j) {
      const double low = curvature - radius_[j], high = curvature + radius_[j];
      const double p = std::min(std::max(state.position[j], low), high);
      state.position[j] = p;
      S += slope_[j] * (curvature - p);
    }
    return moment + friction_.evaluate(curvature).value * S;
  }

  /// Moment of the paper's energy |t K / 2|. Thread class: real-time.
  double as_printed(double curvature) const noexcept {
    const CurveValue t =
        ascending_branch(curvature, elastic_.evaluate(curvature), friction_.evaluate(curvature));
    return bend_as_printed(curvature, t).moment;
  }

  /// True for M = B K without friction: then the normal does not matter.
  bool linear() const noexcept { return linear_; }
  double in_plane_stiffness() const noexcept { return in_plane_stiffness_; }

 private:
  InlineCurve elastic_, friction_;
  double in_plane_stiffness_ = 0.0;
  bool frictional_ = false, linear_ = false;
  std::size_t count_ = 0;
  std::array<double, kMaxPlays> radius_{}, slope_{};
};

}  // namespace fuai
