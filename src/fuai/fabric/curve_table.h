// A curve on equally spaced nodes with its slope and integrals: the real-time form of every measured curve.
// SPDX-License-Identifier: Apache-2.0
//
// Between nodes the curve is a cubic Hermite polynomial with Fritsch-Carlson slopes: it passes through every
// node exactly, is C1, rises where the data rise and never leaves the interval of the two neighbouring
// values. Outside the nodes a stated rule continues it (Extrapolation).
#pragma once

#include <span>
#include <vector>

namespace fuai {

/// How a table continues beyond its first and last node.
struct Extrapolation {
  enum class Kind {
    kConstant,  ///< keeps the end value
    kLinear,    ///< keeps the end slope
    kJamming,   ///< kLinear plus a force that goes to infinity at +-limit: geometry forbids more (see
                ///< docs/theory)
  };
  Kind kind = Kind::kLinear;
  double limit = 0.0;  ///< kJamming: |x| that cannot be reached, beyond the last node [unit of x]
  double slope_low =
      0.0;  ///< kLinear and kJamming: slope below the first node; set from the table by default
  double slope_high = 0.0;  ///< the same above the last node
  bool slopes_given = false;
};

/// The end values are kept.
constexpr Extrapolation constant_outside() {
  Extrapolation rule;
  rule.kind = Extrapolation::Kind::kConstant;
  return rule;
}

/// The end slopes are kept, and the force goes to infinity at +-limit [unit of x].
constexpr Extrapolation jamming_outside(double limit) {
  Extrapolation rule;
  rule.kind = Extrapolation::Kind::kJamming;
  rule.limit = limit;
  return rule;
}

/// Value, slope and integrals at one point.
struct CurveValue {
  double value = 0.0;
  double slope = 0.0;
};

/// The table. Immutable once built; evaluation is real-time safe.
class CurveTable {
 public:
  /// A table without nodes is zero everywhere.
  CurveTable() = default;

  /// Value and slope at x. Thread class: real-time.
  CurveValue evaluate(double x) const noexcept;
  /// Integral of f from 0 to x. Thread class: real-time.
  double integral(double x) const noexcept;
  /// Integral of k f(k) dk from 0 to x. Thread class: real-time.
  double first_moment(double x) const noexcept;

  double low() const noexcept { return low_; }    ///< first node
  double high() const noexcept { return high_; }  ///< last node
  double spacing() const noexcept { return spacing_; }
  std::size_t node_count() const noexcept { return nodes_.size(); }
  /// Node values as given.
  std::span<const double> nodes() const noexcept { return nodes_; }
  double node_position(std::size_t i) const noexcept { return low_ + spacing_ * static_cast<double>(i); }
  const Extrapolation& extrapolation() const noexcept { return extrapolation_; }

 private:
  friend CurveTable make_curve_table(double low, double high, std::span<const double> values,
                                     const Extrapolation& extrapolation);

  struct Cell {
    double c0, c1, c2, c3;  ///< f = c0 + t (c1 + t (c2 + t c3)), t in [0, 1]
  };
  double raw_integral(double x) const noexcept;      // from low()
  double raw_first_moment(double x) const noexcept;  // from low()
  /// How the curve starts out from the end that x lies beyond.
  struct Outside {
    double end;       ///< the last node on that side
    double base;      ///< value there
    double slope;     ///< slope there
    double distance;  ///< x - end
    double side;      ///< +1 above, -1 below
    double gap;       ///< from the end to the jamming limit; 0 without jamming
  };
  Outside outside(double x) const noexcept;
  double outside_value(double x, double* slope) const noexcept;
  double outside_integral(double x) const noexcept;      // from the nearer end
  double outside_first_moment(double x) const noexcept;  // from the nearer end

  // Empty: every x lies outside.
  double low_ = 0.0, high_ = -1.0, spacing_ = 1.0, inverse_spacing_ = 1.0;
  std::vector<Cell> cells_{};
  std::vector<double> nodes_{};
  std::vector<double> integral_{};      // at nodes, from low()
  std::vector<double> first_moment_{};  // at nodes, from low()
  double integral_at_zero_ = 0.0, first_moment_at_zero_ = 0.0;
  Extrapolation extrapolation_;
};

/// Builds a table over [low, high] from equally spaced values, the first at low and the last at high.
/// @throws Error (kBadInput) when there are fewer than two values, a value is not finite, low >= high, or a
/// jamming limit lies inside the table. Thread class: set-up.
/// @source Fritsch & Carlson 1980, SIAM J. Numer. Anal. 17(2) (slopes)
CurveTable make_curve_table(double low, double high, std::span<const double> values,
                            const Extrapolation& extrapolation = {});

/// The table with every value times a factor, beyond its ends too; where jamming begins stays. With a factor
/// of 1 every bit is the same. @param factor finite. Thread class: set-up.
CurveTable scaled(const CurveTable& table, double factor);

}  // namespace fuai
