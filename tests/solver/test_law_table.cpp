// The tables that the kernels read against the laws that they were made of.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fuai/fabric/scalar_laws.h"
#include "fuai/solver/law_table.h"
#include "fuai/units/constants.h"
#include "support/small_cloth.h"

using namespace fuai;

namespace {

/// Largest distance of table and law over the measured range, elastic part or friction, over the peak.
double misfit(const PlayLaw& law) {
  const LawTable<double> table(law);
  const LawTableView<double> view = table.view();
  const double low = law.elastic().low(), high = law.elastic().high();
  double worst = 0.0, peak = 0.0;
  constexpr int kPlaces = 20011;  // a prime: places fall everywhere in the pieces
  for (int i = 0; i < kPlaces; ++i) {
    const double x = low + (high - low) * (i + 0.5) / kPlaces, u = (x - low) / view.step;
    const double* piece = view.pieces + 4 * static_cast<std::ptrdiff_t>(std::floor(u));
    const double along = (u - std::floor(u)) * view.step, value = law.elastic().evaluate(x).value;
    worst = std::max(worst, std::abs(piece[0] + piece[1] * along - value));
    worst = std::max(worst, std::abs(piece[2] + piece[3] * along - law.friction().evaluate(x).value));
    peak = std::max(peak, std::abs(value));
  }
  return worst / peak;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("tables of KES laws follow them to 1e-4 of the peak") {
    // The bound is that of law_table.cpp; it looks in the middles, where a cubic bows nearly most.
    for (double LT : {0.5, 0.7, 1.0})
      CHECK(misfit(make_tensile_law(LT, 0.6, 0.05, 500.0 * unit::kGfPerCm)) < 1.1e-4);
    const ClothMaterial material = fuai_test::uneven_material();
    CHECK(misfit(material.shear) < 1.1e-4);
    CHECK(misfit(material.warp_bending) < 1.1e-4);
  }

  TEST_CASE("straight laws are held exactly") {
    CHECK(misfit(fuai_test::straight_law(3.0, 0.4, 0.2)) < 1e-14);  // rounding
  }

  TEST_CASE("a curve with a sharp turn gets more pieces, not without end") {
    std::vector<double> elastic(401), friction(401, 1.0);
    for (std::size_t i = 0; i < elastic.size(); ++i) elastic[i] = static_cast<double>(i);
    elastic[399] -= 100.0, elastic[400] += 100.0;
    const LawTable<double> table(make_play_law(make_curve_table(0.0, 1.0, elastic),
                                               make_curve_table(0.0, 1.0, friction, constant_outside()),
                                               kBendingPlays));
    CHECK(table.view().count == 3200.0);  // 8 times 400: the most below 4096
  }
}
