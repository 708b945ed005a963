// Integrates the heavy elastica from its free end.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/elastica.h"

#include <array>
#include <cmath>
#include <numbers>

#include "fuai/core/error.h"

namespace fuai {
namespace {

constexpr double kRight = 0.5 * std::numbers::pi;
/// Runge-Kutta steps over the strip: the error of all results is below 1e-10 up to loads of 200, where the
/// tests look, and below 1e-7 at the largest load.
constexpr int kSteps = 1000;
constexpr int kBisections = 200;
/// Where the search for a load stops: of ln(lambda), and of the chord angle as a part of itself.
constexpr double kLogTolerance = 1e-13, kAngleTolerance = 1e-13;

/// phi, dphi/dtau, and the integrals of sin(phi) (reach) and cos(phi) (droop).
using Shape = std::array<double, 4>;

Shape rate(double tau, const Shape& y) {
  const double sine = std::sin(y[0]);
  return {y[1], tau * sine, sine, std::cos(y[0])};
}

Shape along(const Shape& y, double h, const Shape& k) {
  Shape moved = y;
  for (std::size_t i = 0; i < y.size(); ++i) moved[i] += h * k[i];
  return moved;
}

/// From the free end to tau = length. @param stop ends early where phi has passed it
Shape integrate(double phi0, double length, double stop) {
  const double h = length / kSteps;
  Shape y{phi0, 0.0, 0.0, 0.0};
  for (int i = 0; i < kSteps && y[0] <= stop; ++i) {
    const double tau = i * h;
    const Shape a = rate(tau, y), b = rate(tau + 0.5 * h, along(y, 0.5 * h, a));
    const Shape c = rate(tau + 0.5 * h, along(y, 0.5 * h, b)), d = rate(tau + h, along(y, h, c));
    for (std::size_t j = 0; j < y.size(); ++j) y[j] += h / 6.0 * (a[j] + 2.0 * b[j] + 2.0 * c[j] + d[j]);
  }
  return y;
}

/// Bisection for a rising function, to the last bit.
template <class Function>
double root_of_rising(Function function, double low, double high) {
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (function(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

HeavyElastica heavy_elastica(double load) {
  if (!(load > 0.0 && load <= kMostElasticaLoad)) {
    throw Error(ErrorKind::kUsage,
                "the heavy elastica needs a load w L^3 / B of more than 0 and at most 1e6");
  }
  const double length = std::cbrt(load);
  // phi grows at most like exp(2/3 tau^(3/2)), so phi0 is not below this; from 90 degrees it ends above.
  const double least = -2.0 * std::pow(length, 1.5) / 3.0 - 4.0;
  const double log_phi0 = root_of_rising(
      [&](double l) { return integrate(std::exp(l), length, kRight)[0] - kRight; }, least, std::log(kRight));
  const double phi0 = std::exp(log_phi0);
  const Shape root = integrate(phi0, length, 2.0 * kRight);
  HeavyElastica shape;
  shape.tip_angle = kRight - phi0;
  shape.reach = root[2] / length;
  shape.droop = root[3] / length;
  shape.chord_angle = std::atan2(shape.droop, shape.reach);
  shape.root_curvature = root[1] * length;
  return shape;
}

double heavy_elastica_load(double chord_angle) {
  constexpr double kLeastLog = -25.0;
  const double most_log = std::log(kMostElasticaLoad);
  const auto short_of = [&](double log_load) {
    return heavy_elastica(std::exp(log_load)).chord_angle - chord_angle;
  };
  if (!(chord_angle > 0.0) || short_of(kLeastLog) > 0.0 || short_of(most_log) < 0.0) {
    throw Error(ErrorKind::kUsage, "no strip hangs at this chord angle under its own weight", {},
                "the angle must be above 0 and below 89.9 degrees");
  }
  // Illinois' false position: a dozen shapes instead of fifty.
  double low = kLeastLog, high = most_log, f_low = short_of(low), f_high = short_of(high), at = low;
  int side = 0;
  for (int i = 0; i < kBisections && high - low > kLogTolerance; ++i) {
    // Every fourth time the middle, so that the bracket shrinks from both ends.
    at = i % 4 == 3 ? 0.5 * (low + high) : (low * f_high - high * f_low) / (f_high - f_low);
    const double f = short_of(at);
    if (std::abs(f) < kAngleTolerance * chord_angle) break;
    if (f < 0.0) {
      low = at, f_low = f;
      if (side < 0) f_high *= 0.5;
      side = -1;
    } else {
      high = at, f_high = f;
      if (side > 0) f_low *= 0.5;
      side = 1;
    }
  }
  return std::exp(at);
}

double peirce_load(double chord_angle) noexcept {
  return 8.0 * std::tan(chord_angle) / std::cos(0.5 * chord_angle);
}

}  // namespace fuai
