// Time of one step of the paper's relaxation on its 18 x 18 drape; the label is the state hash after 1000
// steps.
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "fuai/core/hash.h"
#include "fuai/scenes/paper_drape.h"
#include "support/linear_laws.h"

namespace {

using namespace fuai;

void relax(benchmark::State& bench, PaperMode mode, double HB_gf_cm_per_cm) {
  PaperDrapeOptions options;
  options.relaxation.mode = mode;
  PaperDrape drape = make_paper_drape(fuai_test::linear_laws(0.12, HB_gf_cm_per_cm, 200.0), options);
  for (int k = 0; k < 1000; ++k) drape.solver.step(drape.state);
  StateHash hash;
  for (const Vec3& x : drape.state.positions) hash.add(x.data(), sizeof(double) * 3);
  bench.SetLabel("hash " + hash.hex());
  // As in run(): the state stays in the solver for a hundred steps.
  RelaxationStop stop;
  stop.max_steps = 100;
  stop.tolerance = 0.0;
  for (auto _ : bench) benchmark::DoNotOptimize(drape.solver.run(drape.state, stop).residual);
  bench.counters["step"] =
      benchmark::Counter(100.0, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(relax, elastic, PaperMode::kCorrected, 0.0);
BENCHMARK_CAPTURE(relax, with_memory, PaperMode::kCorrected, 0.04);
BENCHMARK_CAPTURE(relax, as_printed, PaperMode::kAsPrinted, 0.04);

}  // namespace
