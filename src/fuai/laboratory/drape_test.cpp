// Runs specimens side by side and sums them up.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/drape_test.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

#include "fuai/core/error.h"
#include "fuai/runtime/parallel.h"
#include "fuai/runtime/shared_progress.h"
#include "fuai/runtime/thread_clock.h"

namespace fuai {
namespace {

using Index = std::size_t;

constexpr int kMostRuns = 1000;

void check(const DrapeTestOptions& o) {
  if (o.runs >= 1 && o.runs <= kMostRuns && o.band_seeds >= 0) return;
  throw Error(ErrorKind::kUsage, "a drape test needs 1 to " + std::to_string(kMostRuns) + " specimens", {},
              "take 5");
}

DrapeSample run_sample(const FabricLaws& laws, const ClothMaterial& material, const DrapeTestOptions& o,
                       std::uint64_t seed, const Progress& progress) {
  const double before = thread_seconds();
  DrapeSample sample;
  sample.seed = seed;
  const ClothModel model = make_drape_model(o.geometry, laws.areal_mass, seed, o.perturbation);
  const ClothState start = make_drape_start(o.geometry, model, seed, o.perturbation);
  sample.run = run_drape(o.geometry, model, material, start, o.method, progress);
  sample.cpu_seconds = thread_seconds() - before;
  return sample;
}

DrapeSpread spread_of(std::vector<double> each) {
  DrapeSpread spread;
  const auto count = static_cast<double>(each.size());
  spread.mean = std::accumulate(each.begin(), each.end(), 0.0) / count;
  spread.low = *std::ranges::min_element(each);
  spread.high = *std::ranges::max_element(each);
  double square = 0.0;
  for (double x : each) square += (x - spread.mean) * (x - spread.mean);
  spread.deviation =
      each.size() > 1 ? std::sqrt(square / (count - 1.0)) : std::numeric_limits<double>::quiet_NaN();
  spread.each = std::move(each);
  return spread;
}

/// One end of an assumption: its material and the specimens tried on it.
struct Trial {
  DrapeVariant variant;
  DrapeMaterial material;
  std::vector<DrapeSample> samples;

  /// Mean difference of DC against the first specimens of the test.
  double against(const std::vector<DrapeSample>& as_is) const {
    double sum = 0.0;
    for (Index i = 0; i < samples.size(); ++i)
      sum += samples[i].run.shadow.coefficient - as_is[i].run.shadow.coefficient;
    return sum / static_cast<double>(samples.size());
  }
};

std::vector<Trial> make_trials(const FabricLaws& laws, const DrapeTestOptions& o) {
  std::vector<Trial> trials;
  const auto seeds = static_cast<Index>(std::min(o.band_seeds, o.runs));
  const auto add = [&](DrapeVariant variant) {
    trials.push_back({variant, make_drape_material(laws, o.geometry.spacing, o.elastic, variant),
                      std::vector<DrapeSample>(seeds)});
  };
  if (seeds == 0) return trials;
  if (twist_is_assumed(laws)) add(DrapeVariant::kNoTwist), add(DrapeVariant::kMostTwist);
  if (shear_is_assumed(laws)) add(DrapeVariant::kLeastShear), add(DrapeVariant::kMostShear);
  return trials;
}

void run_all(const FabricLaws& laws, const DrapeMaterial& as_is, std::vector<Trial>& trials, DrapeTest& test,
             const Progress& progress) {
  const DrapeTestOptions& o = test.options;
  test.samples.resize(static_cast<Index>(o.runs));
  Index count = test.samples.size();
  for (const Trial& trial : trials) count += trial.samples.size();
  SharedProgress shared(progress, count);
  std::vector<std::function<void()>> tasks;
  const auto add = [&](const ClothMaterial& material, DrapeSample& sample, Index i, const char* name) {
    const Progress own = shared.of(tasks.size(), name);
    tasks.emplace_back([&, i, own] {
      sample = run_sample(laws, material, o, o.seed + i, own);
      if (own) own("", 1.0);
    });
  };
  for (Index i = 0; i < test.samples.size(); ++i) add(as_is.material, test.samples[i], i, "specimens");
  for (Trial& trial : trials) {
    for (Index i = 0; i < trial.samples.size(); ++i)
      add(trial.material.material, trial.samples[i], i, "what was assumed");
  }
  run_parallel(tasks, o.threads);
}

void take_bands(const std::vector<Trial>& trials, DrapeTest& test) {
  for (Index i = 0; i + 1 < trials.size(); i += 2) {
    DrapeBand band;
    const bool twist = trials[i].variant == DrapeVariant::kNoTwist;
    band.key = twist ? "twist" : "shear";
    band.what = twist ? "twist stiffness from 0 to 0.5 sqrt(B warp B weft)"
                      : "shear stiffness from 0.3 to 2 gf/(cm deg)";
    band.at_least = trials[i].against(test.samples);
    band.at_most = trials[i + 1].against(test.samples);
    test.bands.push_back(band);
  }
  const double own = test.samples.size() > 1 ? test.coefficient.deviation : 0.0;
  double below = own * own, above = own * own;
  for (const DrapeBand& band : test.bands) {
    below += std::pow(std::min({band.at_least, band.at_most, 0.0}), 2);
    above += std::pow(std::max({band.at_least, band.at_most, 0.0}), 2);
  }
  test.band_low = test.coefficient.mean - std::sqrt(below);
  test.band_high = test.coefficient.mean + std::sqrt(above);
}

std::vector<std::string> assumptions_of(const FabricLaws& laws, const DrapeMaterial& material, bool elastic) {
  std::vector<std::string> sentences = material.material.notes;
  for (const Direction direction : {Direction::kWarp, Direction::kWeft}) {
    const YarnLocking& yarn = material.locking[static_cast<Index>(direction)];
    if (!(yarn.factor < 1.0)) continue;
    sentences.push_back(std::string("tension along the ") + to_string(direction) + " capped from " +
                        std::to_string(std::lround(yarn.stiffness)) + " to " +
                        std::to_string(std::lround(yarn.limit)) +
                        " N/m: stiffer yarns would lock this lattice");
  }
  if (elastic) sentences.emplace_back("friction was left out");
  sentences.emplace_back("cloth that touches itself is not simulated");
  std::ranges::move(assumptions_of(laws), std::back_inserter(sentences));
  return sentences;
}

}  // namespace

bool DrapeTest::at_rest() const noexcept {
  return std::ranges::all_of(samples, [](const DrapeSample& s) { return s.run.at_rest; });
}

double DrapeTest::residual() const noexcept {
  double largest = 0.0;
  for (const DrapeSample& sample : samples) largest = std::max(largest, sample.run.residual);
  return largest;
}

const DrapeSample& DrapeTest::typical() const {
  return *std::ranges::min_element(samples, {}, [&](const DrapeSample& sample) {
    return std::abs(sample.run.shadow.coefficient - coefficient.mean);
  });
}

DrapeTest run_drape_test(const FabricLaws& laws, const DrapeTestOptions& options, const Progress& progress) {
  check(options);
  const auto begin = std::chrono::steady_clock::now();
  DrapeTest test;
  test.options = options;
  const DrapeMaterial as_is = make_drape_material(laws, options.geometry.spacing, options.elastic);
  test.locking = as_is.locking;
  std::vector<Trial> trials = make_trials(laws, options);
  run_all(laws, as_is, trials, test, progress);
  std::vector<double> coefficients, nodes;
  for (const DrapeSample& sample : test.samples) {
    coefficients.push_back(sample.run.shadow.coefficient);
    nodes.push_back(static_cast<double>(sample.run.shadow.nodes.size()));
    ++test.node_histogram[static_cast<int>(sample.run.shadow.nodes.size())];
  }
  test.coefficient = spread_of(std::move(coefficients));
  test.nodes = spread_of(std::move(nodes));
  take_bands(trials, test);
  test.assumptions = assumptions_of(laws, as_is, options.elastic);
  test.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return test;
}

DrapeConvergence run_drape_convergence(const FabricLaws& laws, const DrapeTestOptions& options,
                                       const Progress& progress) {
  DrapeConvergence convergence;
  std::vector<DrapeTestOptions> tests;
  for (const double factor : kConvergenceFactors) {
    DrapeTestOptions here = options;
    here.geometry.spacing *= factor;
    here.band_seeds = 0;
    if (fits(here.geometry)) tests.push_back(here);
  }
  for (Index i = 0; i < tests.size(); ++i) {
    // The finest takes most of the time.
    const auto shown = [&](std::string_view what, double fraction) {
      progress(what, std::pow((static_cast<double>(i) + fraction) / static_cast<double>(tests.size()), 2));
    };
    convergence.tests.push_back(run_drape_test(laws, tests[i], progress ? Progress(shown) : Progress()));
  }
  return convergence;
}

}  // namespace fuai
