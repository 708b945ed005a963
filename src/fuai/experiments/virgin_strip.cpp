// Hangs a strip by shooting from its free end.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/virgin_strip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "fuai/core/error.h"

namespace fuai {
namespace {

constexpr int kSteps = 200;        ///< of the midpoint rule along the strip; 400 change the chord by 2e-5
constexpr int kHalvings = 45;      ///< of the logarithm of the tip's angle
constexpr int kTableNodes = 1024;  ///< of curvature over moment
constexpr double kMostCurvature = 2000.0;  ///< of the table [1/m], 20 1/cm; a straight line beyond

/// Curvature of first loading over moment, by interpolation.
class Compliance {
 public:
  explicit Compliance(const PlayLaw& law) {
    // Nodes lie closer near zero, where friction builds up.
    for (int i = 0; i < kTableNodes; ++i) {
      const double part = static_cast<double>(i) / (kTableNodes - 1);
      curvatures_.push_back(kMostCurvature * part * part * part);
      const double moment = law.evaluate(curvatures_.back(), PlayState{}).stress;
      moments_.push_back(moments_.empty() ? 0.0 : std::max(moment, moments_.back()));
    }
  }

  double operator()(double moment) const {
    const auto above = std::ranges::upper_bound(moments_, moment);
    const auto i =
        std::clamp<std::size_t>(static_cast<std::size_t>(above - moments_.begin()), 1, moments_.size() - 1);
    const double rise = moments_[i] - moments_[i - 1];
    if (!(rise > 0.0)) return curvatures_[i - 1];
    return curvatures_[i - 1] + (curvatures_[i] - curvatures_[i - 1]) * (moment - moments_[i - 1]) / rise;
  }

 private:
  std::vector<double> curvatures_, moments_;
};

/// The shape whose tip points `start` away from straight down. phi = 90 deg - theta grows from the tip to the
/// clamp; small numbers keep their digits.
/// @return phi at the clamp less 90 degrees, 0 for the strip that is looked for
double shoot(const Compliance& curvature, double weight, double length, double start, VirginStrip& strip) {
  const double h = length / kSteps;
  double phi = start, moment = 0.0;
  strip.reach = strip.droop = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = i * h;
    const double middle_moment = moment + 0.5 * h * weight * s * std::sin(phi);
    const double middle = phi + 0.5 * h * curvature(moment);
    phi += h * curvature(middle_moment);
    moment += h * weight * (s + 0.5 * h) * std::sin(middle);
    strip.reach += h * std::sin(middle);
    strip.droop += h * std::cos(middle);
    if (phi > std::numbers::pi) break;  // far beyond the clamp
  }
  return phi - 0.5 * std::numbers::pi;
}

}  // namespace

VirginStrip hang_virgin_strip(const PlayLaw& law, double weight, double length) {
  if (!(weight > 0.0) || !(length > 0.0) || !std::isfinite(weight * length))
    throw Error(ErrorKind::kUsage, "a strip needs a weight and a length above 0");
  const Compliance curvature(law);
  VirginStrip strip;
  constexpr double kLeastStart = -700.0;  // of ln phi: the tip of a long limp strip points straight down
  double low = kLeastStart, high = std::log(0.5 * std::numbers::pi);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (shoot(curvature, weight, length, std::exp(middle), strip) > 0.0 ? high : low) = middle;
  }
  shoot(curvature, weight, length, std::exp(low), strip);
  strip.tip_angle = 0.5 * std::numbers::pi - std::exp(low);
  strip.chord_angle = std::atan2(strip.droop, strip.reach);
  return strip;
}

}  // namespace fuai
