// What stands in the pictures of the engine's scenes.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fuai/experiments/scene_pictures.h"
#include "fuai/scenes/catalogue.h"
#include "support/linear_laws.h"

using namespace fuai;
using fuai_test::middling_laws;

TEST_SUITE("unit") {
  TEST_CASE("a picture of a scene shows the cloth, what holds it, and the pull of the hand") {
    const FabricLaws laws = middling_laws();
    for (const SceneEntry& entry : scene_entries()) {
      if (entry.kind != SceneKind::kEngine) continue;
      CAPTURE(std::string(entry.name));
      const EngineScene scene = make_engine_scene(entry.name, laws, {13, 0.0});
      SceneRunner<float> runner(scene);
      // Past the yank and well into the bend: each hand feels more than the least force that is drawn.
      for (int i = 0; i < 200; ++i) runner.step(0.001);
      ClothState state;
      runner.simulation().snapshot(state);
      const std::vector<GraspReading> hands(scene.hands.size(), runner.hand_reading(0));
      const ClothPicture picture = engine_scene_picture(scene, state, hands, "caption", 1.5);
      CHECK(picture.caption == "caption");
      CHECK(picture.cloths.size() == 1);
      const bool round = entry.name == "drape_tester";
      if (!round) CHECK(picture.cloths[0].mesh.triangles.size() == 2 * 12 * (scene.model.columns - 1));
      // Two pegs, a pedestal of two, or a rail or table: something holds every cloth.
      CHECK(picture.cylinders.size() + picture.boxes.size() >= 1);
      CHECK((picture.cylinders.size() == 2) == (entry.name == "hanging_sheet" || round));
      CHECK(picture.arrows.size() == scene.hands.size());
      for (const ArrowItem& arrow : picture.arrows) {
        CHECK(arrow.vector.dot(hands[0].force) < 0.0);
        CHECK(arrow.label.ends_with("N"));
        CHECK(arrow.origin.z() + arrow.vector.z() > picture.ground.height);
      }
      for (const Vec3& x : state.positions) CHECK(x.z() > picture.ground.height);
      // The middle of the scene is in the middle half of the picture.
      const Vec3 pixel = project_to_pixel(picture.camera, 300, 200, 0.5 * (scene.view.low + scene.view.high));
      CHECK(std::abs(pixel.x() - 150.0) < 75.0);
      CHECK(std::abs(pixel.y() - 100.0) < 50.0);
      CHECK(pixel.z() > 0.0);
    }
  }
}
