// Laws from KES scalars alone.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/scalar_laws.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

constexpr std::size_t kNodes = 201;

[[noreturn]] void refuse(const std::string& what, const std::string& cure) {
  throw Error(ErrorKind::kBadInput, what, {}, cure);
}

/// (e^{a z} - 1) / (e^a - 1), regular at a = 0.
double exponential_shape(double a, double z) {
  return std::abs(a) < 1e-9 ? z : std::expm1(a * z) / std::expm1(a);
}

/// LT of the exponential with rate a.
double exponential_linearity(double a) {
  if (std::abs(a) < 1e-4) return 1.0 - a / 6.0;  // series; the next term is a^3 / 360
  return 2.0 * (1.0 / a - 1.0 / std::expm1(a));
}

/// Where KES reads shear [rad]: 2HG, the end of the window of G, 2HG5.
constexpr double kNear = 0.5 * unit::kDegree, kWindow = 2.5 * unit::kDegree, kFar = 5.0 * unit::kDegree;
/// Of the slope of G less the tension's share, the friction may grow by this part and the recovery branch
/// still rises with the angle, by a tenth of it.
constexpr double kGrowthShare = 0.45;
/// A loading branch steeper than this many times G beyond 2.5 degrees is no cloth.
constexpr double kMostStiffening = 20.0;

/// The simplest steady loop of forces with given G, 2HG, 2HG5: mean line and half width, straight but for
/// corners at 0.5 and 2.5 degrees. The loading branch has the slope G up to 2.5 degrees, and both branches
/// rise with the angle, by more than the tension alone makes them: what the friction cannot grow before 2.5
/// degrees without turning the recovery down, it grows after, where the loading branch is then steeper.
struct MeasuredShear {
  double near_width, near_slope, near_growth, far_slope, far_growth;

  double mean(double angle) const {
    return near_slope * std::min(angle, kWindow) + far_slope * std::max(angle - kWindow, 0.0);
  }
  double half_width(double angle) const {
    return near_width + near_growth * std::clamp(angle - kNear, 0.0, kWindow - kNear) +
           far_growth * std::max(angle - kWindow, 0.0);
  }
};

/// @param near,far half widths at 0.5 and 5 degrees [N/m] @param tension its slope [N/(m rad)]
MeasuredShear measured_shear(double G, double near, double far, double tension) {
  const double wanted = (far - near) / (kFar - kNear), room = kGrowthShare * (G - tension);
  const double growth = std::min(wanted, room);
  const double rest = (far - near - growth * (kWindow - kNear)) / (kFar - kWindow);
  const double least = tension + rest + (1.0 - 2.0 * kGrowthShare) * (G - tension);
  return {near, G - growth, growth, std::max(G - growth, least), rest};
}

}  // namespace

double kes_shear_range() { return 8.0 * unit::kDegree; }

Extrapolation bending_outside(double range, double jamming_curvature) {
  if (jamming_curvature == kNoJamming) return {};
  return jamming_outside(std::max(jamming_curvature, 1.25 * range));
}

Extrapolation shear_outside() { return jamming_outside(0.5 * std::numbers::pi); }

Extrapolation tensile_outside(double secant_stiffness, double end_slope) {
  Extrapolation rule;
  rule.kind = Extrapolation::Kind::kLinear;
  rule.slope_low = 0.01 * secant_stiffness;
  rule.slope_high = end_slope;
  rule.slopes_given = true;
  return rule;
}

PlayLaw make_bending_law(double B, double hysteresis_2HB, double jamming_curvature,
                         std::span<const PlayElement> plays) {
  if (!(B > 0.0) || !std::isfinite(B))
    refuse("the bending rigidity B must be positive", "check B and its unit");
  if (!(hysteresis_2HB >= 0.0))
    refuse("the bending hysteresis 2HB must not be negative", "check 2HB and its unit");
  const double range = kKesBendingRange;
  const std::vector<double> elastic{-B * range, 0.0, B * range}, friction(3, 0.5 * hysteresis_2HB);
  return make_play_law(make_curve_table(-range, range, elastic, bending_outside(range, jamming_curvature)),
                       make_curve_table(-range, range, friction, constant_outside()), plays);
}

PlayLaw make_shear_law(double G, double hysteresis_2HG, double hysteresis_2HG5, const ShearTest& test) {
  if (!(G > 0.0)) refuse("the shear rigidity G must be positive", "check G and its unit");
  if (!(hysteresis_2HG >= 0.0) || !(hysteresis_2HG5 >= 0.0))
    refuse("shear hysteresis must not be negative", "check 2HG and 2HG5");
  if (!(G > test.tension)) {
    refuse("the shear rigidity G is not more than what the tension of the test alone adds",
           "check G; state tension_gf_per_cm = 0 for a G without the share of a tension");
  }
  const MeasuredShear loop = measured_shear(G, 0.5 * hysteresis_2HG, 0.5 * hysteresis_2HG5, test.tension);
  if (loop.far_slope + loop.far_growth > kMostStiffening * G) {
    refuse("2HG5 exceeds 2HG by more than the shear rigidity G can lift in 4.5 degrees",
           "check G, 2HG and 2HG5: the recovery branch would fall while the angle grows");
  }
  // A node at every twentieth of a degree, so that 0.5, 2.5 and 5 degrees are nodes.
  const std::size_t count = 2 * 8 * 20 + 1;
  const double range = kes_shear_range();
  std::vector<double> elastic(count), friction(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = range * (2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1.0);
    const double mean = loop.mean(std::abs(angle)), half = loop.half_width(std::abs(angle));
    const double load = shear_stress(test, mean + half, std::abs(angle));
    const double recovery = shear_stress(test, mean - half, std::abs(angle));
    elastic[i] = std::copysign(0.5 * (load + recovery), angle);
    friction[i] = std::max(0.5 * (load - recovery), 0.0);
  }
  const double degree = unit::kDegree;
  const PlayElement elements[] = {{0.1 * degree, 0.3}, {0.25 * degree, 0.4}, {0.5 * degree, 0.3}};
  return make_play_law(make_curve_table(-range, range, elastic, shear_outside()),
                       make_curve_table(-range, range, friction, constant_outside()), elements);
}

double exponential_rate(double LT) {
  if (!(LT > 0.02 && LT < 1.98))
    refuse("the tensile linearity LT must lie between 0.02 and 1.98", "LT is 0.4 to 1.2 for cloth");
  double low = -100.0, high = 100.0;  // LT falls as the rate grows; |a| <= 100 covers the range above
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (exponential_linearity(middle) > LT ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

PlayLaw make_tensile_law(double LT, double RT, double EMT, double peak_load) {
  if (!(RT > 0.0 && RT <= 1.0)) refuse("the tensile resilience RT must lie between 0 and 100 %", "check RT");
  if (!(EMT > 0.0) || !(peak_load > 0.0))
    refuse("EMT and the peak load must be positive", "check EMT and its unit");
  const double load_rate = exponential_rate(LT), back_rate = exponential_rate(RT * LT);
  VirginNodes nodes{EMT, std::vector<double>(kNodes), std::vector<double>(kNodes)};
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double z = static_cast<double>(i) / static_cast<double>(kNodes - 1);
    nodes.load[i] = peak_load * exponential_shape(load_rate, z);
    nodes.recovery[i] = peak_load * exponential_shape(back_rate, z);
  }
  const double end_slope =
      (nodes.load[kNodes - 1] - nodes.load[kNodes - 2]) * static_cast<double>(kNodes - 1) / EMT;
  return identify_virgin(nodes, scaled_elements(0.4 * EMT), false,
                         tensile_outside(peak_load / EMT, end_slope));
}

}  // namespace fuai
