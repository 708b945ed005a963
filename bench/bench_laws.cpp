// Times the laws: one evaluation with tangent and update of the memory, beside a bare table look-up.
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

#include "fuai/core/hash.h"
#include "fuai/fabric/identify.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/units/constants.h"

namespace {

using namespace fuai;

/// A five-element law on 251 nodes, as a measured loop gives it.
PlayLaw measured_like_law() {
  LoopNodes loop{-250.0, 250.0, {}, {}};
  for (int i = 0; i <= 250; ++i) {
    const double x = -250.0 + 2.0 * i;
    const double width = 2e-4 * std::tanh((250.0 - x) / 35.0) * std::tanh((250.0 + x) / 35.0);
    loop.up.push_back(1e-5 * x + width);
    loop.down.push_back(1e-5 * x - width);
  }
  return identify_loop(loop, smoothest_elements(loop), bending_outside(250.0, 3e3));
}

/// 1024 strains of a slow swing, a ripple on it: the elements stick and slip in turn.
std::vector<double> strains() {
  std::vector<double> x;
  for (int i = 0; i < 1024; ++i) x.push_back(200.0 * std::sin(0.0061 * i) + 8.0 * std::sin(0.7 * i));
  return x;
}

void law_advance(benchmark::State& bench, const PlayLaw& law) {
  const std::vector<double> x = strains();
  std::vector<PlayState> states(x.size());  // 1024 stencils, each with its own memory
  StateHash hash;
  double sum = 0.0;
  std::size_t shift = 0;
  for (auto _ : bench) {
    shift += 7;  // each stencil moves on along the swing, so that its elements slip now and then
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Response r = law.advance(x[(i + shift) % x.size()], states[i]);
      sum += r.stress + r.tangent;
    }
    benchmark::DoNotOptimize(sum);
  }
  // The hash is over one pass from virgin memory, so that it does not depend on the number of iterations.
  PlayState state;
  for (double strain : x) hash.add(law.advance(strain, state).stress);
  bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(x.size()));
  bench.SetLabel("state_hash " + hash.hex());
}

void table_lookup(benchmark::State& bench, const PlayLaw& law) {
  const std::vector<double> x = strains();
  double sum = 0.0;
  for (auto _ : bench) {
    for (double strain : x) sum += law.elastic().evaluate(strain).value;
    benchmark::DoNotOptimize(sum);
  }
  bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(x.size()));
}

}  // namespace

int main(int argc, char** argv) {
  const PlayLaw measured = measured_like_law();
  const PlayLaw scalar = make_bending_law(0.1 * unit::kGfCm2PerCm, 0.06 * unit::kGfCmPerCm, 3e3);
  benchmark::RegisterBenchmark("law_advance/measured_5_elements", law_advance, measured);
  benchmark::RegisterBenchmark("law_advance/scalars_3_elements", law_advance, scalar);
  benchmark::RegisterBenchmark("table_lookup_only", table_lookup, measured);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
