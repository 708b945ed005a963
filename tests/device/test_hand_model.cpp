// Hands and their motions.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/device/hand_model.h"

using namespace fuai;

namespace {

const Vec3 kStart(0.01, -0.02, 0.03), kWay(0.05, 0.01, -0.02);

std::vector<std::unique_ptr<const HandMotion>> closed_motions() {
  std::vector<std::unique_ptr<const HandMotion>> motions;
  motions.push_back(make_still_motion(kStart));
  motions.push_back(make_reach_motion(kStart, kWay, {0.5, 2.0}));
  motions.push_back(make_chirp_motion(kStart, kWay, {0.5, 2.0}, 0.2, 5.0));
  return motions;
}

}  // namespace

TEST_SUITE("derivative") {
  TEST_CASE("the velocity of a motion is the derivative of its position") {
    constexpr double kStep = 1e-6;
    for (const auto& motion : closed_motions()) {
      for (double t = 0.013; t < 2.5; t += 0.0371) {
        const Vec3 slope = (motion->at(t + kStep).position - motion->at(t - kStep).position) / (2.0 * kStep);
        // Central differences: h^2 / 6 of a jerk of 5e2 m/s3, rounding 1e-16 / 1e-6; a chirp's ends kink.
        CHECK((slope - motion->at(t).velocity).norm() < 1e-8);
      }
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("closed motions begin and end at the start, at rest") {
    for (const auto& motion : closed_motions()) {
      for (double t : {0.0, 0.4, 2.0, 5.0}) {
        CHECK((motion->at(t).position - kStart).norm() < 1e-12);
        CHECK(motion->at(t).velocity.norm() < 1e-12);
      }
    }
  }

  TEST_CASE("the reach gets there half-way, the chirp swings its whole way and ever faster") {
    CHECK((make_reach_motion(kStart, kWay, {0.5, 2.0})->at(1.25).position - kStart - kWay).norm() < 1e-12);
    const auto chirp = make_chirp_motion(Vec3::Zero(), Vec3::UnitX(), {0.0, 10.0}, 0.2, 5.0);
    std::vector<double> tops;
    for (int i = 1; i < 100'000; ++i) {
      const double before = chirp->at((i - 1) * 1e-4).position.x(), here = chirp->at(i * 1e-4).position.x(),
                   after = chirp->at((i + 1) * 1e-4).position.x();
      if (here > before && here >= after) tops.push_back(i * 1e-4);
    }
    REQUIRE(tops.size() == 26);  // (0.2 + 5) / 2 * 10
    CHECK(tops[1] - tops[0] > 4.0 * (tops[25] - tops[24]));
    CHECK(tops[25] - tops[24] == doctest::Approx(0.2).epsilon(0.03));  // 5 Hz at the end
  }

  TEST_CASE("a release jumps once, a path is straight between its points and stays at its end") {
    const auto release = make_release_motion(kStart, kWay, 0.1);
    CHECK(release->at(0.099).position == kStart + kWay);
    CHECK(release->at(0.1).position == kStart);
    const auto path = make_path_motion({Vec3::Zero(), Vec3(1, 0, 0), Vec3(1, 2, 0)}, 0.5);
    CHECK(path->at(-1.0).position == Vec3::Zero());
    CHECK((path->at(0.25).position - Vec3(0.5, 0, 0)).norm() < 1e-15);
    CHECK((path->at(0.75).velocity - Vec3(0, 4, 0)).norm() < 1e-12);
    CHECK(path->at(3.0).position == Vec3(1, 2, 0));
    CHECK(path->at(3.0).velocity == Vec3::Zero());
    CHECK(make_path_motion({kStart}, 0.5)->at(1.0).position == kStart);
  }

  TEST_CASE("hands by name, from none to heavy; what does not exist is refused") {
    CHECK(hand_models().size() == 5);
    CHECK(find_hand_model("arm").mass == 0.554);
    CHECK(find_hand_model("none").stiffness == 0.0);
    CHECK_THROWS_AS(find_hand_model("foot"), Error);
    CHECK_THROWS_AS(make_reach_motion(kStart, kWay, {1.0, 1.0}), Error);
    CHECK_THROWS_AS(make_chirp_motion(kStart, kWay, {0.0, 1.0}, 5.0, 0.2), Error);
    CHECK_THROWS_AS(make_path_motion({}, 0.5), Error);
    CHECK_THROWS_AS(make_path_motion({kStart}, 0.0), Error);
  }
}
