// Builds and evaluates curve tables.
// SPDX-License-Identifier: Apache-2.0
// Source: Fritsch & Carlson 1980 (monotone cubic interpolation).
#include "fuai/fabric/curve_table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Beyond this fraction of the way to the jamming limit the force goes on straight, so that it stays finite.
constexpr double kJamClamp = 0.995;

/// The jamming force over (slope * gap): z^2 / (1 - z), zero with zero slope at z = 0 and infinite at z = 1;
/// linear from kJamClamp on. Value, derivative and integrals in z.
struct Jam {
  double value, slope, integral, moment;  ///< moment = integral of z f dz
};

Jam jam(double z) {
  const double zc = std::min(z, kJamClamp);
  const double rest = 1.0 - zc;
  const double log_rest = std::log1p(-zc);
  Jam j;
  j.value = zc * zc / rest;
  j.slope = (2.0 * zc - zc * zc) / (rest * rest);
  // z^2/(1-z) = -z - 1 + 1/(1-z);  z^3/(1-z) = -z^2 - z - 1 + 1/(1-z)
  j.integral = -0.5 * zc * zc - zc - log_rest;
  j.moment = -zc * zc * zc / 3.0 - 0.5 * zc * zc - zc - log_rest;
  const double over = z - zc;
  if (over > 0.0) {
    j.moment += over * (zc * j.value + 0.5 * over * (j.value + zc * j.slope) + over * over * j.slope / 3.0);
    j.integral += over * (j.value + 0.5 * over * j.slope);
    j.value += over * j.slope;
  }
  return j;
}

/// Slopes at the nodes, in units of value per cell, that keep the cubic monotone in every cell.
std::vector<double> monotone_slopes(std::span<const double> f) {
  const std::size_t n = f.size();
  std::vector<double> secant(n - 1), slope(n);
  for (std::size_t i = 0; i + 1 < n; ++i) secant[i] = f[i + 1] - f[i];
  // Second-order one-sided differences at the ends, the mean of the two secants inside.
  slope[0] = n > 2 ? 1.5 * secant[0] - 0.5 * secant[1] : secant[0];
  slope[n - 1] = n > 2 ? 1.5 * secant[n - 2] - 0.5 * secant[n - 3] : secant[n - 2];
  for (std::size_t i = 1; i + 1 < n; ++i) {
    slope[i] = secant[i - 1] * secant[i] > 0.0 ? 0.5 * (secant[i - 1] + secant[i]) : 0.0;
  }
  // Each slope is limited to three times either neighbouring secant (the square inside the monotone region).
  for (std::size_t i = 0; i < n; ++i) {
    double bound = 3.0 * std::abs(secant[std::min(i, n - 2)]);
    if (i > 0) bound = std::min(bound, 3.0 * std::abs(secant[i - 1]));
    const double sign_ref = i == 0 ? secant[0] : secant[i - 1];
    if (slope[i] * sign_ref < 0.0) slope[i] = 0.0;
    slope[i] = std::clamp(slope[i], -bound, bound);
  }
  return slope;
}

}  // namespace

CurveTable make_curve_table(double low, double high, std::span<const double> values,
                            const Extrapolation& extrapolation) {
  if (values.size() < 2) {
    throw Error(ErrorKind::kBadInput,
                "a curve table needs at least two values, got " + std::to_string(values.size()));
  }
  if (!(low < high) || !std::isfinite(low) || !std::isfinite(high)) {
    throw Error(ErrorKind::kBadInput, "a curve table needs low < high");
  }
  for (double v : values) {
    if (!std::isfinite(v)) throw Error(ErrorKind::kBadInput, "a curve table got a value that is not finite");
  }
  CurveTable table;
  const std::size_t n = values.size();
  table.low_ = low;
  table.high_ = high;
  table.spacing_ = (high - low) / static_cast<double>(n - 1);
  table.inverse_spacing_ = 1.0 / table.spacing_;
  table.nodes_.assign(values.begin(), values.end());
  const std::vector<double> m = monotone_slopes(values);
  table.cells_.resize(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double df = values[i + 1] - values[i];
    table.cells_[i] = {values[i], m[i], 3.0 * df - 2.0 * m[i] - m[i + 1], m[i] + m[i + 1] - 2.0 * df};
  }
  table.extrapolation_ = extrapolation;
  Extrapolation& rule = table.extrapolation_;
  if (!rule.slopes_given) {
    rule.slope_low = m.front() * table.inverse_spacing_;
    rule.slope_high = m.back() * table.inverse_spacing_;
  }
  if (rule.kind == Extrapolation::Kind::kConstant) rule.slope_low = rule.slope_high = 0.0;
  if (rule.kind == Extrapolation::Kind::kJamming && !(rule.limit > std::max(std::abs(low), std::abs(high)))) {
    throw Error(ErrorKind::kBadInput, "the jamming limit lies inside the measured range", {},
                "give a limit beyond the largest measured strain");
  }
  // Integrals at the nodes, then shifted so that integral(0) = 0.
  table.integral_.assign(n, 0.0);
  table.first_moment_.assign(n, 0.0);
  const double h = table.spacing_;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const auto [c0, c1, c2, c3] = table.cells_[i];
    const double area = c0 + c1 / 2.0 + c2 / 3.0 + c3 / 4.0;
    const double lever = c0 / 2.0 + c1 / 3.0 + c2 / 4.0 + c3 / 5.0;
    table.integral_[i + 1] = table.integral_[i] + h * area;
    table.first_moment_[i + 1] = table.first_moment_[i] + h * (table.node_position(i) * area + h * lever);
  }
  table.integral_at_zero_ = table.integral(0.0);
  table.first_moment_at_zero_ = table.first_moment(0.0);
  return table;
}

CurveTable scaled(const CurveTable& table, double factor) {
  if (table.node_count() == 0) return table;
  std::vector<double> values(table.nodes().begin(), table.nodes().end());
  for (double& value : values) value *= factor;
  Extrapolation rule = table.extrapolation();
  rule.slope_low *= factor;
  rule.slope_high *= factor;
  return make_curve_table(table.low(), table.high(), values, rule);
}

CurveValue CurveTable::evaluate(double x) const noexcept {
  if (x >= low_ && x <= high_) {
    const double u = (x - low_) * inverse_spacing_;
    const std::size_t i = std::min(static_cast<std::size_t>(u), cells_.size() - 1);
    const double t = u - static_cast<double>(i);
    const Cell& c = cells_[i];
    return {c.c0 + t * (c.c1 + t * (c.c2 + t * c.c3)),
            (c.c1 + t * (2.0 * c.c2 + t * 3.0 * c.c3)) * inverse_spacing_};
  }
  CurveValue result;
  result.value = outside_value(x, &result.slope);
  return result;
}

CurveTable::Outside CurveTable::outside(double x) const noexcept {
  const bool above = x > high_;
  Outside o{};
  o.end = above ? high_ : low_;
  o.base = above ? nodes_.back() : nodes_.front();
  o.slope = above ? extrapolation_.slope_high : extrapolation_.slope_low;
  o.distance = x - o.end;
  o.side = above ? 1.0 : -1.0;
  if (extrapolation_.kind == Extrapolation::Kind::kJamming) o.gap = extrapolation_.limit - std::abs(o.end);
  return o;
}

double CurveTable::outside_value(double x, double* slope) const noexcept {
  if (cells_.empty()) {
    *slope = 0.0;
    return 0.0;
  }
  const Outside o = outside(x);
  double value = o.base + o.slope * o.distance;
  *slope = o.slope;
  if (o.gap > 0.0) {
    const Jam j = jam(std::abs(o.distance) / o.gap);
    value += o.side * o.slope * o.gap * j.value;
    *slope += o.slope * j.slope;
  }
  return value;
}

double CurveTable::outside_integral(double x) const noexcept {
  if (cells_.empty()) return 0.0;
  const Outside o = outside(x);
  const double d = o.distance;
  double sum = o.base * d + 0.5 * o.slope * d * d;
  if (o.gap > 0.0) sum += o.slope * o.gap * o.gap * jam(std::abs(d) / o.gap).integral;
  return sum;
}

double CurveTable::outside_first_moment(double x) const noexcept {
  if (cells_.empty()) return 0.0;
  const Outside o = outside(x);
  const double d = o.distance;
  // integral of k f(k) dk with k = end + q, q from 0 to d
  double sum =
      o.end * (o.base * d + 0.5 * o.slope * d * d) + 0.5 * o.base * d * d + o.slope * d * d * d / 3.0;
  if (o.gap > 0.0) {
    const Jam j = jam(std::abs(d) / o.gap);
    sum += o.slope * o.gap * o.gap * (o.end * j.integral + o.side * o.gap * j.moment);
  }
  return sum;
}

double CurveTable::raw_integral(double x) const noexcept {
  const double u = (x - low_) * inverse_spacing_;
  const std::size_t i = std::min(static_cast<std::size_t>(std::max(u, 0.0)), cells_.size() - 1);
  const double t = u - static_cast<double>(i);
  const Cell& c = cells_[i];
  return integral_[i] + spacing_ * t * (c.c0 + t * (c.c1 / 2.0 + t * (c.c2 / 3.0 + t * c.c3 / 4.0)));
}

double CurveTable::raw_first_moment(double x) const noexcept {
  const double u = (x - low_) * inverse_spacing_;
  const std::size_t i = std::min(static_cast<std::size_t>(std::max(u, 0.0)), cells_.size() - 1);
  const double t = u - static_cast<double>(i);
  const Cell& c = cells_[i];
  const double start = node_position(i);
  const double area = t * (c.c0 + t * (c.c1 / 2.0 + t * (c.c2 / 3.0 + t * c.c3 / 4.0)));
  const double lever = t * t * (c.c0 / 2.0 + t * (c.c1 / 3.0 + t * (c.c2 / 4.0 + t * c.c3 / 5.0)));
  return first_moment_[i] + spacing_ * (start * area + spacing_ * lever);
}

double CurveTable::integral(double x) const noexcept {
  if (cells_.empty()) return 0.0;
  if (x > high_) return integral_.back() + outside_integral(x) - integral_at_zero_;
  if (x < low_) return outside_integral(x) - integral_at_zero_;
  return raw_integral(x) - integral_at_zero_;
}

double CurveTable::first_moment(double x) const noexcept {
  if (cells_.empty()) return 0.0;
  if (x > high_) return first_moment_.back() + outside_first_moment(x) - first_moment_at_zero_;
  if (x < low_) return outside_first_moment(x) - first_moment_at_zero_;
  return raw_first_moment(x) - first_moment_at_zero_;
}

}  // namespace fuai
