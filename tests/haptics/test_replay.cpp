// A recorded session done again: the same bits; and a record that was touched is found out.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "cloth_session.h"
#include "fuai/core/error.h"
#include "fuai/haptics/session_replay.h"

using namespace fuai;
using namespace fuai_test;

namespace {

/// Keeps what it hears.
class Keeper final : public SessionListener {
 public:
  Keeper() = default;
  ~Keeper() override = default;
  Keeper(const Keeper& other) : SessionListener(), ticks(other.ticks), steps(other.steps) {}
  Keeper& operator=(const Keeper& other) {
    ticks = other.ticks;
    steps = other.steps;
    return *this;
  }
  void on_tick(const TickRecord& record) noexcept override { ticks.push_back(record); }
  void on_step(const ClothStepRecord& record) noexcept override { steps.push_back(record); }
  std::vector<TickRecord> ticks;
  std::vector<ClothStepRecord> steps;
};

/// A session of 0.4 s with jitter, a clutch that is opened and cloth that is let go and taken again.
struct Recorded {
  explicit Recorded(double cloth_rate) {
    trial.cloth_rate = cloth_rate;
    trial.tangent = cloth_rate > 0.0;
    trial.seconds = 0.4;
    ClothSession session(trial);
    const double period = cloth_rate > 0.0 ? 1.0 / cloth_rate : 0.0;
    VirtualSession recorded(session.device, session.path, session.cloth, {period, period, 0, &keeper});
    for (int i = 0; i < 400; ++i) {
      session.path.hold(i < 150 || i > 200);
      session.path.open_clutch(i > 250 && i < 300);
      recorded.tick(1e-3 * (1.0 + 0.3 * std::sin(i)));
    }
    hash = session.cloth.state_hash();
  }
  ReplayResult replay() const {
    ClothSession again(trial);
    ForcePath* path = &again.path;
    return replay_session({&path, 1}, again.cloth, keeper.ticks, keeper.steps);
  }
  ClothTrial trial;
  Keeper keeper;
  std::uint64_t hash = 0;
};

}  // namespace

TEST_SUITE("determinism") {
  TEST_CASE("a replay gives every force and every hash again, cloth at 1 kHz and at 60 Hz") {
    for (double rate : {0.0, 60.0}) {
      const Recorded recorded(rate);
      REQUIRE(recorded.keeper.ticks.size() == 400);
      const ReplayResult result = recorded.replay();
      CHECK(result.matches());
      CHECK(result.ticks == 400);
      CHECK(result.steps == recorded.keeper.steps.size());
      CHECK(result.state_hash == recorded.hash);
      CHECK(result.checkpoints == recorded.keeper.steps.size() / kCheckpointSteps);
      CHECK((rate > 0.0 || result.checkpoints == 1));
    }
  }

  TEST_CASE("a nanometre in one sample, one bit of a force or a hash, and a missing step are found out") {
    Recorded recorded(0.0);
    const Recorded right = recorded;
    recorded.keeper.ticks[230].sample.position.x() += 1e-9;
    ReplayResult result = recorded.replay();
    CHECK(!result.matches());
    CHECK(result.first_wrong_tick >= 230);
    CHECK(result.first_wrong_tick <= 232);  // felt with the step of that tick, by the energy in the next
    CHECK(result.wrong_checkpoints == 1);

    recorded = right;
    double& force = recorded.keeper.ticks[100].tick.force.x();
    force = std::nextafter(force, 1.0);
    result = recorded.replay();
    CHECK(result.wrong_ticks == 1);
    CHECK(result.first_wrong_tick == 100);

    recorded = right;
    recorded.keeper.steps[kCheckpointSteps - 1].hash ^= 1;
    CHECK(recorded.replay().wrong_checkpoints == 1);

    recorded = right;
    recorded.keeper.steps.erase(recorded.keeper.steps.begin() + 50);
    CHECK_THROWS_AS(recorded.replay(), Error);
    recorded = right;
    recorded.keeper.steps.resize(50);
    CHECK_THROWS_AS(recorded.replay(), Error);
    recorded = right;
    recorded.keeper.ticks[7].hand = 1;
    CHECK_THROWS_AS(recorded.replay(), Error);
  }
}
