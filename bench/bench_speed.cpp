// Times one tick of every solver on the same lattice, taking turns.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "bench_engine.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/solver/explicit.h"
#include "fuai/solver/implicit.h"
#include "fuai/solver/relaxation.h"
#include "support/linear_laws.h"
#include "taut_patch.h"
#include "thread_clock.h"
#ifdef FUAI_BENCH_BULLET
#include "bullet_cloth.h"
#endif

namespace fuai_bench {
namespace {

using namespace fuai;

/// One solver on one lattice.
struct Contender {
  std::string name;
  int side = 0;
  int batch = 10;                      ///< ticks a turn that are timed; one before them only warms the caches
  double ticks_a_call = 1.0;           ///< of run
  std::function<void()> run;           ///< advances the cloth
  std::function<std::string()> hash;   ///< of the positions
  std::function<std::string()> extra;  ///< a remark
  double bytes = 0.0;                  ///< 0: not said
  int yardstick = 0;                   ///< 1: others are compared with it, 2: as the patch of the demos
  std::vector<double> microseconds{};  ///< a tick
  long calls = 0;
};

/// Totals over the ticks of an implicit solver.
struct ImplicitRun {
  explicit ImplicitRun(const ClothModel& model, const ClothMaterial& material, const ImplicitOptions& options)
      : solver(model, material, options) {}
  SolverImplicit<float> solver;
  long ticks = 0, evaluations = 0;
};

Contender implicit_contender(int side, int iterations, const ClothMaterial& material,
                             const std::string& name) {
  const ClothModel model = two_corner_square(side);
  ImplicitOptions options;
  options.iterations = iterations;
  options.linearisations = 1;
  const auto run = std::make_shared<ImplicitRun>(model, material, options);
  Contender c;
  c.name = name;
  c.side = side;
  c.bytes = static_cast<double>(run->solver.bytes());
  c.run = [run] {
    run->evaluations += run->solver.step(kTick).evaluations;
    ++run->ticks;
  };
  c.hash = [run, model] {
    ClothState state = make_cloth_state(model);
    run->solver.save(state);
    return hash_of(state.positions);
  };
  c.extra = [run] {
    return fixed_text(static_cast<double>(run->evaluations) / static_cast<double>(run->ticks), 2) +
           " evaluations";
  };
  return c;
}

/// As much friction memory as a law made of KES scalars brings: three play elements in each.
ClothMaterial three_play_material() {
  ClothMaterial m = bench_material();
  m.weft_bending = m.warp_bending = make_bending_law(1e-5, 4.9e-4, 3e3);
  m.shear = make_shear_law(56.0, 1.48, 3.0);
  m.weft_tension = m.warp_tension = make_tensile_law(0.7, 0.6, 0.05, 490.0);
  m.twist_stiffness = 2e-6;
  m.air_density = 1.2;
  return m;
}

Contender explicit_contender(int side) {
  struct Run {
    ClothModel model;
    ClothMaterial material = bench_material();
    ClothState state;
    SolverExplicit solver;
  };
  const auto run = std::make_shared<Run>();
  run->model = two_corner_square(side);
  run->state = make_cloth_state(run->model);
  ExplicitOptions options;
  options.substeps = static_cast<int>(std::ceil(kTick / stable_substep(run->model, run->material)));
  run->solver.prepare(run->model, run->material, options);
  Contender c;
  c.name = "explicit oracle (double)";
  c.side = side;
  c.batch = 1;
  c.run = [run] { run->solver.step(run->state, kTick); };
  c.hash = [run] { return hash_of(run->state.positions); };
  c.extra = [options] { return std::to_string(options.substeps) + " substeps"; };
  return c;
}

Contender relaxation_contender(int side) {
  constexpr int kSteps = 20;
  struct Run {
    LatticeModel model;
    FabricLaws laws = fuai_test::linear_laws(0.1, 0.025, 150.0);
    LatticeState state;
    SolverRelaxation solver;
  };
  const auto run = std::make_shared<Run>();
  run->model = make_lattice_model({side, side, kSpacing, kArealMass, {side * (side - 1), side * side - 1}});
  run->state = make_lattice_state(run->model);
  run->solver.prepare(run->model, run->laws);
  Contender c;
  c.name = "the paper's relaxation, one step";
  c.side = side;
  c.batch = 2;
  c.ticks_a_call = kSteps;
  c.run = [run] {
    RelaxationStop stop;
    stop.tolerance = 0.0;
    stop.max_steps = kSteps;
    run->solver.run(run->state, stop);
  };
  c.hash = [run] { return hash_of(run->state.positions); };
  c.extra = [] { return std::string("no time in it: a step is not a millisecond"); };
  return c;
}

#ifdef FUAI_BENCH_BULLET
Contender bullet_contender(int side, BulletLinks links) {
  const auto cloth = std::make_shared<BulletCloth>(BulletClothOptions{side, kSpacing, kArealMass, 1, links});
  Contender c;
  const bool demo = links != BulletLinks::kYarns;
  c.name = std::string("Bullet, 1 iteration") + (demo ? ", patch of its demos" : "") +
           (links == BulletLinks::kDemoShuffled ? ", shuffled" : "");
  c.side = side;
  c.bytes = static_cast<double>(cloth->bytes());
  c.yardstick = links == BulletLinks::kYarns ? 1 : links == BulletLinks::kDemo ? 2 : 0;
  c.run = [cloth] { cloth->step(kTick); };
  c.hash = [cloth] { return cloth->position_hash(); };
  c.extra = [cloth, demo] {
    return std::string(demo ? "12" : "6") + " links a node" +
           (cloth->is_whole() ? "" : "; BLOWN UP, time void");
  };
  return c;
}
#endif

/// Turns go round until every contender has had `turns`; 50 ticks before them are not timed.
void race(std::vector<Contender>& contenders, int turns) {
  constexpr int kWarmUp = 50;
  for (Contender& c : contenders) {
    for (double ticks = 0.0; ticks < (c.batch > 1 ? kWarmUp : 1); ticks += c.ticks_a_call, ++c.calls) c.run();
  }
  for (int turn = 0; turn < turns; ++turn) {
    for (Contender& c : contenders) {
      c.run();
      for (int i = 0; i < c.batch; ++i) {
        const double start = thread_seconds();
        c.run();
        c.microseconds.push_back(1e6 * (thread_seconds() - start) / c.ticks_a_call);
      }
      c.calls += c.batch + 1;
    }
  }
}

/// Median time of each turn [us].
std::vector<double> turn_times(const Contender& c) {
  const auto batch = static_cast<std::ptrdiff_t>(c.batch);
  std::vector<double> times;
  for (auto at = c.microseconds.begin(); at != c.microseconds.end(); at += batch)
    times.push_back(spread(std::vector<double>(at, at + batch)).median);
  return times;
}

/// Time over that of the contender with this yardstick; 0 without one.
double ratio(const std::vector<Contender>& contenders, const Contender& c, int yardstick) {
  for (const Contender& other : contenders) {
    if (other.yardstick != yardstick) continue;
    std::vector<double> ratios = turn_times(c);
    const std::vector<double> measure = turn_times(other);
    for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] /= measure[i];
    return spread(ratios).median;
  }
  return 0.0;
}
std::string ratio_text(double value) { return value > 0.0 ? fixed_text(value, 2) : "-"; }

void print_race(Report& report, const std::vector<Contender>& contenders) {
  std::vector<Row> rows;
  for (const Contender& c : contenders) {
    const Spread s = spread(c.microseconds);
    const double nodes = static_cast<double>(c.side) * c.side;
    rows.push_back({c.name, short_text(s.median), short_text(s.p10) + " to " + short_text(s.p90),
                    short_text(1e3 * s.median / nodes), ratio_text(ratio(contenders, c, 1)),
                    ratio_text(ratio(contenders, c, 2)), c.bytes > 0.0 ? fixed_text(c.bytes / nodes, 0) : "-",
                    c.extra(),
                    c.hash() + " after " + fixed_text(static_cast<double>(c.calls) * c.ticks_a_call, 0)});
  }
  const int side = contenders.front().side;
  report.paragraph(std::to_string(side) + " x " + std::to_string(side) + " nodes:");
  report.table({"solver", "us a tick", "p10 to p90", "ns a node", "of Bullet", "of its demos", "B a node",
                "a tick has", "state hash after ticks"},
               rows);
}

std::vector<Contender> contenders_at(int side) {
  const ClothMaterial material = bench_material();
  std::vector<Contender> c;
  c.push_back(implicit_contender(side, 5, material, "implicit, 5 iterations"));
  c.push_back(implicit_contender(side, 8, material, "implicit, 8 iterations"));
#ifdef FUAI_BENCH_BULLET
  c.push_back(bullet_contender(side, BulletLinks::kYarns));
  if (side <= 64) {
    c.push_back(bullet_contender(side, BulletLinks::kDemo));
    c.push_back(bullet_contender(side, BulletLinks::kDemoShuffled));
  }
#endif
  if (side == 64) {
    c.push_back(
        implicit_contender(side, 8, three_play_material(), "implicit, 8, three plays a law, twist, air"));
    c.push_back(relaxation_contender(side));
  }
  if (side == 32 || side == 64) c.push_back(explicit_contender(side));
  return c;
}

/// Time of a node at 200 x 200 over that at 64 x 64, measured in turns.
std::string scale_ratio(int iterations, bool quick) {
  std::vector<Contender> contenders;
  for (int side : {64, 200}) contenders.push_back(implicit_contender(side, iterations, bench_material(), ""));
  contenders[0].yardstick = 1;
  race(contenders, quick ? 5 : 20);
  return fixed_text(ratio(contenders, contenders[1], 1) * (64.0 * 64.0) / (200.0 * 200.0), 2);
}

}  // namespace

void report_speed(Report& report, bool quick) {
  report.heading("Speed");
  report.paragraph(
      "One tick of 1 ms on one core, CPU time of the thread, median of interleaved repetitions; 1 cm "
      "spacing, "
      "0.15 kg/m2, two corners held, falling from flat; one linearisation, float. Bullet (stiffness not in "
      "units, kLST 1): \"of Bullet\" is the time over that of its leanest patch that holds, with six links a "
      "node; \"of its demos\" over that of the patch its cloth demos make, with twelve; both are medians of "
      "the ratios turn by turn.");
#ifndef FUAI_BENCH_BULLET
  report.paragraph("Bullet was not found when this was built (Debian: libbullet-dev): its rows are missing.");
#endif
  for (int side : {18, 32, 64, 100, 200}) {
    std::vector<Contender> contenders = contenders_at(side);
    race(contenders, (side < 100 ? 20 : side < 200 ? 8 : 4) / (quick ? 4 : 1));
    print_race(report, contenders);
  }
  report.paragraph("Cost of a node at 200 x 200 over that at 64 x 64, in turns: " + scale_ratio(5, quick) +
                   " with 5 iterations, " + scale_ratio(8, quick) + " with 8.");
}

}  // namespace fuai_bench
