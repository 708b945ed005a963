// The paper's drape against the reference numbers, elastic, with memory, and as printed.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fuai/core/error.h"
#include "fuai/scenes/paper_drape.h"
#include "support/linear_laws.h"

using namespace fuai;

namespace {

/// Stand-in i of the paper's four fabrics; without friction when `elastic`.
FabricLaws four_laws(std::size_t i, bool elastic) {
  return fuai_test::linear_laws(fuai_test::kFourB[i], elastic ? 0.0 : fuai_test::kFourHB[i],
                                fuai_test::kFourMass_g_per_m2);
}

double corner_z_cm(const PaperDrape& drape) { return drape.free_corner().z() / unit::kCentimetre; }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the drape is the paper's and starts flat") {
    const PaperDrape drape = make_paper_drape(four_laws(0, true));
    CHECK(drape.model->columns == 18);
    CHECK(drape.model->rows == 18);
    int fixed = 0;
    for (auto f : drape.model->fixed) fixed += f;
    CHECK(fixed == 25);
    CHECK(drape.free_corner() == Vec3(17 * 0.01, 17 * 0.01, 0.0));
    PaperDrapeOptions fine;
    fine.spacing = 0.005;
    CHECK(make_paper_drape(four_laws(0, true), fine).model->columns == 35);
    fine.fixed_edge = 0.17;
    CHECK_THROWS_AS(make_paper_drape(four_laws(0, true), fine), Error);
  }

  TEST_CASE("three hundred steps, the paper's half minute, are nowhere near the drape") {
    PaperDrape drape = make_paper_drape(four_laws(2, true));
    RelaxationStop stop;
    stop.max_steps = 300;
    const RelaxationResult result = drape.solver.run(drape.state, stop);
    CHECK_FALSE(result.converged);
    CHECK(corner_z_cm(drape) == doctest::Approx(-0.04).epsilon(0.15));  // reference: -0.04 cm of -17.6
  }
}

TEST_SUITE("golden+slow") {
  TEST_CASE("elastic drape: the free corner hangs where the reference says") {
    // B = 0.02, 0.06, 0.12, 0.20 gf cm2/cm, W = 0.020 gf/cm2, k = 10 gf/cm, springs and triples whole.
    const double reference_cm[] = {-18.62, -18.32, -17.59, -17.05};
    const double most_steps[] = {5.5e5, 4.5e5, 3.5e5, 4.5e5};  // reference 4.6e5, 3.6e5, 2.7e5, 3.7e5
    for (std::size_t i = 0; i < 4; ++i) {
      PaperDrapeOptions options;
      options.relaxation.area_weights = AreaWeights::kWeightOnly;
      PaperDrape drape = make_paper_drape(four_laws(i, true), options);
      const RelaxationResult result = drape.solver.run(drape.state);
      MESSAGE("elastic " << i << ": " << result.steps << " steps, corner z " << corner_z_cm(drape)
                         << " cm, stretch " << result.max_stretch);
      CHECK(result.converged);
      CHECK(static_cast<double>(result.steps) < most_steps[i]);
      CHECK(std::abs(corner_z_cm(drape) - reference_cm[i]) < 0.1);  // the tolerance of the reference
      CHECK(result.max_stretch == doctest::Approx(0.24).epsilon(0.1));
    }
  }

  TEST_CASE("drape with friction memory converges for all four fabrics, the stiffer the higher") {
    double last = -1e9;
    for (std::size_t i = 0; i < 4; ++i) {
      PaperDrape drape = make_paper_drape(four_laws(i, false));
      const RelaxationResult result = drape.solver.run(drape.state);
      MESSAGE("memory " << i << ": " << result.steps << " steps, corner z " << corner_z_cm(drape)
                        << " cm, stretch " << result.max_stretch);
      CHECK(result.converged);
      CHECK(result.residual < 1e-3);
      const double side = drape.state.positions[17].z();
      CHECK(side > last);  // the corners beside the table tell the fabrics apart best
      last = side;
    }
  }

  TEST_CASE("as printed the drape never comes to rest, and stiff cloth bulges instead of hanging") {
    for (std::size_t i : {std::size_t{0}, std::size_t{3}}) {
      PaperDrapeOptions options;
      options.relaxation.mode = PaperMode::kAsPrinted;
      PaperDrape drape = make_paper_drape(four_laws(i, false), options);
      RelaxationStop stop;
      stop.max_steps = 50'000;
      double least = 1e9;
      for (int look = 0; look < 6; ++look) {
        const RelaxationResult result = drape.solver.run(drape.state, stop);
        CHECK((result.status & kRelaxationNotFinite) == 0);
        CHECK_FALSE(result.converged);
        least = std::min(least, result.residual);
        stop.max_steps = 10'000;
      }
      MESSAGE("as printed " << i << ": least residual " << least << " node weights, corner z "
                            << corner_z_cm(drape) << " cm");
      // Each triple pushes its ends by HB / 2 and lets go again: with HB = 0.07 gf that is many weights of
      // 0.02 gf. The limp sheet, HB = 0.01 gf, is held nearly still by its weight. Seen: 0.007 and 4.9.
      if (i == 3) {
        CHECK(least > 1.0);
        CHECK(corner_z_cm(drape) > -5.0);
      }
    }
  }
}
