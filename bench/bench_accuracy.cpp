// Force error and time on the taut patch: the implicit step against the explicit oracle.
// SPDX-License-Identifier: Apache-2.0
//
// Error: force_error() of the force on the grasped node at the end of each tick. The reference is the oracle
// with its substeps halved until two runs agree.
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "bench_engine.h"
#include "taut_patch.h"
#include "thread_clock.h"

namespace fuai_bench {
namespace {

using namespace fuai;

constexpr double kAgreement = 1e-3;  ///< of two references
constexpr int kMostHalvings = 3;     ///< of the reference's substep
constexpr double kWanted = 1e-2;     ///< force error that the time is asked for
constexpr int kTurn = 25;            ///< ticks a solver does before the next one has its turn

/// Forces on the grasp and times, tick by tick.
struct Trace {
  std::vector<Vec3> forces{};
  std::vector<double> microseconds{};
};

double largest(const std::vector<Vec3>& forces) {
  double most = 0.0;
  for (const Vec3& force : forces) most = std::max(most, force.norm());
  return most;
}

Trace run_explicit(const TautPatch& patch, int substeps, int ticks) {
  PatchOracle oracle(patch, substeps);
  Trace trace;
  for (int i = 1; i <= ticks; ++i) {
    const double start = thread_seconds();
    trace.forces.push_back(oracle.tick(i));
    trace.microseconds.push_back(1e6 * (thread_seconds() - start));
  }
  return trace;
}

/// The oracle at its longest stable substep, and the reference.
struct Oracle {
  int substeps = 0;
  Trace coarsest{};
  int reference_substeps = 0;
  std::vector<Vec3> reference{};
  double agreement = 0.0;  ///< of the last two
};

Oracle run_oracle(const TautPatch& patch, int ticks) {
  Oracle oracle;
  oracle.substeps = stable_substeps(patch);
  oracle.coarsest = run_explicit(patch, oracle.substeps, ticks);
  oracle.reference = oracle.coarsest.forces;
  oracle.reference_substeps = oracle.substeps;
  for (int i = 0; i < kMostHalvings; ++i) {
    oracle.reference_substeps *= 2;
    Trace finer = run_explicit(patch, oracle.reference_substeps, ticks);
    oracle.agreement = force_error(oracle.reference, finer.forces);
    oracle.reference = std::move(finer.forces);
    if (oracle.agreement < kAgreement) break;
  }
  return oracle;
}

/// One way to do the implicit step.
struct Runner {
  virtual ~Runner() = default;
  virtual void tick(int number) = 0;
  std::string name{};
  bool real_time = true;  ///< false: converged, to tell the step from the iteration
  Trace trace{};
  long evaluations = 0, iterations = 0;
};

template <class T>
struct ImplicitRunner : Runner {
  ImplicitRunner(const TautPatch& patch, const ImplicitOptions& options) : step(patch, options) {}
  void tick(int number) override {
    StepReport report;
    const double start = thread_seconds();
    const Vec3 force = step.tick(number, &report);
    trace.microseconds.push_back(1e6 * (thread_seconds() - start));
    trace.forces.push_back(force);
    evaluations += report.evaluations;
    iterations += report.iterations;
  }
  PatchStep<T> step;
};

template <class T>
std::unique_ptr<Runner> make_runner(const TautPatch& patch, const ImplicitOptions& options,
                                    const std::string& name) {
  auto runner = std::make_unique<ImplicitRunner<T>>(patch, options);
  runner->name = name;
  return runner;
}

std::vector<std::unique_ptr<Runner>> make_runners(const TautPatch& patch) {
  std::vector<std::unique_ptr<Runner>> runners;
  for (Preconditioner preconditioner : {Preconditioner::kYarnLines, Preconditioner::kBlocks}) {
    const bool lines = preconditioner == Preconditioner::kYarnLines;
    for (int iterations : {3, 5, 8, 12, 20}) {
      ImplicitOptions options;
      options.preconditioner = preconditioner;
      options.iterations = iterations;
      options.linearisations = 1;
      runners.push_back(make_runner<float>(
          patch, options,
          (lines ? "yarn lines, " : "blocks, ") + std::to_string(iterations) + " iterations"));
    }
  }
  ImplicitOptions twice;
  runners.push_back(make_runner<float>(patch, twice, "yarn lines, 8, a second time when it pays"));
  ImplicitOptions converged;
  converged.iterations = 200;
  converged.linearisations = 10;
  converged.relinearise = 1e-5;
  runners.push_back(make_runner<double>(patch, converged, "converged (double, up to 10 x 200)"));
  runners.back()->real_time = false;
  return runners;
}

Row accuracy_row(const std::string& name, const Trace& trace, const Oracle& oracle, double nodes,
                 const std::string& work) {
  const Spread time = spread(trace.microseconds);
  return {name,
          fixed_text(100.0 * force_error(trace.forces, oracle.reference), 2) + " %",
          short_text(time.median),
          short_text(time.p10) + " to " + short_text(time.p90),
          short_text(1e3 * time.median / nodes),
          work};
}

void report_patch(Report& report, int side, double spacing, int ticks) {
  const TautPatch patch = make_taut_patch(side, spacing);
  const Oracle oracle = run_oracle(patch, ticks);
  const std::vector<std::unique_ptr<Runner>> runners = make_runners(patch);
  for (int first = 1; first <= ticks; first += kTurn) {
    for (const auto& runner : runners) {
      for (int i = first; i < std::min(first + kTurn, ticks + 1); ++i) runner->tick(i);
    }
  }
  const double nodes = static_cast<double>(side) * side;
  std::vector<Row> rows;
  const Runner* cheapest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& runner : runners) {
    const double count = ticks;
    rows.push_back(
        accuracy_row(runner->name, runner->trace, oracle, nodes,
                     fixed_text(static_cast<double>(runner->evaluations) / count, 2) + " evaluations, " +
                         fixed_text(static_cast<double>(runner->iterations) / count, 1) + " iterations"));
    const double median = spread(runner->trace.microseconds).median;
    if (runner->real_time && force_error(runner->trace.forces, oracle.reference) <= kWanted &&
        median < least) {
      least = median;
      cheapest = runner.get();
    }
  }
  rows.push_back(accuracy_row("explicit oracle (double)", oracle.coarsest, oracle, nodes,
                              std::to_string(oracle.substeps) + " substeps"));
  rows.push_back({"Bullet soft body", "-", "-", "-", "-", "gives no force at a held node"});
  rows.push_back({"the paper's relaxation", "-", "-", "-", "-", "no time in it"});
  report.paragraph(std::to_string(side) + " x " + std::to_string(side) + " nodes at " +
                   short_text(1e3 * spacing) + " mm, " + fixed_text(ticks * kTick, 2) + " s, largest force " +
                   fixed_text(largest(oracle.reference), 2) + " N; reference with " +
                   std::to_string(oracle.reference_substeps) + " substeps, half as many differ by " +
                   fixed_text(100.0 * oracle.agreement, 3) + " %:");
  report.table({"step of 1 ms", "force error", "us a tick", "p10 to p90", "ns a node", "a tick has"}, rows);
  const double explicit_time = spread(oracle.coarsest.microseconds).median;
  report.paragraph(cheapest == nullptr ? "No real-time step reaches 1 % force error."
                                       : "Time to 1 % force error: " + short_text(least) + " us a tick (" +
                                             cheapest->name + "), " + fixed_text(explicit_time / least, 0) +
                                             " times less than the explicit oracle.");
}

}  // namespace

void report_accuracy(Report& report, bool quick) {
  report.heading("Accuracy and time");
  report.paragraph(
      "The scene taut_patch: top row held with 5 % slack, the middle of the bottom row moved twice a second "
      "to and fro "
      "with a tremor at 8 Hz. Root mean square error of the force at the moved node against the explicit "
      "oracle; single precision and one linearisation unless said.");
  constexpr double kFine = 0.0025;
  report_patch(report, 32, kSpacing, quick ? 300 : 500);
  if (quick) return;
  report_patch(report, 64, kSpacing, 500);
  report_patch(report, 32, kFine, 300);
}

}  // namespace fuai_bench
