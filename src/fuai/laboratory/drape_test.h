// The drape test: several specimens of a fabric, what they show, how far they scatter, and what the assumed
// numbers could change.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/drape.md.
//
//   tasks (independent, on `threads` threads): every seed as it is, the first band_seeds seeds of each
//   variant
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fuai/core/progress.h"
#include "fuai/fabric/laws.h"
#include "fuai/laboratory/drape_material.h"
#include "fuai/laboratory/drape_run.h"

namespace fuai {

/// What to run.
struct DrapeTestOptions {
  DrapeGeometry geometry;
  DrapeMethod method;
  DrapePerturbation perturbation;
  std::uint64_t seed = 0;  ///< of the first specimen; the others have the next ones
  int runs = 5;            ///< specimens
  bool elastic = false;    ///< without friction
  int band_seeds = 2;      ///< specimens that each end of an assumption is tried on; 0: no bands
  int threads = 0;         ///< 0: all cores; the results do not depend on it
};

/// One specimen.
struct DrapeSample {
  std::uint64_t seed = 0;
  DrapeRun run;
  double cpu_seconds = 0.0;  ///< of the thread that ran it
};

/// Of a number over the specimens.
struct DrapeSpread {
  double mean = 0.0, low = 0.0, high = 0.0;
  double deviation = 0.0;  ///< sample standard deviation; NaN for one specimen
  std::vector<double> each;
};

/// What an assumption could change: mean difference against the same specimens as they are.
struct DrapeBand {
  std::string what;       ///< "twist stiffness from 0 to 0.5 sqrt(B warp B weft)"
  std::string key;        ///< "twist"
  double at_least = 0.0;  ///< DC at the lower end of the assumption less DC as it is [-]
  double at_most = 0.0;   ///< the same at its upper end [-]
};

/// The result.
struct DrapeTest {
  DrapeTestOptions options;
  std::vector<DrapeSample> samples;  ///< by seed
  DrapeSpread coefficient;           ///< DC [-]
  DrapeSpread nodes;
  std::map<int, int> node_histogram;  ///< number of nodes -> specimens
  std::vector<DrapeBand> bands;
  /// Where DC of this fabric may lie: mean, less and plus the deviation and the bands, summed as squares [-].
  double band_low = 0.0, band_high = 0.0;
  std::array<YarnLocking, 2> locking;    ///< warp, weft
  std::vector<std::string> assumptions;  ///< plain sentences
  double seconds = 0.0;                  ///< of the wall clock

  bool at_rest() const noexcept;
  double residual() const noexcept;  ///< the largest [node weights]
  /// The specimen nearest to the mean, for pictures.
  const DrapeSample& typical() const;
};

/// Runs the test. @throws Error (kUsage) for options out of range, as run_drape(). Thread class: set-up.
DrapeTest run_drape_test(const FabricLaws& laws, const DrapeTestOptions& options,
                         const Progress& progress = {});

/// Below this mean the folds of a drape may touch, which is not simulated [-]: the drape study saw none touch
/// at 0.22 and above.
inline constexpr double kMayTouch = 0.22;

/// The same test at several spacings, coarse first; bands at none of them.
struct DrapeConvergence {
  std::vector<DrapeTest> tests;
};
/// Spacings of a convergence study against the one asked for.
inline constexpr double kConvergenceFactors[] = {2.0, 1.5, 1.0, 0.75};
/// Spacings that the specimen is too small for are left out. Thread class: set-up.
DrapeConvergence run_drape_convergence(const FabricLaws& laws, const DrapeTestOptions& options,
                                       const Progress& progress = {});

}  // namespace fuai
