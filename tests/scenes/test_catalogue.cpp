// The scenes by name.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <string>

#include "fuai/core/error.h"
#include "fuai/scenes/catalogue.h"
#include "support/linear_laws.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("every scene of the paper runs, ten steps a second, and its mesh is whole") {
    const FabricLaws laws = fuai_test::linear_laws(0.06, 0.02, 200.0);
    for (const SceneEntry& entry : scene_entries()) {
      if (entry.kind != SceneKind::kPaper) continue;
      CAPTURE(std::string(entry.name));
      const SceneMoment flat = run_scene(entry.name, laws, PaperMode::kCorrected, 0.0);
      CHECK(flat.relaxation.steps == 0);
      const SceneMoment moment = run_scene(entry.name, laws, PaperMode::kCorrected, 3.0);
      CHECK(moment.relaxation.steps == 30);
      CHECK(!moment.relaxation.converged);
      CHECK(moment.mesh.positions.size() == moment.mesh.material.size());
      CHECK(moment.mesh.triangles.size() > 200);
      for (const Vec3& x : moment.mesh.positions) CHECK(x.allFinite());
    }
  }

  TEST_CASE("a scene that does not exist is refused with the list") {
    try {
      run_scene("paper_drap", fuai_test::linear_laws(0.06, 0.02, 200.0), PaperMode::kCorrected, 1.0);
      FAIL("accepted");
    } catch (const Error& e) {
      CHECK(e.kind() == ErrorKind::kUsage);
      CHECK(std::string(e.what()).find("paper_bending") != std::string::npos);
      CHECK(std::string(e.what()).find("hanging_sheet") != std::string::npos);
    }
  }
}
