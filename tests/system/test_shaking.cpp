// A held sheet shaken wildly: finite, bounded, settling; without allocations; the same bits again.
// SPDX-License-Identifier: Apache-2.0
#include "support/allocation_guard.h"
#include "system/hanging_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr int kSide = 33;

GraspSpec middle_of_low_edge(double spacing) {
  GraspSpec spec;
  spec.centre = Vec2(0.5 * (kSide - 1) * spacing, 0.01);
  return spec;
}

/// Shaken at 5 m/s by a hold that bears 12 N, two iterations a step, steps of 0.2 to 8 ms.
void shake(double spacing, double seconds, unsigned seed) {
  CAPTURE(seed);
  const ClothModel model = hanging_model(kSide, kSide, spacing);
  SimulationOptions options;
  options.implicit.iterations = 2;
  Simulation<float> simulation(model, uneven_material(), options);
  simulation.restore(upright_state(model));
  const GraspSpec spec = middle_of_low_edge(spacing);
  const Vec3 start(spec.centre.x(), 0.0, spec.centre.y() - (kSide - 1) * spacing);
  const int hold = simulation.grasp(spec, start);
  REQUIRE(hold >= 0);
  ZigZag hand(start, 0.15, 5.0, 0.02, seed);
  std::mt19937 random(seed + 1);
  std::uniform_real_distribution<double> step(0.2e-3, 8e-3);
  int wrong = 0, saturated = 0, ticks = 0;
  double most = 0.0;
  const auto tick = [&](bool moves) {
    const double dt = step(random);
    simulation.move_grasp(hold, moves ? hand.move(dt) : start);
    const StepReport report = simulation.step(dt);
    const GraspReading reading = simulation.grasp_reading(hold);
    wrong += (report.status & StepReport::kNotFinite) != 0 || !reading.force.allFinite() ? 1 : 0;
    saturated += reading.saturated ? 1 : 0;
    most = std::max(most, reading.force.norm());
    ++ticks;
    return reading.force;
  };
  while (simulation.time() < seconds) tick(true);
  const double strain = simulation.read().max_strain;
  MESSAGE("shake, ", 1e3 * spacing, " mm, ", seconds, " s, seed ", seed, ": ", ticks, " ticks, most force ",
          most, " N, saturated in ", saturated, ", strain ", strain);
  // The hand goes home and stays. A crumpled sheet hangs on its folds and may slip off one much later, so it
  // is not looked at after a fixed time: it comes to rest at all, and it never gains energy on the way.
  const double home = simulation.time();
  // With what the hold's springs have stored, as far as their sum shows it.
  const auto all_energy = [&] {
    return simulation.read().total_energy() +
           simulation.grasp_reading(hold).force.squaredNorm() / (2.0 * spec.stiffness);
  };
  double energy = all_energy(), gained = 0.0, settled = -1.0, spread = 0.0;
  while (simulation.time() < home + 20.0) {
    Vec3 low = Vec3::Constant(1e9), high = -low;
    const double second = simulation.time() + 1.0;
    double fastest = 0.0;
    while (simulation.time() < second) {
      const Vec3 force = tick(false);
      if (simulation.time() < second - 0.1) continue;
      low = low.cwiseMin(force);
      high = high.cwiseMax(force);
      fastest = std::max(fastest, simulation.read().max_speed);
    }
    const double now = all_energy();
    // At first the hold drags the sheet home, saturated, and does work on it.
    if (simulation.time() > home + 3.5) gained = std::max(gained, now - energy);
    energy = now;
    if (settled < 0.0 && fastest < 5e-3 && (high - low).norm() < 3e-3) {
      settled = simulation.time() - home;
      spread = (high - low).norm();
    }
  }
  MESSAGE("at rest after ", settled, " s, force then steady to ", 1e3 * spread,
          " mN; most energy gained in a second ", 1e3 * gained, " mJ; strain ", simulation.read().max_strain);
  CHECK(wrong == 0);
  CHECK(most <= spec.most_force * (1.0 + 1e-6));  // of single precision
  CHECK(saturated > ticks / 20);                  // it was shaken beyond what the hold can bear
  CHECK(settled >= 0.0);
  // Two iterations do not solve a step to its end, and a crumpled sheet may gain a little in a bad one:
  // measured 0.06 mJ in a second at most, where the sheet holds some 10 mJ. With enough iterations nothing is
  // gained (test_energy_decay).
  CHECK(gained < 1e-4);
}

/// One hold dragged about, let go and taken again; the hash at the end.
std::uint64_t drag(Simulation<float>& simulation, int ticks, unsigned seed) {
  const double spacing = simulation.model().spacing;
  const GraspSpec spec = middle_of_low_edge(spacing);
  const Vec3 start(spec.centre.x(), 0.0, spec.centre.y() - (kSide - 1) * spacing);
  ZigZag hand(start, 0.1, 1.0, 0.02, seed);
  int hold = -1;
  for (int i = 0; i < ticks; ++i) {
    if (i % 1000 == 0) hold = simulation.grasp(spec, start);
    if (i % 1000 == 800) simulation.release(hold);
    simulation.move_grasp(hold, hand.move(1e-3));
    simulation.step(1e-3);
  }
  return simulation.read().state_hash;
}

Simulation<float> hanging_simulation() {
  const ClothModel model = hanging_model(kSide, kSide, 0.01);
  Simulation<float> simulation(model, uneven_material());
  simulation.restore(upright_state(model));
  return simulation;
}

}  // namespace

TEST_SUITE("safety") {
  TEST_CASE("five seconds of shaking at 5 m/s with random steps: finite, bounded, settles") {
    shake(0.01, 5.0, 1);
    shake(0.0025, 5.0, 2);
  }
}

TEST_SUITE("safety+slow") {
  TEST_CASE("a minute of shaking at 5 m/s with random steps: finite, bounded, settles") {
    for (unsigned seed : {11U, 12U}) {
      shake(0.01, 60.0, seed);
      shake(0.0025, 60.0, seed);
    }
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("two runs with a moving hold end in the same bits") {
    Simulation<float> first = hanging_simulation(), second = hanging_simulation();
    const std::uint64_t hash = drag(first, 1300, 5);
    CHECK(hash == drag(second, 1300, 5));
    Simulation<float> other = hanging_simulation();
    CHECK(hash != drag(other, 1300, 6));  // the hash tells states apart
  }

  TEST_CASE("a state taken over by another simulation goes on with the same bits") {
    Simulation<float> first = hanging_simulation(), second = hanging_simulation();
    drag(first, 820, 5);  // the hold was let go at 800; the sheet swings
    ClothState state;
    for (int times = 0; times < 20; ++times) {
      first.snapshot(state);
      second.restore(state);
      CHECK(second.read().state_hash == first.read().state_hash);
      REQUIRE(first.read().max_speed > 0.01);
      for (int i = 0; i < 20; ++i) {
        first.step(1e-3);
        second.step(1e-3);
      }
      CAPTURE(times);
      CHECK(second.read().state_hash == first.read().state_hash);
      CHECK(second.time() == first.time());
    }
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("ten thousand ticks with a hold that moves, lets go and grips allocate nothing") {
    Simulation<float> simulation = hanging_simulation();
    const GraspSpec spec = middle_of_low_edge(0.01);
    const Vec3 start(spec.centre.x(), 0.0, spec.centre.y() - 0.32);
    ZigZag hand(start, 0.1, 1.0, 0.02, 4);
    int hold = -1, grips = 0;
    double felt = 0.0;
    const AllocationGuard guard;
    for (int i = 0; i < 10000; ++i) {
      if (i % 500 == 0) grips += (hold = simulation.grasp(spec, start)) >= 0 ? 1 : 0;
      if (i % 500 == 400) simulation.release(hold);
      simulation.move_grasp(hold, hand.move(1e-3));
      simulation.step(1e-3);
      felt = std::max(felt, simulation.grasp_reading(hold).force.norm());
    }
    CHECK(guard.count() == 0);
    CHECK(grips == 20);
    CHECK(felt > 0.1);  // it did pull
  }
}
