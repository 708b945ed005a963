// Searches for the rigidity behind an overhang or a drape coefficient.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/fit_bending.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

#include "fuai/core/constants.h"
#include "fuai/core/error.h"
#include "fuai/experiments/elastica.h"
#include "fuai/experiments/virgin_strip.h"
#include "fuai/fabric/assumptions.h"
#include "fuai/fabric/bending_rules.h"
#include "fuai/fabric/fitted_number.h"
#include "fuai/fabric/laws.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

double weight_of(const Fabric& fabric) {
  if (!fabric.areal_mass.has_value() || !(fabric.areal_mass.value > 0.0))
    throw Error(ErrorKind::kBadInput, "a fit needs the areal mass of the cloth", {}, "state it");
  return fabric.areal_mass.value * kStandardGravity;
}

double thickness_of(const Fabric& fabric) {
  return fabric.thickness.has_value() ? fabric.thickness.value
                                      : fabric.areal_mass.value / assumed::kBulkDensity;
}

/// ln B where a falling function is zero. @throws Error (kCheckFailed) when the ends do not enclose it.
double bisect(double low, double high, const std::function<double(double)>& excess) {
  constexpr int kHalvings = 30;
  if (!(excess(low) > 0.0) || excess(high) > 0.0)
    throw Error(ErrorKind::kCheckFailed, "no rigidity hangs with this overhang", {},
                "check mass and overhang, and the fibre, which sets the friction");
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// B of the strip that hangs with this overhang. @param ratio 2HB / B [1/m]
double rigidity_of_overhang(const Fabric& fabric, double overhang, double angle, double ratio) {
  const double weight = weight_of(fabric), jamming = 1.0 / thickness_of(fabric);
  const double elastic = weight * std::pow(overhang, 3) / heavy_elastica_load(angle);
  const auto too_steep = [&](double ln_B) {
    const double B = std::exp(ln_B);
    return hang_virgin_strip(make_bending_law(B, ratio * B, jamming), weight, overhang).chord_angle - angle;
  };
  // Friction of a strip that hangs by 5 degrees or more is at most some ten times the elastic moment.
  constexpr double kWidest = 5.0;
  return std::exp(bisect(std::log(elastic) - kWidest, std::log(elastic) + 1.0, too_steep));
}

}  // namespace

Readings readings_of(std::span<const double> values) {
  Readings readings;
  readings.count = static_cast<int>(values.size());
  const auto count = static_cast<double>(values.size());
  readings.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double square = 0.0;
  for (const double value : values) square += (value - readings.mean) * (value - readings.mean);
  if (values.size() > 1) readings.error = std::sqrt(square / ((count - 1.0) * count));
  return readings;
}

double BendingFit::at(double place) const noexcept {
  // The parabola through ln B at -1, 0 and 1.
  const double a = std::log(rigidity[0]), b = std::log(rigidity[1]), c = std::log(rigidity[2]);
  return std::exp(b + 0.5 * place * (c - a) + 0.5 * place * place * (a + c - 2.0 * b));
}

double BendingFit::ratio_at(double place) const noexcept {
  return hysteresis_ratio[1] *
         std::pow(hysteresis_ratio[place < 0.0 ? 0 : 2] / hysteresis_ratio[1], std::abs(place));
}

double BendingFit::low() const noexcept {
  const double end = std::min({std::log(rigidity[0] / B()), std::log(rigidity[2] / B()), 0.0});
  return B() * std::exp(-std::hypot(end, noise));
}

double BendingFit::high() const noexcept {
  const double end = std::max({std::log(rigidity[0] / B()), std::log(rigidity[2] / B()), 0.0});
  return B() * std::exp(std::hypot(end, noise));
}

std::array<double, 3> hysteresis_ratios(const Fabric& fabric) {
  const double rule = hysteresis_rule(fabric).per_bending;
  return {rule / assumed::kHysteresisSpread, rule, rule * assumed::kHysteresisSpread};
}

BendingFit fit_bending_to_overhang(const Fabric& fabric, const Readings& overhang, double chord_angle) {
  constexpr double kLeastAngle = 5.0 * unit::kDegree, kMostAngle = 80.0 * unit::kDegree;
  if (!(chord_angle >= kLeastAngle && chord_angle <= kMostAngle))
    throw Error(ErrorKind::kUsage, "the chord of an overhang lies 5 to 80 degrees below level", {},
                "take 41.5deg");
  constexpr double kShortest = 1e-3, kLongest = 1.0;
  if (!(overhang.mean >= kShortest && overhang.mean <= kLongest))
    throw Error(ErrorKind::kBadInput, "no cloth has an overhang outside 1 mm to 1 m", {}, "check its unit");
  BendingFit fit;
  fit.hysteresis_ratio = hysteresis_ratios(fabric);
  for (std::size_t i = 0; i < 3; ++i)
    fit.rigidity[i] = rigidity_of_overhang(fabric, overhang.mean, chord_angle, fit.hysteresis_ratio[i]);
  fit.apparent = weight_of(fabric) * std::pow(overhang.mean, 3) / heavy_elastica_load(chord_angle);
  // By a difference: with friction B does not follow the cube of the overhang.
  const double step = 0.01 * overhang.mean;
  const double longer =
      rigidity_of_overhang(fabric, overhang.mean + step, chord_angle, fit.hysteresis_ratio[1]);
  fit.noise = std::log(longer / fit.B()) / step * overhang.error;
  return fit;
}

namespace {

/// The drape coefficient as a function of ln B, each rigidity tried once.
class DrapeSearch {
 public:
  DrapeSearch(const Fabric& fabric, const DrapeFitOptions& options, const Progress& progress)
      : fabric_(fabric), options_(options), progress_(progress) {}

  DrapeTest run(double ln_B, double ratio, int band_seeds) {
    Fabric tried = fabric_;
    for (const Direction direction : {Direction::kWarp, Direction::kWeft}) {
      BendingMeasurement& bending = tried.bending[static_cast<std::size_t>(direction)];
      bending.B.value = std::exp(ln_B);
      bending.hysteresis_2HB.value = ratio * std::exp(ln_B);
      bending.curve.reset();
    }
    DrapeTestOptions test;
    test.geometry = options_.geometry;
    test.runs = options_.runs;
    test.seed = options_.seed;
    test.threads = options_.threads;
    test.band_seeds = band_seeds;
    DrapeTest done = run_drape_test(make_fabric_laws(tried), test);
    runs_ += test.runs + (band_seeds > 0 ? 4 * band_seeds : 0);
    // About 13 rigidities in all.
    if (progress_) progress_("drape fit", std::min(0.95, runs_ / (13.0 * test.runs)));
    return done;
  }

  double coefficient(double ln_B, double ratio) { return run(ln_B, ratio, 0).coefficient.mean; }
  int runs() const noexcept { return runs_; }

 private:
  const Fabric& fabric_;
  const DrapeFitOptions& options_;
  const Progress& progress_;
  int runs_ = 0;
};

/// A rigidity and how much its coefficient is too large.
struct Trial {
  double ln_B, excess;
};

constexpr double kCoefficientTolerance = 2e-3;  ///< of DC: a tenth of the deviation over specimens
constexpr double kRigidityTolerance = 0.01;     ///< of ln B
constexpr int kMostTrials = 16;

/// Where DC is the measured one: false position with every third step in the middle.
Trial search(DrapeSearch& drape, double measured, double ratio, Trial low, Trial high) {
  Trial at = std::abs(low.excess) < std::abs(high.excess) ? low : high;
  for (int i = 0; i < kMostTrials && std::abs(at.excess) > kCoefficientTolerance &&
                  high.ln_B - low.ln_B > kRigidityTolerance;
       ++i) {
    const double t = i % 3 == 2 ? 0.5 : std::clamp(-low.excess / (high.excess - low.excess), 0.1, 0.9);
    at.ln_B = low.ln_B + t * (high.ln_B - low.ln_B);
    at.excess = drape.coefficient(at.ln_B, ratio) - measured;
    (at.excess < 0.0 ? low : high) = at;
  }
  return at;
}

/// The same from a guess and the slope of DC over ln B.
Trial search_near(DrapeSearch& drape, double measured, double ratio, double guess, double slope) {
  constexpr double kMargin = 0.005;  // of DC: makes it likely that the second trial lies beyond
  const auto trial = [&](double ln_B) { return Trial{ln_B, drape.coefficient(ln_B, ratio) - measured}; };
  const Trial first = trial(guess);
  if (std::abs(first.excess) <= kCoefficientTolerance) return first;
  Trial other = first;
  for (int i = 0; i < kMostTrials && (other.excess > 0.0) == (first.excess > 0.0); ++i)
    other = trial(other.ln_B - (other.excess + std::copysign(kMargin, first.excess)) / slope);
  if ((other.excess > 0.0) == (first.excess > 0.0))
    throw Error(ErrorKind::kCheckFailed, "the search for the rigidity of this drape went astray", {},
                "take more specimens");
  return first.excess < 0.0 ? search(drape, measured, ratio, first, other)
                            : search(drape, measured, ratio, other, first);
}

std::string percent(double fraction) { return std::to_string(std::lround(100.0 * fraction)) + " %"; }

}  // namespace

BendingFit fit_bending_to_drape(const Fabric& fabric, const Readings& coefficient,
                                const DrapeFitOptions& options, const Progress& progress) {
  constexpr double kLeastLength = 0.08, kMostLength = 0.8;  // bending length over the overhang
  const double weight = weight_of(fabric), overhang = options.geometry.overhang();
  const double measured = coefficient.mean;
  BendingFit fit;
  fit.hysteresis_ratio = hysteresis_ratios(fabric);
  DrapeSearch drape(fabric, options, progress);
  const auto trial = [&](double length, double ratio) {
    const double ln_B = std::log(weight * std::pow(length * overhang, 3));
    return Trial{ln_B, drape.coefficient(ln_B, ratio) - measured};
  };
  // 1. The ends, then the rule's friction.
  const Trial low = trial(kLeastLength, fit.hysteresis_ratio[1]),
              high = trial(kMostLength, fit.hysteresis_ratio[1]);
  if (low.excess > 0.0 || high.excess < 0.0) {
    throw Error(ErrorKind::kCheckFailed,
                "a drape coefficient of " + percent(measured) + " is outside what this tester tells apart, " +
                    percent(low.excess + measured) + " to " + percent(high.excess + measured),
                {}, "take a smaller specimen for limp cloth, a larger one for stiff cloth");
  }
  const Trial at = search(drape, measured, fit.hysteresis_ratio[1], low, high);
  fit.rigidity[1] = std::exp(at.ln_B);
  // 2. The slope, and how far specimens and the other assumptions scatter.
  constexpr double kStep = 0.3;  // of ln B: several times what the scatter hides
  const double slope = (drape.coefficient(at.ln_B + kStep, fit.hysteresis_ratio[1]) -
                        drape.coefficient(at.ln_B - kStep, fit.hysteresis_ratio[1])) /
                       (2.0 * kStep);
  if (!(slope > 0.0))
    throw Error(ErrorKind::kCheckFailed, "the drape coefficient does not grow with the rigidity here", {},
                "take more specimens");
  const DrapeTest there = drape.run(at.ln_B, fit.hysteresis_ratio[1], 2);
  double square = std::pow(coefficient.error, 2);
  if (options.runs > 1) square += std::pow(there.coefficient.deviation, 2) / options.runs;
  for (const DrapeBand& band : there.bands) square += std::pow(0.5 * (band.at_most - band.at_least), 2);
  fit.noise = std::sqrt(square) / slope;
  // 3. The ends of the friction, from where the sum of both would be the same.
  const auto guess = [&](std::size_t i) {
    const double K = unit::kPerCentimetre;
    return at.ln_B + std::log((K + 0.5 * fit.hysteresis_ratio[1]) / (K + 0.5 * fit.hysteresis_ratio[i]));
  };
  for (const std::size_t i : {0U, 2U}) {
    fit.rigidity[i] = std::exp(search_near(drape, measured, fit.hysteresis_ratio[i], guess(i), slope).ln_B);
  }
  fit.apparent = std::numeric_limits<double>::quiet_NaN();
  fit.runs = drape.runs();
  return fit;
}

void put_bending(Fabric& fabric, Direction direction, const BendingFit& fit, const std::string& test) {
  BendingMeasurement& bending = fabric.bending[static_cast<std::size_t>(direction)];
  const auto per_cm = [](double ratio) {
    char text[40];
    std::snprintf(text, sizeof text, "%.3g", ratio / unit::kPerCentimetre);
    return std::string(text);
  };
  const std::string range =
      per_cm(fit.hysteresis_ratio[0]) + " to " + per_cm(fit.hysteresis_ratio[2]) + " /cm";
  bending.B = {to_four_digits(fit.B(), unit::kGfCm2PerCm),
               {ProvenanceKind::kFitted, "fitted to " + test,
                percent(fit.low() / fit.B() - 1.0) + " to +" + percent(fit.high() / fit.B() - 1.0) +
                    ": 2HB is assumed, " + range + " times B; noise " + percent(fit.noise)}};
  bending.hysteresis_2HB = {
      to_four_digits(fit.hysteresis(), unit::kGfCmPerCm),
      {ProvenanceKind::kAssumed,
       per_cm(fit.hysteresis_ratio[1]) + " /cm times B by the fibre; B was fitted with it", "from " + range}};
}

}  // namespace fuai
