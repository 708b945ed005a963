// The scenes of the engine: they run, they repeat, and they hold what they say.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "fuai/core/error.h"
#include "fuai/scenes/catalogue.h"
#include "fuai/scenes/engine_scenes.h"
#include "fuai/scenes/lift_motion.h"
#include "fuai/scenes/scene_sheet.h"
#include "support/allocation_guard.h"
#include "support/linear_laws.h"

using namespace fuai;
using fuai_test::middling_laws;

namespace {

constexpr double kStep = 0.001;

/// Small versions of all scenes of the engine.
template <class Check>
void for_each_scene(int size, const Check& check) {
  const FabricLaws laws = middling_laws();
  for (const SceneEntry& entry : scene_entries()) {
    if (entry.kind != SceneKind::kEngine) continue;
    CAPTURE(std::string(entry.name));
    check(make_engine_scene(entry.name, laws, {size, 0.0}));
  }
}

/// Steps that also go past the moment at which most hands of the scenes change what they do.
template <class T>
void run(SceneRunner<T>& runner, int steps) {
  for (int i = 0; i < steps; ++i) runner.step(kStep);
}

int count(const std::vector<std::uint8_t>& flags) {
  return static_cast<int>(std::count(flags.begin(), flags.end(), 1));
}

/// Longest and shortest yarn edge against the spacing.
std::pair<double, double> strains_at_start(const EngineScene& scene) {
  const ClothModel& m = scene.model;
  double least = 1e300, most = -1e300;
  for (int row = 0; row < m.rows; ++row) {
    for (int column = 0; column + 1 < m.columns; ++column) {
      const auto a = static_cast<std::size_t>(m.slot(column, row));
      const double strain =
          (scene.start.positions[a + 1] - scene.start.positions[a]).norm() / m.spacing - 1.0;
      least = std::min(least, strain);
      most = std::max(most, strain);
    }
  }
  return {least, most};
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("every scene runs: finite, no step given up, held cloth in its place, in float and double") {
    for_each_scene(17, [](const EngineScene& scene) {
      CHECK(scene.seconds > 0.0);
      CHECK(!scene.start.positions.empty());
      CHECK((scene.view.high - scene.view.low).minCoeff() >= 0.0);
      CHECK(scene.hands.size() <= kMostHands);
      CHECK((scene.motion != nullptr || scene.hands.empty()));
      SceneRunner<float> runner(scene);
      SceneRunner<double> exact(scene);
      for (int i = 0; i < 50; ++i) {
        CHECK((runner.step(kStep).status & StepReport::kNotFinite) == 0);
        CHECK((exact.step(kStep).status & StepReport::kNotFinite) == 0);
      }
      ClothState state;
      runner.simulation().snapshot(state);
      for (std::size_t slot = 0; slot < state.positions.size(); ++slot) {
        CHECK(state.positions[slot].allFinite());
        if (scene.model.fixed[slot] == 0) continue;
        const Vec3& start = scene.start.positions[slot];
        const Vec3 moved =
            scene.motion ? scene.motion->fixed_move(start, runner.simulation().time()) : Vec3(Vec3::Zero());
        // Single precision: half a unit in the last place of 0.3 m is 1.5e-8 m a coordinate.
        CHECK((state.positions[slot] - start - moved).norm() < 1e-7);
      }
    });
  }

  TEST_CASE("every scene is made at the least size and refuses what lies out of range") {
    const FabricLaws laws = middling_laws();
    for_each_scene(kLeastSceneSize, [](const EngineScene& scene) {
      SceneRunner<float> runner(scene);
      run(runner, 5);
      CHECK(std::isfinite(runner.simulation().read().total_energy()));
      CHECK(count(scene.model.fixed) > 0);
      CHECK(count(scene.model.fixed) < scene.model.slot_count());
    });
    for (const SceneOptions& wrong : {SceneOptions{2, 0.0}, SceneOptions{-1, 0.0}, SceneOptions{513, 0.0},
                                      SceneOptions{0, -0.01}, SceneOptions{0, 0.2}, SceneOptions{0, NAN}}) {
      for (const SceneEntry& entry : scene_entries()) {
        if (entry.kind == SceneKind::kEngine)
          CHECK_THROWS_AS(make_engine_scene(entry.name, laws, wrong), Error);
      }
    }
    CHECK_THROWS_AS(make_engine_scene("paper_drape", laws), Error);
    CHECK_THROWS_AS(make_engine_scene("no_scene", laws), Error);
    CHECK_THROWS_AS(run_scene("hanging_sheet", laws, PaperMode::kCorrected, 1.0), Error);
  }

  TEST_CASE("the drape tester keeps its standard size at any spacing, and scales with a size") {
    const auto area = [](const EngineScene& scene) {
      return std::accumulate(scene.model.node_area.begin(), scene.model.node_area.end(), 0.0);
    };
    const auto disc = [](double diameter) { return 0.25 * std::numbers::pi * diameter * diameter; };
    const FabricLaws laws = middling_laws();
    // The outline is a polygon: a part in a thousand.
    for (double spacing : {0.0, 0.005, 0.007})
      CHECK(area(make_drape_tester(laws, {0, spacing})) == doctest::Approx(disc(0.30)).epsilon(1e-3));
    CHECK(area(make_drape_tester(laws, {21, 0.01})) == doctest::Approx(disc(0.20)).epsilon(1e-3));
    const EngineScene small = make_drape_tester(laws, {21, 0.01});
    CHECK(small.view.columns.front().radius == doctest::Approx(0.06));
    // Held under the disc, the rim falls in folds: lower than the disc, and not everywhere alike.
    SceneRunner<float> runner(small);
    run(runner, 600);
    double lowest = 0.0, highest = -1.0;
    for (const MaterialPoint& point : small.model.border) {
      double z = 0.0;
      for (std::size_t i = 0; i < 4; ++i)
        z += point.weights[i] * runner.simulation().position(point.slots[i]).z();
      lowest = std::min(lowest, z);
      highest = std::max(highest, z);
    }
    MESSAGE("rim of the small specimen after 0.6 s: ", 1e3 * lowest, " to ", 1e3 * highest, " mm");
    CHECK(lowest < -0.01);
    CHECK(lowest > -0.045);  // an overhang of 40 mm, stretched little
    CHECK(highest - lowest > 0.001);
  }

  TEST_CASE("the scenes hold what they name") {
    const FabricLaws laws = middling_laws();
    CHECK(count(make_hanging_sheet(laws).model.fixed) == 2);
    CHECK(count(make_hanging_strip(laws).model.fixed) == 9);
    CHECK(count(make_taut_patch(laws).model.fixed) == 32);
    CHECK(count(make_bending(laws).model.fixed) == 2 * 17);
    CHECK(count(make_corner_drape(laws).model.fixed) == 25);  // the paper's 5 x 5
    CHECK(count(make_grasp_and_lift(laws).model.fixed) == 33);
    // 0.4 of 32 spacings is 12.8: the edge lies within the cell behind the row of slot 13.
    CHECK(count(make_table_edge(laws).model.fixed) == 33 * 14);
    // The points of a square lattice within 9.5 spacings: the clamp's edge is sub-cell, half a spacing
    // inside.
    CHECK(count(make_drape_tester(laws).model.fixed) == 293);
  }

  TEST_CASE("the waves of the clamped sheet take 5 % off its width and stretch no yarn") {
    for (int size : {9, 32, 64}) {
      const EngineScene scene = make_taut_patch(middling_laws(), {size, 0.0});
      const auto [least, most] = strains_at_start(scene);
      CHECK(std::abs(least) < 1e-12);  // rounding of a chord of 1 cm at 1 m
      CHECK(std::abs(most) < 1e-12);
      const ClothModel& m = scene.model;
      const Vec3 across = scene.start.positions[static_cast<std::size_t>(m.slot(m.columns - 1, 0))] -
                          scene.start.positions[0];
      const double width = (m.columns - 1) * m.spacing;
      // The mean of cos(a cos t) over n equal steps of t differs from the integral by 2 J_n(a), n >= 8 steps
      // a wave here: below 1e-6.
      CHECK(across.x() / width == doctest::Approx(0.95).epsilon(1e-5));
    }
  }

  TEST_CASE("the corner drape keeps the paper's sheet and block at every spacing") {
    for (double spacing : {0.01, 0.005, 0.0075, 0.012}) {
      const EngineScene scene = make_corner_drape(middling_laws(), {0, spacing});
      double area = 0.0;
      for (double a : scene.model.node_area) area += a;
      CHECK(area == doctest::Approx(0.17 * 0.17).epsilon(1e-9));  // make_cloth_model: to rounding
    }
    // Yarns bend from the edge of the block on, wherever the slots lie: 4 cm is 5.33 spacings of 7.5 mm.
    const EngineScene scene = make_corner_drape(middling_laws(), {0, 0.0075});
    CHECK(count(scene.model.fixed) == 36);
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("two runs agree bit for bit, and so does a run that was frozen and continued elsewhere") {
    for_each_scene(13, [](const EngineScene& scene) {
      SceneRunner<float> first(scene), second(scene), third(scene);
      run(first, 130);
      run(second, 70);
      SceneSnapshot middle;
      second.snapshot(middle);
      run(second, 60);
      run(third, 11);  // any other state before restore()
      third.restore(middle);
      run(third, 60);
      const std::uint64_t hash = first.simulation().read().state_hash;
      CHECK(hash != SceneRunner<float>(scene).simulation().read().state_hash);
      CHECK(second.simulation().read().state_hash == hash);
      CHECK(third.simulation().read().state_hash == hash);
      CHECK(third.hand_reading(0).force == first.hand_reading(0).force);
    });
  }
}

TEST_SUITE("property") {
  TEST_CASE("hands grip and let go when the scene says so") {
    const EngineScene scene = make_grasp_and_lift(middling_laws(), {13, 0.0});
    SceneRunner<float> runner(scene);
    CHECK(!runner.hand_reading(0).holds);
    CHECK(scene.motion->hand(0, scene.shown_at()).holds);  // a picture shows the lift, not the end
    CHECK(make_bending(middling_laws()).shown_at() == 1.0);
    run(runner, 1500);
    const GraspReading held = runner.hand_reading(0);
    CHECK(held.holds);
    CHECK(held.force.z() < 0.0);  // the cloth weighs on the hand
    // What hangs on the hand is cloth: no more than all of it.
    CHECK(held.force.norm() < 0.16 * 0.12 * 0.12 * kStandardGravity);
    run(runner, 1001);
    CHECK(!runner.hand_reading(0).holds);
    CHECK(!runner.hand_reading(1).holds);
    CHECK(!runner.hand_reading(kMostHands).holds);
  }

  TEST_CASE("yank and shake never move the hand faster than 5 m/s, and the shake keeps to its box") {
    const FabricLaws laws = middling_laws();
    for (const char* name : {"yank", "shake"}) {
      const EngineScene scene = make_engine_scene(name, laws, {13, 0.0});
      Vec3 low = Vec3::Constant(1e300), high = -low, before = scene.motion->hand(0, 0.0).position;
      double fastest = 0.0;
      for (int i = 1; i < 10000; ++i) {
        const Vec3 at = scene.motion->hand(0, i * 1e-4).position;
        fastest = std::max(fastest, (at - before).norm() / 1e-4);
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
        before = at;
      }
      CHECK(fastest == doctest::Approx(5.0).epsilon(1e-9));  // differences of doubles over 0.1 ms: 1e-12
      const double extent = std::string(name) == "yank" ? 0.1 : 0.3;
      CHECK((high - low).maxCoeff() == doctest::Approx(extent).epsilon(1e-9));
    }
  }

  TEST_CASE("a lift rises, stays, comes back, lets go, and keeps the length of a cantilever") {
    LiftPath path;
    path.start = Vec3(0.1, 0.2, 0.3);
    path.height = 0.04;
    path.begins = 0.5;
    path.ends = 1.0;
    path.back_begins = 2.0;
    path.back_ends = 3.0;
    path.lets_go = 2.5;
    path.cantilever = 0.2;
    const auto lift = make_lift_motion(path);
    CHECK(lift->hand(0, 0.0).position == path.start);
    CHECK(lift->hand(0, 3.0).position == path.start);
    const Vec3 top = lift->hand(0, 1.5).position - path.start;
    // To rounding. A cantilever of this tip, w = z s^2 (3 L - s) / (2 L^3), is shorter by 3/5 z^2 / L.
    CHECK((top - Vec3(0.0, -0.6 * 0.04 * 0.04 / 0.2, 0.04)).norm() < 1e-15);
    CHECK(lift->hand(0, 2.499).holds);
    CHECK_FALSE(lift->hand(0, 2.5).holds);
    path.back_ends = path.back_begins = 0.0;
    path.cantilever = 0.0;
    CHECK((make_lift_motion(path)->hand(0, 100.0).position - path.start - Vec3(0.0, 0.0, 0.04)).norm() <
          1e-15);
    path.ends = path.begins;
    CHECK_THROWS_AS(make_lift_motion(path), Error);
  }

  TEST_CASE("a smooth rise goes from 0 to 1 without a jump of its slope") {
    CHECK(smooth_rise(-1.0, 0.0, 2.0) == 0.0);
    CHECK(smooth_rise(1.0, 0.0, 2.0) == 0.5);
    CHECK(smooth_rise(5.0, 0.0, 2.0) == 1.0);
    CHECK(smooth_rise(1e-4, 0.0, 2.0) < 1e-11);  // 10 s^3
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("a tick of a scene allocates nothing, gripping and letting go included") {
    for_each_scene(9, [](const EngineScene& scene) {
      SceneRunner<float> runner(scene);
      const fuai_test::AllocationGuard guard;
      run(runner, 60);
      runner.hand_reading(0);
      runner.hand(0);
      CHECK(guard.count() == 0);
    });
    const EngineScene lift = make_grasp_and_lift(middling_laws(), {9, 0.0});
    SceneRunner<float> runner(lift);
    const fuai_test::AllocationGuard guard;
    for (int i = 0; i < 300; ++i) runner.step(0.01);  // past the moment of letting go
    CHECK(guard.count() == 0);
    CHECK(!runner.hand_reading(0).holds);
  }
}
