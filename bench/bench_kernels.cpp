// Times the kernels of one implicit tick and compares them with the limits of the machine.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "bench_engine.h"
#include "fuai/solver/implicit.h"
#include "fuai/solver/implicit_kernels.h"
#include "fuai/solver/implicit_storage.h"
#include "taut_patch.h"
#include "thread_clock.h"

namespace fuai_bench {
namespace {

using namespace fuai;
using Grid = ImplicitGrid<float>;

constexpr int kIterations = 8;

/// Arithmetic and traffic of a kernel at one node inside the cloth, counted from the formulas with the
/// material of the bench (one play element a law, B12 = 0).
///
/// flops: add, multiply, minimum, maximum, quotient and root count 1, a fused multiply-add 2, comparisons 0.
///   law             29 + 8 a play element = 37
///   evaluate        edge vectors 12, two tensions 2 (33 + law), bending 209 + 2 law, shear and twist
///                   120 + law, inertia, weight and air 68, collecting 51
///   multiply        differences and dots 40, products with axes and sides 38, normals 6, shear 29, twist 13,
///                   ground and air 16, collecting 48, mask and sum 9
///   assemble        shared diagonal 186, ends 60, links 108, masks 20
///   factor          sandwich 111, inverse 35
///   solve           forward 33, backward 33
///   average, advance, direct   12, 18, 6
///   commit          4 a play element
/// numbers: each array of the grid that it reads or writes once, read and written twice; scratch that stays
/// in the first-level cache counts nothing.
///   evaluate        x xn v 9, areas and shapes 10, strains n 2, memory 5; out: force 3, strains 5
///   linearising     and out: ground, air, axes 6, sides 2, normal 3, stiffness 2, shear 6
///   assemble        reads those 21 and mobile, cell area; out: 24
///   factor          inverse 6 in and out, links 6
///   solve           blocks 12 twice, right side 3, result 3 out, in and out again
///   multiply        the 21, p 3, cell area, mobile; q 3 out
struct KernelCost {
  double flops, numbers;
};
constexpr double kLaw = 37.0;
constexpr double kEvaluateFlops = 12.0 + 66.0 + 209.0 + 120.0 + 68.0 + 51.0 + 5.0 * kLaw;

struct KernelRun {
  std::string name;
  double calls;  ///< a tick without guards that shorten: one linearisation, kIterations iterations
  KernelCost cost;
  std::function<void()> run;
  std::vector<double> seconds{};
};

/// The arrays of a cloth in motion, and the kernels over all of them.
class TickKernels {
 public:
  explicit TickKernels(int side)
      : model_(two_corner_square(side)),
        material_(bench_material()),
        storage_(model_, material_, k_.lanes),
        g_(storage_.grid()),
        scratch_(make_vector_block<float>(static_cast<std::size_t>(k_.scratch_size(g_)))) {
    fill(moving_state());
    step_.dt = static_cast<float>(kTick);
    step_.inverse_dt = static_cast<float>(1.0 / kTick);
    step_.inertia = static_cast<float>((1.0 + material_.mass_drag * kTick) / (kTick * kTick));
    step_.velocity_gain = static_cast<float>(kTick / (1.0 + material_.mass_drag * kTick));
    step_.gravity_dt[2] = static_cast<float>(-kStandardGravity * kTick);
  }

  /// In the order of a tick, so that a kernel finds the caches as it does there.
  std::vector<KernelRun> list() {
    const int rows = g_.rows, columns = g_.columns, down = vectors(rows), across = vectors(columns);
    std::vector<KernelRun> list;
    list.push_back(
        {"evaluate, linearise", 1, {kEvaluateFlops, 55}, [this] { evaluate(Evaluation::kLinearise); }});
    list.push_back(
        {"assemble", 1, {374, 47}, [this, down] { k_.assemble(g_, storage_.constants(), true, 0, down); }});
    list.push_back({"factor_warp", 1, {146, 18}, [this, across] {
                      k_.factor_warp(g_, 0, 0, across);
                      k_.factor_warp(g_, 1, 0, across);
                      k_.factor_meeting(g_, 0, across);
                    }});
    list.push_back({"factor_weft", 1, {146, 18}, [this, down] { k_.factor_weft(g_, 0, down); }});
    list.push_back({"begin_solve", 1, {9, 13}, [this, rows] { k_.begin_solve(g_, 0, rows); }});
    list.push_back({"solve_warp", kIterations, {72, 45}, [this, across] {
                      for (int half : {0, 1}) k_.solve_warp_in(g_, kAlpha, half, 0, across);
                      for (int half : {1, 0}) k_.solve_warp_out(g_, half, 0, across);
                    }});
    list.push_back(
        {"solve_weft", kIterations, {78, 33}, [this, down] { k_.solve_weft(g_, scratch_.get(), 0, down); }});
    list.push_back(
        {"direct", kIterations, {12, 15}, [this, rows] { k_.direct(g_, kAlpha, kBeta, 0, rows); }});
    list.push_back({"multiply", kIterations, {196, 38}, [this, rows] {
                      k_.multiply(g_, storage_.constants(), 0, rows);
                    }});
    list.push_back({"advance", 1, {6, 9}, [this, rows] { k_.advance(g_, kAlpha, 0, rows); }});
    list.push_back({"move", 1, {6, 9}, [this, rows] { k_.move(g_, 0.F, 0, rows); }});
    list.push_back({"evaluate, force", 1, {kEvaluateFlops, 34}, [this] { evaluate(Evaluation::kForces); }});
    list.push_back({"commit", 1, {20, 17}, [this, rows] { k_.commit(g_, storage_.constants(), 0, rows); }});
    list.push_back(
        {"finish", 1, {40, 24}, [this, rows] { k_.finish(g_, storage_.constants(), step_, 0, rows); }});
    return list;
  }

  std::size_t bytes() const { return storage_.bytes(); }

 private:
  // Fixed instead of computed: the preconditioned matrix has its eigenvalues well below 4, so that the
  // residual shrinks and no number runs away.
  static constexpr float kAlpha = 0.5F, kBeta = 0.1F;

  int vectors(int count) const { return (count + k_.lanes - 1) / k_.lanes; }
  void evaluate(Evaluation what) { k_.evaluate(g_, storage_.constants(), step_, what, 0, g_.rows); }

  /// A tenth of a second after the release.
  ClothState moving_state() const {
    SolverImplicit<float> solver(model_, material_, {});
    for (int i = 0; i < 100; ++i) solver.step(kTick);
    ClothState state = make_cloth_state(model_);
    solver.save(state);
    return state;
  }

  void fill(const ClothState& state) {
    const auto put = [](const Field3<float>& field, std::ptrdiff_t p, const Vec3& value) {
      field.x[p] = static_cast<float>(value.x());
      field.y[p] = static_cast<float>(value.y());
      field.z[p] = static_cast<float>(value.z());
    };
    for (int row = 0; row < g_.rows; ++row) {
      for (int column = 0; column < g_.columns; ++column) {
        const auto slot = static_cast<std::size_t>(model_.slot(column, row));
        const std::ptrdiff_t p = g_.index(column, row);
        put(g_.x, p, state.positions[slot]);
        put(g_.v, p, state.velocities[slot]);
        put(g_.xn, p, state.positions[slot] - kTick * state.velocities[slot]);
      }
    }
  }

  const ImplicitKernels<float>& k_ = implicit_kernels<float>();
  ClothModel model_;
  ClothMaterial material_;
  ImplicitStorage<float> storage_;
  Grid g_;
  ImplicitStepConstants<float> step_;
  VectorBlock<float> scratch_;
};

/// One tick kernel by kernel; those of the iteration take turns.
void run_tick(std::vector<KernelRun>& kernels) {
  const auto timed = [](KernelRun& kernel) {
    const double start = thread_seconds();
    kernel.run();
    kernel.seconds.push_back(thread_seconds() - start);
  };
  for (std::size_t i = 0; i < kernels.size();) {
    std::size_t end = i;
    while (end < kernels.size() && kernels[end].calls > 1.0) ++end;
    if (end == i) {
      timed(kernels[i++]);
      continue;
    }
    for (int round = 0; round < kIterations; ++round) {
      for (std::size_t j = i; j < end; ++j) timed(kernels[j]);
    }
    i = end;
  }
}

/// Cost of asking for the time [s].
double clock_seconds() {
  std::vector<double> seconds;
  for (int i = 0; i < 1000; ++i) {
    const double start = thread_seconds();
    seconds.push_back(thread_seconds() - start);
  }
  return spread(seconds).median;
}

/// The limit of the measured array nearest in size to what a kernel goes through.
const Bandwidth& bandwidth_for(const MachineLimits& limits, double bytes) {
  const auto distance = [bytes](const Bandwidth& b) {
    return std::abs(std::log(bytes / static_cast<double>(b.bytes)));
  };
  return *std::min_element(limits.bandwidths.begin(), limits.bandwidths.end(),
                           [&](const Bandwidth& a, const Bandwidth& b) { return distance(a) < distance(b); });
}

/// Per node: what was measured, and the least that the machine's limits allow [ns].
struct Times {
  double measured = 0.0, arithmetic = 0.0, memory = 0.0;
};

Row kernel_row(const std::string& name, double calls, const Times& once, const KernelCost& cost) {
  return {name,
          fixed_text(calls, 0),
          fixed_text(once.measured, 2),
          fixed_text(once.measured * calls, 1),
          fixed_text(cost.flops, 0),
          fixed_text(cost.numbers * sizeof(float), 0),
          fixed_text(100.0 * once.arithmetic / once.measured, 0) + " %",
          fixed_text(100.0 * once.memory / once.measured, 0) + " %"};
}

void report_side(Report& report, const MachineLimits& limits, int side, int ticks) {
  TickKernels tick(side);
  std::vector<KernelRun> kernels = tick.list();
  for (int i = 0; i < ticks; ++i) run_tick(kernels);
  const double nodes = static_cast<double>(side) * side, clock = clock_seconds();
  const double bytes = static_cast<double>(tick.bytes());
  Times sum;
  KernelCost sum_cost{0.0, 0.0};
  std::vector<Row> rows;
  for (const KernelRun& kernel : kernels) {
    const double traffic = kernel.cost.numbers * sizeof(float);
    const Times once{1e9 * (spread(kernel.seconds).median - clock) / nodes,
                     1e9 * kernel.cost.flops / limits.flops_per_second,
                     1e9 * traffic / bandwidth_for(limits, traffic * nodes).bytes_per_second};
    rows.push_back(kernel_row(kernel.name, kernel.calls, once, kernel.cost));
    sum.measured += kernel.calls * once.measured;
    sum.arithmetic += kernel.calls * once.arithmetic;
    sum.memory += kernel.calls * once.memory;
    sum_cost.flops += kernel.calls * kernel.cost.flops;
    sum_cost.numbers += kernel.calls * kernel.cost.numbers;
  }
  rows.push_back(kernel_row("sum, " + std::to_string(kIterations) + " iterations", 1, sum, sum_cost));
  report.paragraph(std::to_string(side) + " x " + std::to_string(side) + " nodes, " +
                   fixed_text(bytes / nodes, 0) + " B a node:");
  report.table({"kernel", "calls", "ns a node a call", "ns a node a tick", "flops a node", "B a node",
                "of arithmetic", "of memory"},
               rows);
}

}  // namespace

void report_kernels(Report& report, const MachineLimits& limits, bool quick) {
  report.heading("Kernels of a tick");
  report.paragraph(
      "Each kernel in the order of a tick with one linearisation and both guards silent, median of CPU times "
      "less the cost of the clock. Flops and bytes are counted from the formulas. The last two columns are "
      "the "
      "least time that the limits above allow over the measured one; the memory limit is that of the array "
      "nearest in size to what the kernel goes through, as much read as written, so that a kernel that "
      "mostly "
      "reads, or finds its rows in a nearer cache again, may pass 100 %.");
  for (int side : {64, 200}) report_side(report, limits, side, (side == 64 ? 400 : 60) / (quick ? 4 : 1));
}

}  // namespace fuai_bench
