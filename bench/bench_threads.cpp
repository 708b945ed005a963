// Times one tick on one and on two threads, taking turns.
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "bench_engine.h"
#include "fuai/runtime/spin_team.h"
#include "fuai/solver/implicit.h"
#include "taut_patch.h"
#include "thread_clock.h"

namespace fuai_bench {
namespace {

using namespace fuai;

constexpr int kThreads = 2, kIterations = 8, kTicksATurn = 10;

/// The same sheet on one thread and on a team; wall-clock microseconds a tick, turn by turn.
struct Pair {
  explicit Pair(int side) : model(two_corner_square(side)) {
    ImplicitOptions options;
    options.iterations = kIterations;
    options.linearisations = 1;
    for (auto* solver : {&alone, &together})
      *solver = std::make_unique<SolverImplicit<float>>(model, bench_material(), options);
    together->set_team(&team);
  }

  static double turn(SolverImplicit<float>& solver) {
    solver.step(kTick);  // warms the caches
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kTicksATurn; ++i) solver.step(kTick);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
    return took.count() / kTicksATurn;
  }

  std::string hash(const SolverImplicit<float>& solver) const {
    ClothState state = make_cloth_state(model);
    solver.save(state);
    return hash_of(state.positions);
  }

  ClothModel model;
  SpinTeam team{kThreads};
  std::unique_ptr<SolverImplicit<float>> alone, together;
};

Row measure(int side, int turns) {
  Pair pair(side);
  std::vector<double> one, two, gain;
  for (int i = 0; i < turns; ++i) {
    one.push_back(Pair::turn(*pair.alone));
    two.push_back(Pair::turn(*pair.together));
    gain.push_back(one.back() / two.back());
  }
  const Spread of_two = spread(two), of_gain = spread(gain);
  const std::string hash = pair.hash(*pair.alone);
  return {std::to_string(side) + " x " + std::to_string(side),
          short_text(spread(one).median),
          short_text(of_two.median),
          short_text(of_two.p10) + " to " + short_text(of_two.p90),
          fixed_text(of_gain.median, 2),
          fixed_text(of_gain.p10, 2) + " to " + fixed_text(of_gain.p90, 2),
          hash + (hash == pair.hash(*pair.together) ? ", the same" : ", ANOTHER on two")};
}

}  // namespace

void report_threads(Report& report, bool quick) {
  report.heading("Two threads");
  report.paragraph(
      "The sheet of the table above, 8 iterations, on one thread and on two, wall-clock time, in turns. "
      "Whatever "
      "else runs on the machine's cores counts here.");
  std::vector<Row> rows;
  for (const int side : {64, 100, 128, 200}) rows.push_back(measure(side, (quick ? 10 : 60)));
  report.table({"nodes", "us a tick, one", "two", "p10 to p90", "gain", "p10 to p90", "state hash"}, rows);
}

}  // namespace fuai_bench
