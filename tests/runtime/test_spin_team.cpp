// A team does every member's part once a round, and the engine's bits do not depend on it.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/spin_team.h"

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <thread>

#include "fuai/core/error.h"
#include "fuai/sim/simulation.h"
#include "support/allocation_guard.h"
#include "support/small_cloth.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("every member works once a round, the caller among them") {
    for (int size : {1, 2, 3}) {
      SpinTeam team(size);
      std::array<std::atomic<int>, 4> calls{};
      for (int round = 1; round <= 2000; ++round) {
        run_together(&team, [&](int member) { ++calls[static_cast<std::size_t>(member)]; });
        // All are back: nobody is a round behind.
        for (int member = 0; member < size; ++member)
          REQUIRE(calls[static_cast<std::size_t>(member)] == round);
      }
      CHECK(calls[static_cast<std::size_t>(size)] == 0);
    }
  }
  TEST_CASE("without a team the caller is the only member") {
    int calls = 0, last = -1;
    run_together(nullptr, [&](int member) {
      ++calls;
      last = member;
    });
    CHECK(calls == 1);
    CHECK(last == 0);
  }
  TEST_CASE("members that fell asleep wake for the next round") {
    SpinTeam team(2);
    std::atomic<int> sum{0};
    for (int round = 0; round < 5; ++round) {
      // Long past the patience of a member; the result does not depend on how long.
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      run_together(&team, [&](int member) { sum += member + 1; });
    }
    CHECK(sum == 15);
  }
  TEST_CASE("shares are adjoining and complete") {
    for (int count : {0, 1, 5, 64}) {
      for (int members : {1, 2, 3, 7}) {
        int next = 0;
        for (int member = 0; member < members; ++member) {
          const Share share = share_of(count, member, members);
          CHECK(share.begin == next);
          next = share.end;
        }
        CHECK(next == count);
      }
    }
  }
  TEST_CASE("a team of a size that makes no sense is refused") {
    CHECK_THROWS_AS(SpinTeam(0), Error);
    CHECK_THROWS_AS(SpinTeam(65), Error);
  }
}

namespace {

/// A sheet on two corners with a hand, 60 ticks; columns and rows that are no whole vectors.
std::uint64_t hash_with(Team* team) {
  ClothModel model = fuai_test::sheet_model(37, 41, 0.01, 0.15);
  model.fixed[static_cast<std::size_t>(model.slot(0, 40))] = 1;
  model.fixed[static_cast<std::size_t>(model.slot(36, 40))] = 1;
  Simulation<float> simulation(model, fuai_test::uneven_material());
  simulation.solver().set_team(team);
  const Vec3 start(0.18, 0.02, 0.0);
  const int hold = simulation.grasp({Vec2(0.18, 0.02)}, start);
  const fuai_test::AllocationGuard guard;
  for (int tick = 0; tick < 60; ++tick) {
    simulation.move_grasp(hold, start + 0.001 * tick * Vec3(0.3, 0.2, 1.0));
    simulation.step(1e-3);
  }
  CHECK(guard.count() == 0);
  return simulation.read().state_hash;
}

}  // namespace

TEST_SUITE("determinism") {
  TEST_CASE("one, two and three threads give the same bits") {
    const std::uint64_t alone = hash_with(nullptr);
    for (int size : {2, 3}) {
      SpinTeam team(size);
      CHECK(hash_with(&team) == alone);
    }
  }
}
