// The stiffest virtual wall that the simulated device renders, against theory.
// SPDX-License-Identifier: Apache-2.0
// Source: Colgate and Schenkel 1997; Gil et al. 2004: K < (b + B) / (T/2 + t_d); docs/theory/force-path.md.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fuai/haptics/virtual_session.h"
#include "wide_open.h"

using namespace fuai;
using namespace fuai_test;
using Answer = SpringWall::Answer;

namespace {

constexpr double kSlow = 1.0 / 60.0;  // period of a cloth that cannot keep up [s]

/// A wall and how it is told to the force loop.
struct Trial {
  double damping = 0.1;  ///< b of the device [N s/m]
  double delay = 0.0;    ///< of its motors [s]
  HandModel hand{};
  Answer answer = Answer::kHeld;
  double period = 0.0;  ///< of the wall; 0: every tick [s]
};

/// Let go 1 mm from the middle of a spring: whether it comes to rest. Two seconds: 5 % beyond the limit the
/// swing of 45 g has grown by a tenth then.
bool settles(const Trial& trial, double stiffness) {
  SimulatedDevice device = still_device(bare_device(trial.damping, trial.delay), trial.hand);
  ForcePath path(wide_open());
  SpringWall wall(stiffness, 0.0, Vec3::Zero(), trial.answer);
  VirtualSession session(device, path, wall, {trial.period, 0.0, 0});
  device.place(Vec3(0.001, 0.0, 0.0));
  double farthest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    session.tick(kTick);
    const double far = std::abs(device.true_position().x());
    if (far > 1.0) return false;
    if (i >= 1750) farthest = std::max(farthest, far);
  }
  return farthest < 0.001;
}

/// By bisection to 1 %.
double stiffest(const Trial& trial) {
  double low = 1.0, high = 1e5;
  while (high > 1.01 * low) {
    const double middle = std::sqrt(low * high);
    (settles(trial, middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a wall of every tick: 2 b / T") {
    for (double b : {0.05, 0.1, 0.2, 0.4}) {
      Trial trial;
      trial.damping = b;
      const double K = stiffest(trial);
      MESSAGE("b = " << b << " N s/m: " << K << " N/m, theory " << 2.0 * b / kTick);
      // Bisection 1 %, growth too slow to be seen in two seconds 2 %; the issue asks for 10 %.
      CHECK(K == doctest::Approx(2.0 * b / kTick).epsilon(0.03));
    }
  }

  TEST_CASE("motors that lag by a tick: b / (T/2 + t_d)") {
    for (double b : {0.1, 0.2, 0.4}) {
      Trial trial;
      trial.damping = b;
      trial.delay = kTick;
      const double K = stiffest(trial);
      MESSAGE("b = " << b << " N s/m: " << K << " N/m, theory " << b / (1.5 * kTick));
      CHECK(K == doctest::Approx(b / (1.5 * kTick)).epsilon(0.03));
    }
  }

  TEST_CASE("a force held for N ticks, as a slow cloth without a tangent gives it: b / (N T / 2)") {
    for (int ticks : {4, 10, 17}) {
      Trial trial;
      trial.period = ticks * kTick;
      const double K = stiffest(trial);
      MESSAGE(ticks << " ticks: " << K << " N/m, theory " << 2.0 * trial.damping / trial.period);
      CHECK(K == doctest::Approx(2.0 * trial.damping / trial.period).epsilon(0.03));
    }
  }
}

TEST_SUITE("crosscheck") {
  TEST_CASE("with a tangent the wall is as stiff from 500 to 60 Hz as at 1 kHz, alone and in a hand") {
    for (const char* hand : {"none", "arm"}) {
      Trial trial;
      trial.hand = find_hand_model(hand);
      const double fast = stiffest(trial);
      trial.answer = Answer::kTangent;
      for (const double period : {1.0 / 500.0, 1.0 / 250.0, 1.0 / 125.0, kSlow}) {
        trial.period = period;
        const double slow = stiffest(trial);
        MESSAGE(std::string(hand) << ": " << fast << " N/m at 1 kHz, " << slow << " N/m at " << 1.0 / period
                                  << " Hz");
        CHECK(slow == doctest::Approx(fast).epsilon(0.05));  // the figure
      }
      // Without it the wall would be a tenth as stiff: the test can fail.
      trial.answer = Answer::kHeld;
      CHECK(stiffest(trial) < 0.15 * fast);
    }
  }
}
