// The play law on its own: tangents, potentials, dissipation, memory.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/fabric/play_law.h"
#include "support/allocation_guard.h"

using namespace fuai;

namespace {

/// An asymmetric law whose friction widens with |x|: B = 0.1, Y from 0.03 to 0.07 over +-2.5.
PlayLaw widening_law() {
  std::vector<double> elastic, friction;
  for (int i = 0; i <= 250; ++i) {
    const double x = -2.5 + 0.02 * i;
    elastic.push_back(0.1 * x + 0.004 * x * x * x + 0.003 * std::abs(x) * x);
    friction.push_back(0.03 + 0.006 * x * x + 0.002 * x);
  }
  const PlayElement elements[] = {{0.05, 0.3}, {0.15, 0.3}, {0.4, 0.25}, {0.8, 0.15}};
  return make_play_law(make_curve_table(-2.5, 2.5, elastic, jamming_outside(40.0)),
                       make_curve_table(-2.5, 2.5, friction, constant_outside()), elements);
}

}  // namespace

TEST_SUITE("derivative") {
  TEST_CASE(
      "stress is the derivative of the incremental potential and of the free energy, tangent of the stress") {
    const PlayLaw law = widening_law();
    std::mt19937 random(3);
    std::uniform_real_distribution<double> strain(-4.0, 4.0);
    double worst_stress = 0.0, worst_tangent = 0.0;
    int smooth = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      PlayState state;
      for (int k = 0; k < 5; ++k) law.commit(strain(random), state);
      const double x = strain(random), h = 1e-6;
      const Response r = law.evaluate(x, state);
      const double numeric =
          (law.incremental_potential(x + h, state) - law.incremental_potential(x - h, state)) / (2 * h);
      worst_stress = std::max(worst_stress, std::abs(numeric - r.stress));
      const double up = (law.evaluate(x + h, state).stress - r.stress) / h;
      const double down = (r.stress - law.evaluate(x - h, state).stress) / h;
      if (std::abs(up - down) > 1e-5) continue;  // a kink lies within h of x
      ++smooth;
      worst_tangent = std::max(worst_tangent, std::abs(0.5 * (up + down) - r.tangent));
    }
    CHECK(worst_stress < 1e-7);   // central difference: h^2 F''' / 6 plus rounding 1e-16 / h
    CHECK(worst_tangent < 1e-5);  // as above, with the slope jumps of the cubic at the nodes filtered out
    CHECK(smooth > 1500);
  }
}

TEST_SUITE("property") {
  TEST_CASE("dissipation is never negative in a million random steps, and the balance closes") {
    const PlayLaw law = widening_law();
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    PlayState state;
    double x = 0.0, least = 0.0, total = 0.0, work = 0.0;
    for (int step = 0; step < 1'000'000; ++step) {
      const double size = step % 3 == 0 ? 0.02 : (step % 3 == 1 ? 0.3 : 5.0);
      const double next = std::clamp(x + size * normal(random), -6.0, 6.0);
      const double lost = law.dissipation(x, next, state);
      least = std::min(least, lost);
      total += lost;
      work += law.incremental_potential(next, state) - law.incremental_potential(x, state);
      law.commit(next, state);
      x = next;
    }
    // Rounding only: energies reach 3, so a few ulp of that.
    CHECK(least > -1e-14);
    CHECK(work == doctest::Approx(law.free_energy(x, state) + total).epsilon(1e-9));
  }

  TEST_CASE("minor loops close and the past is wiped out by a larger swing") {
    const PlayLaw law = widening_law();
    PlayState state;
    law.commit(1.0, state);
    law.commit(0.3, state);
    const double first = law.evaluate(1.0, state).stress;
    law.commit(1.0, state);
    for (int cycle = 0; cycle < 10; ++cycle) {
      law.commit(0.3, state);
      law.commit(1.0, state);
    }
    CHECK(law.evaluate(1.0, state).stress == doctest::Approx(first).epsilon(1e-15));
    PlayState direct, nested;
    for (double x : {2.0, -2.0}) law.commit(x, direct);
    for (double x : {2.0, 0.5, 1.5, 0.9, 1.1, -2.0}) law.commit(x, nested);
    for (std::size_t j = 0; j < law.elements().size(); ++j)
      CHECK(direct.position[j] == doctest::Approx(nested.position[j]).epsilon(1e-15));
  }

  TEST_CASE("a ripple does not relax the friction") {
    const PlayLaw law = widening_law();
    PlayState state;
    law.commit(1.0, state);
    law.commit(0.2, state);
    const double before = law.evaluate(0.2, state).stress;
    for (int k = 0; k < 1000; ++k) {
      law.commit(0.225, state);
      law.commit(0.2, state);
    }
    CHECK(law.evaluate(0.2, state).stress == doctest::Approx(before).epsilon(1e-12));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("bad parts are refused") {
    const CurveTable line = make_curve_table(-1, 1, std::vector<double>{-1, 0, 1});
    const CurveTable friction = make_curve_table(-1, 1, std::vector<double>{0.1, 0.1, 0.1});
    const std::vector<PlayElement> zero_radius{{0.0, 1.0}}, short_sum{{0.1, 0.5}},
        negative{{0.1, 1.5}, {0.2, -0.5}};
    const std::vector<PlayElement> many(6, {0.1, 1.0 / 6}), good{{0.1, 1.0}};
    for (const auto& bad : {zero_radius, short_sum, negative, many, std::vector<PlayElement>{}}) {
      CHECK_THROWS_AS(make_play_law(line, friction, bad), Error);
    }
    CHECK_THROWS_AS(make_play_law(line, line, good), Error);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("evaluating and committing allocates nothing") {
    const PlayLaw law = widening_law();
    PlayState state;
    double sum = 0.0;
    const fuai_test::AllocationGuard guard;
    for (int k = 0; k < 10000; ++k) {
      const double x = 3.0 * std::sin(0.01 * k);
      sum += law.advance(x, state).stress + law.incremental_potential(x, state) + law.free_energy(x, state);
    }
    CHECK(guard.count() == 0);
    CHECK(std::isfinite(sum));
    std::vector<int> proof(3);  // the guard does count
    CHECK(guard.count() == 1);
    CHECK(proof.size() == 3);
  }
}
