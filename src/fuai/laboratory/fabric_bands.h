// How far the drape coefficient and the bending moment of a fabric are known.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/fits.md.
//
//   sample i: a fabric drawn with seed + i on a specimen of seed + i, beside the fabric as it is on the same
//   specimen; the differences are what the numbers carry, the fabric as it is shows what specimens do
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fuai/core/progress.h"
#include "fuai/laboratory/fabric_draws.h"

namespace fuai {

/// A number over the samples.
struct SampleBand {
  double as_it_is = 0.0;         ///< mean over the same specimens of the fabric as it is
  double mean = 0.0;             ///< over the drawn fabrics
  double deviation = 0.0;        ///< over the drawn fabrics, specimens included
  double low = 0.0, high = 0.0;  ///< 5 and 95 % of the drawn fabrics
  double carried = 0.0;  ///< root mean square of the differences of drawn and as it is: the numbers alone
};

/// What to run.
struct FabricBandOptions {
  DrapeGeometry geometry;
  int samples = 20;   ///< 2 to 1000; moments take ten times as many
  bool drape = true;  ///< without: moments alone. B that was fitted to a drape goes with what was assumed
                      ///< then, which is not known any more
  std::uint64_t seed = 0;
  int threads = 0;
};

/// The result.
struct FabricBands {
  bool drape = true;
  SampleBand drape_coefficient;      ///< [-]
  std::array<SampleBand, 2> moment;  ///< warp, weft: bending moment at 1 1/cm on the way out of the
                                     ///< KES cycle [N]
  std::vector<std::string> drawn;    ///< plain sentences
  bool at_rest = true;               ///< every specimen
};

/// @throws Error (kUsage) for options out of range, as run_drape_test(). Thread class: set-up.
FabricBands find_fabric_bands(const Fabric& fabric, const FabricUncertainty& uncertainty,
                              const FabricBandOptions& options, const Progress& progress = {});

/// Bending moment at 1 1/cm on the way out of a steady KES cycle: elastic part plus friction [N].
double kes_moment(const PlayLaw& law) noexcept;

/// Mean, deviation and quantiles. @param drawn, as_it_is of the same length, at least two. Thread class: any.
SampleBand band_of(const std::vector<double>& drawn, const std::vector<double>& as_it_is);

}  // namespace fuai
