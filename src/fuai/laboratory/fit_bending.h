// Bending rigidity from what a laboratory has without a bending tester: the overhang of a strip, or the drape
// coefficient.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/fits.md.
//
// Neither test can tell rigidity from friction: on the way into its shape the cloth feels both. 2HB / B is
// therefore assumed, and everything is done three times, at the ends of that assumption and at its rule.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "fuai/core/progress.h"
#include "fuai/fabric/fabric.h"
#include "fuai/laboratory/drape_test.h"

namespace fuai {

/// Repeated readings of one number.
struct Readings {
  double mean = 0.0;
  double error = 0.0;  ///< standard deviation of the mean; 0 for a single reading
  int count = 0;
};
/// @param values at least one. Thread class: any.
Readings readings_of(std::span<const double> values);

/// A rigidity and what it depends on.
struct BendingFit {
  /// B [N m] with the least, the rule's and the largest 2HB / B.
  std::array<double, 3> rigidity{};
  /// 2HB / B [1/m] of the three.
  std::array<double, 3> hysteresis_ratio{};
  double apparent = 0.0;  ///< what a law without friction would need [N m]
  double noise = 0.0;     ///< deviation of ln B from the scatter of readings and specimens
  int runs = 0;           ///< specimens or strips that were simulated

  double B() const noexcept { return rigidity[1]; }
  double hysteresis() const noexcept { return rigidity[1] * hysteresis_ratio[1]; }
  /// B at a place between the ends of the assumption: -1 least, 0 rule, 1 largest friction. [N m]
  double at(double place) const noexcept;
  /// 2HB / B there [1/m].
  double ratio_at(double place) const noexcept;
  /// B less and plus the noise and the ends of the assumption, summed as squares [N m].
  double low() const noexcept;
  double high() const noexcept;
};

/// The ends of the assumption and its rule: see hysteresis_rule() and assumed::kHysteresisSpread. [1/m]
std::array<double, 3> hysteresis_ratios(const Fabric& fabric);

/// B of the virgin strip that hangs with this overhang.
/// @param fabric its mass, thickness and composition  @param overhang [m]  @param chord_angle below level
/// [rad]
/// @throws Error (kBadInput) without a mass, for readings that no cloth gives, (kUsage) for an angle outside
/// 5 to 80 degrees. Thread class: set-up.
BendingFit fit_bending_to_overhang(const Fabric& fabric, const Readings& overhang, double chord_angle);

/// How a fit to a drape is run.
struct DrapeFitOptions {
  DrapeGeometry geometry;
  int runs = 5;  ///< specimens at each rigidity, seeds `seed` and on, the same at each
  std::uint64_t seed = 0;
  int threads = 0;
};

/// One B for both yarn directions whose mean drape coefficient is the measured one, everything else as
/// assumed. The noise has the readings, the specimens, and the bands of twist and shear.
/// @param coefficient DC [-]
/// @throws Error (kBadInput) without a mass, (kCheckFailed) when no B between bending lengths of 0.08 and 0.8
/// of the overhang drapes so. Thread class: set-up.
BendingFit fit_bending_to_drape(const Fabric& fabric, const Readings& coefficient,
                                const DrapeFitOptions& options, const Progress& progress = {});

/// The fabric with B and 2HB of a direction put in: kinds fitted and assumed, sources and intervals in words.
/// @param test "the overhang of a strip, 3 readings". Thread class: any.
void put_bending(Fabric& fabric, Direction direction, const BendingFit& fit, const std::string& test);

}  // namespace fuai
