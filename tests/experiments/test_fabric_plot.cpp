// Plots of fabrics.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "fuai/experiments/fabric_plot.h"
#include "fuai/fabric/kes_parameters.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/io/fabric_library.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("every bundled fabric has four panels with units and data in KES units") {
    const auto ids = bundled_fabric_ids();
    CHECK(ids.size() == 8);
    for (const std::string& id : ids) {
      CAPTURE(id);
      const Fabric fabric = load_fabric(id);
      const PlotGrid grid = fabric_plot(fabric, make_fabric_laws(fabric));
      REQUIRE(grid.plots.size() == 4);
      for (const Plot& plot : grid.plots) {
        CHECK(plot.x_label.find('[') != std::string::npos);
        CHECK(!plot.series.empty());
      }
      // Bending over the range of the instrument: 2.5 1/cm.
      CHECK(*std::ranges::max_element(grid.plots[0].series[0].x) == doctest::Approx(2.5));
    }
  }
}

TEST_SUITE("crosscheck") {
  TEST_CASE("the KES parameters of a law's steady loop are the scalars it was made from") {
    for (const char* id :
         {"wool-tropical", "polyester-faille", "cupro-woven-su1098", "cotton-knit-shirley"}) {
      CAPTURE(id);
      const Fabric fabric = load_fabric(id);
      const FabricLaws laws = make_fabric_laws(fabric);
      const SteadyLoop loop = steady_loop(laws.bending[0], kKesBendingRange, 501);
      MeasuredCurve curve;
      curve.branches.resize(2);
      for (std::size_t i = 0; i < 501; ++i) {
        curve.branches[0].samples.push_back({loop.strain[i], loop.stress[i]});
        curve.branches[1].samples.push_back({loop.strain[501 + i], loop.stress[501 + i]});
      }
      const BendingParameters p = compute_bending_parameters(curve);
      CHECK(p.B.mean() == doctest::Approx(fabric.bending[0].B.value).epsilon(1e-9));
      CHECK(p.hysteresis_2HB.mean() == doctest::Approx(fabric.bending[0].hysteresis_2HB.value).epsilon(1e-9));
    }
  }
}
