// Samples a fabric within what is not known of it.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/fabric_bands.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "fuai/core/error.h"
#include "fuai/laboratory/drape_test.h"
#include "fuai/runtime/parallel.h"
#include "fuai/runtime/shared_progress.h"

namespace fuai {
namespace {

using Index = std::size_t;

/// Linear between the sorted values.
double quantile(const std::vector<double>& sorted, double part) {
  const double at = part * static_cast<double>(sorted.size() - 1);
  const auto below = std::min(static_cast<Index>(at), sorted.size() - 2);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// One specimen of a fabric.
struct OneDrape {
  double coefficient = 0.0;
  bool at_rest = true;
};

/// Every drawn fabric and the fabric as it is, on the same specimens. @return whether all came to rest
bool drape_all(const std::vector<FabricLaws>& drawn, const FabricLaws& as_it_is,
               const FabricBandOptions& options, SampleBand& band, const Progress& progress) {
  const Index count = drawn.size();
  std::vector<OneDrape> done(2 * count);
  std::vector<std::function<void()>> tasks;
  SharedProgress shared(progress, done.size());
  for (Index i = 0; i < done.size(); ++i) {
    const Progress own = shared.of(i, "drape bands");
    tasks.emplace_back([&, i, own] {
      DrapeTestOptions test;
      test.geometry = options.geometry;
      test.runs = 1;
      test.seed = options.seed + i % count;
      test.threads = 1;
      test.band_seeds = 0;
      const DrapeTest one = run_drape_test(i < count ? drawn[i] : as_it_is, test, own);
      done[i] = {one.coefficient.mean, one.at_rest()};
      if (own) own("", 1.0);
    });
  }
  run_parallel(tasks, options.threads);
  std::vector<double> with, without;
  for (Index i = 0; i < done.size(); ++i) (i < count ? with : without).push_back(done[i].coefficient);
  band = band_of(with, without);
  return std::ranges::all_of(done, [](const OneDrape& one) { return one.at_rest; });
}

}  // namespace

double kes_moment(const PlayLaw& law) noexcept {
  constexpr double kCurvature = unit::kPerCentimetre;
  return law.elastic().evaluate(kCurvature).value + law.friction().evaluate(kCurvature).value;
}

SampleBand band_of(const std::vector<double>& drawn, const std::vector<double>& as_it_is) {
  SampleBand band;
  const auto count = static_cast<double>(drawn.size());
  band.as_it_is = mean_of(as_it_is);
  band.mean = mean_of(drawn);
  double square = 0.0, difference = 0.0;
  for (Index i = 0; i < drawn.size(); ++i) {
    square += std::pow(drawn[i] - band.mean, 2);
    difference += std::pow(drawn[i] - as_it_is[i], 2);
  }
  band.deviation = std::sqrt(square / (count - 1.0));
  band.carried = std::sqrt(difference / count);
  std::vector<double> sorted = drawn;
  std::ranges::sort(sorted);
  band.low = quantile(sorted, 0.05);
  band.high = quantile(sorted, 0.95);
  return band;
}

FabricBands find_fabric_bands(const Fabric& fabric, const FabricUncertainty& uncertainty,
                              const FabricBandOptions& options, const Progress& progress) {
  constexpr int kMostSamples = 1000;
  if (options.samples < 2 || options.samples > kMostSamples || !(uncertainty.scatter >= 0.0) ||
      uncertainty.scatter > 1.0) {
    throw Error(ErrorKind::kUsage, "bands need 2 to 1000 samples and a scatter of 0 to 100 %", {},
                "take 20 samples and 10 %");
  }
  constexpr Index kMomentFactor = 10;  // moments cost nothing
  const auto count = static_cast<Index>(options.samples);
  const FabricLaws as_it_is = make_fabric_laws(fabric);
  std::array<std::vector<double>, 2> moments;
  std::vector<FabricLaws> drawn;
  for (Index i = 0; i < kMomentFactor * count; ++i) {
    FabricLaws laws = make_fabric_laws(draw_fabric(fabric, uncertainty, options.seed + i));
    for (const Index d : {0U, 1U}) moments[d].push_back(kes_moment(laws.bending[d]));
    if (i < count) drawn.push_back(std::move(laws));
  }
  FabricBands bands;
  for (const Index d : {0U, 1U}) {
    bands.moment[d] =
        band_of(moments[d], std::vector<double>(moments[d].size(), kes_moment(as_it_is.bending[d])));
  }
  bands.drape = options.drape;
  if (options.drape) bands.at_rest = drape_all(drawn, as_it_is, options, bands.drape_coefficient, progress);
  bands.drawn = drawn_numbers(fabric, uncertainty, options.drape);
  return bands;
}

}  // namespace fuai
