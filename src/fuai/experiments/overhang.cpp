// Searches for the overhang of a strip.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/overhang.h"

#include <algorithm>
#include <cmath>

#include "fuai/core/constants.h"
#include "fuai/core/error.h"
#include "fuai/experiments/elastica.h"

namespace fuai {
namespace {

constexpr double kShortest = 1e-3, kLongest = 2.0;      ///< overhang [m]
constexpr double kLargestAngle = 80.0 * unit::kDegree;  ///< steeper chords hardly tell lengths apart
constexpr double kAngleTolerance = 1e-4;                ///< of the chord [rad]: 0.01 % of the overhang
constexpr double kGrowth = 1.2;                         ///< of the length while the angle is not enclosed
constexpr int kMostRuns = 40;
constexpr int kElasticLoadSteps = 4;  ///< without friction the path makes no difference

/// A length and by how much its chord is too steep.
struct Point {
  double length, excess;
};

}  // namespace

OverhangResult find_overhang(const FabricLaws& laws, const CantileverOptions& options, double chord_angle,
                             const Progress& progress) {
  if (!(chord_angle > 0.0 && chord_angle <= kLargestAngle) || options.spacing != 0.0) {
    throw Error(
        ErrorKind::kUsage,
        "the chord of an overhang lies at more than 0 and at most 80 degrees below level, and its lattice "
        "grows with it",
        {}, "take 41.5deg, and leave the spacing out");
  }
  OverhangResult result;
  double hung = 0.0;
  const auto hang = [&](double length) {
    CantileverOptions here = options;
    here.length = hung = length;
    if (options.elastic) here.load_steps = std::min(options.load_steps, kElasticLoadSteps);
    result.cantilever = run_cantilever(laws, here);
    ++result.runs;
    if (progress) progress("overhang", std::min(0.95, result.runs / 10.0));
    return Point{length, result.cantilever.chord_angle - chord_angle};
  };
  // From where the elastic part of the law alone would hang so it encloses the angle; then false position
  // with every third step in the middle.
  const double weight = laws.areal_mass * kStandardGravity;
  const double rigidity = bending_rigidity(laws.bending[static_cast<std::size_t>(options.direction)]);
  const double start = std::cbrt(heavy_elastica_load(chord_angle) * rigidity / weight);
  Point low = hang(std::clamp(start, kShortest, kLongest)), high = low;
  while (high.excess < 0.0 && high.length < kLongest) {
    low = high;
    high = hang(std::min(kLongest, high.length * kGrowth));
  }
  while (low.excess > 0.0 && low.length > kShortest) {
    high = low;
    low = hang(std::max(kShortest, low.length / kGrowth));
  }
  if (low.excess > 0.0 || high.excess < 0.0)
    throw Error(ErrorKind::kCheckFailed, "no overhang of 1 mm to 2 m hangs at this angle", {},
                "the cloth may rise by its own curl; give a length instead");
  Point at = std::abs(low.excess) < std::abs(high.excess) ? low : high;
  while (std::abs(at.excess) > kAngleTolerance && result.runs < kMostRuns) {
    const double t = result.runs % 3 == 2 ? 0.5 : -low.excess / (high.excess - low.excess);
    at = hang(low.length + t * (high.length - low.length));
    (at.excess < 0.0 ? low : high) = at;
  }
  if (hung != at.length) hang(at.length);
  result.overhang = at.length;
  result.half_overhang = 0.5 * at.length;
  result.rigidity = laws.areal_mass * kStandardGravity * std::pow(result.half_overhang, 3);
  return result;
}

}  // namespace fuai
