// The fabric library: numbers with their provenance, filters, comparisons in just-noticeable differences.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fuai/core/error.h"
#include "fuai/fabric/assumptions.h"
#include "fuai/io/fabric_library.h"
#include "fuai/laboratory/fabric_comparison.h"
#include "fuai/laboratory/fabric_filter.h"
#include "fuai/laboratory/fabric_numbers.h"
#include "fuai/units/constants.h"

using namespace fuai;

namespace {

std::vector<FabricNumber> numbers_of(const Fabric& fabric) {
  return fabric_numbers(fabric, make_fabric_laws(fabric));
}

const FabricNumber& number(const std::vector<FabricNumber>& all, const std::string& path) {
  const auto found = std::ranges::find_if(all, [&](const FabricNumber& n) { return n.path() == path; });
  REQUIRE(found != all.end());
  return *found;
}

const ComparedNumber& compared(const FabricComparison& comparison, const std::string& path) {
  const auto found = std::ranges::find_if(comparison.numbers,
                                          [&](const ComparedNumber& n) { return n.first().path() == path; });
  REQUIRE(found != comparison.numbers.end());
  return *found;
}

std::vector<std::string> found_by(const FabricFilter& filter) {
  std::vector<std::string> ids;
  for (const std::string& id : bundled_fabric_ids())
    if (passes(filter, load_fabric(id))) ids.push_back(id);
  return ids;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("what the file states stays as it is; what it leaves out is marked as assumed, with the rule") {
    const Fabric wool = load_fabric("wool-tropical");
    const std::vector<FabricNumber> all = numbers_of(wool);
    const FabricNumber& B = number(all, "bending.warp.B_gf_cm2_per_cm");
    CHECK(B.known.value == wool.bending[0].B.value);
    CHECK(B.known.provenance.kind == ProvenanceKind::kMeasured);
    CHECK(B.condition.empty());
    const FabricNumber& G = number(all, "shear.G_gf_per_cm_deg");
    CHECK(G.known.provenance.kind == ProvenanceKind::kAssumed);
    CHECK(G.known.provenance.source == "G was not measured: taken as 0.8 gf/(cm deg)");
    CHECK(G.condition == "under 10 gf/cm");
    // Read off the law along the path of the instrument: exact but for the 401 samples a branch.
    CHECK(G.known.value == doctest::Approx(assumed::kShearG).epsilon(1e-3));
    CHECK(number(all, "shear.2HG_gf_per_cm").known.value ==
          doctest::Approx(assumed::kShearHysteresisAngle * assumed::kShearG).epsilon(1e-3));
    const FabricNumber& EMT = number(all, "tensile.weft.EMT_percent");
    CHECK(EMT.known.value == doctest::Approx(assumed::kEMT).epsilon(1e-9));
    CHECK(EMT.known.provenance.source == "EMT was not measured: taken as 5 %");
    CHECK(EMT.condition == "to 500 gf/cm");
    CHECK(number(all, "tensile.warp.RT_percent").known.value == doctest::Approx(assumed::kRT).epsilon(1e-3));
    const FabricNumber& bias = number(all, "bending.bias.B_gf_cm2_per_cm");
    CHECK(bias.known.provenance.kind == ProvenanceKind::kAssumed);
    CHECK(bias.known.provenance.source.find("no bias test") == 0);
    // Nothing assumes what no law needs.
    CHECK_FALSE(number(all, "surface.MIU").known.has_value());
    CHECK(number(all, "drape.drape_coefficient_percent").condition == "tester not stated");
  }

  TEST_CASE(
      "a number that only a curve shows is computed from it; a WT beside LT and EMT follows from them") {
    Fabric cupro = load_fabric("cupro-woven-su1098");
    const double stated = cupro.tensile[0].EMT.value;
    cupro.tensile[0].EMT = {};
    const FabricNumber EMT = number(numbers_of(cupro), "tensile.warp.EMT_percent");
    CHECK(EMT.known.provenance.kind == ProvenanceKind::kComputed);
    CHECK(EMT.known.value == doctest::Approx(stated).epsilon(1e-9));
    CHECK(EMT.condition == "to 108 gf/cm");
    Fabric wool = load_fabric("wool-tropical");
    const Provenance measured{ProvenanceKind::kMeasured, "me", ""};
    wool.tensile[0].LT = {0.6, measured};
    wool.tensile[0].EMT = {0.04, measured};
    wool.tensile[0].peak_load = {500.0 * unit::kGfPerCm, measured};
    const FabricNumber WT = number(numbers_of(wool), "tensile.warp.WT_gf_cm_per_cm2");
    CHECK(WT.known.provenance.kind == ProvenanceKind::kComputed);
    // LT Fm EMT / 2; the trapezoidal sum of an exponential over 400 steps is off by less than 1e-5.
    CHECK(WT.in_kes_units() == doctest::Approx(0.6 * 500.0 * 0.04 / 2.0).epsilon(1e-4));
  }

  TEST_CASE("filters: words, what was measured, mass") {
    CHECK(found_by({}) == bundled_fabric_ids());
    CHECK(found_by({{"WOOL"}, {}}) == Names{"wool-tropical"});
    CHECK(found_by({{"matsudaira", "faille"}, {}}) == Names{"polyester-faille"});
    CHECK(found_by({{"no such word"}, {}}).empty());
    CHECK(found_by({{}, {"shear"}}) == Names{"cotton-knit-shirley", "cupro-woven-su1098"});
    CHECK(found_by({{}, {"bending", "drape"}}) == Names{"polyester-faille", "wool-tropical"});
    FabricFilter heavy;
    heavy.least_mass = 0.25;
    CHECK(found_by(heavy) == Names{"cotton-knit-shirley"});
    FabricFilter exact;
    exact.least_mass = exact.most_mass = load_fabric("graded-1").areal_mass.value;
    CHECK(found_by(exact) == Names{"graded-1", "graded-3", "graded-6", "graded-10"});
  }

  TEST_CASE("two to six fabrics are compared, no fewer and no more") {
    const std::vector<Fabric> seven(7, load_fabric("graded-1"));
    for (std::size_t count = 0; count <= seven.size(); ++count) {
      const bool allowed = count >= 2 && count <= 6;
      CAPTURE(count);
      if (allowed) {
        CHECK(compare_fabrics({seven.data(), count}, {}).fabrics.size() == count);
      } else {
        CHECK_THROWS_AS(compare_fabrics({seven.data(), count}, {}), Error);
      }
    }
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("just-noticeable steps add up, and there and back are the same") {
    Threshold fraction;
    fraction.value = 0.22;
    CHECK(just_noticeable_steps(fraction, 1.0, 1.22) == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(just_noticeable_steps(fraction, 2.0, 2.0) == 0.0);
    const double there = just_noticeable_steps(fraction, 0.05, 0.9);
    CHECK(just_noticeable_steps(fraction, 0.9, 0.05) == doctest::Approx(-there).epsilon(1e-12));
    CHECK(just_noticeable_steps(fraction, 0.05, 0.3) + just_noticeable_steps(fraction, 0.3, 0.9) ==
          doctest::Approx(there).epsilon(1e-12));
    CHECK(std::isnan(just_noticeable_steps(fraction, 0.0, 1.0)));
    CHECK(std::isnan(just_noticeable_steps(fraction, 1.0, -1.0)));
    Threshold difference;
    difference.kind = ThresholdKind::kDifference;
    difference.value = 0.86e-6;
    CHECK(just_noticeable_steps(difference, 3.0e-6, 1.28e-6) == doctest::Approx(-2.0).epsilon(1e-12));
  }

  TEST_CASE("differences only between numbers that somebody measured, at one setting") {
    const std::vector<Fabric> fabrics{load_fabric("wool-tropical"), load_fabric("polyester-faille"),
                                      load_fabric("cupro-woven-su1098"), load_fabric("cotton-knit-shirley")};
    const FabricComparison comparison = compare_fabrics(fabrics, bundled_thresholds());
    const ComparedNumber& B = compared(comparison, "bending.warp.B_gf_cm2_per_cm");
    const double wool = fabrics[0].bending[0].B.value, faille = fabrics[1].bending[0].B.value;
    CHECK(B.change[0] == 0.0);
    CHECK(B.change[1] == doctest::Approx(faille / wool - 1.0));
    CHECK(B.jnd[1] == doctest::Approx(std::log(faille / wool) / std::log(1.22)));
    // Friction of bending: a difference, but nobody knows how fine a hand is.
    const ComparedNumber& H = compared(comparison, "bending.warp.2HB_gf_cm_per_cm");
    CHECK_FALSE(std::isnan(H.change[1]));
    CHECK(std::isnan(H.jnd[1]));
    // Both coefficients are known, the testers are not.
    CHECK(std::isnan(compared(comparison, "drape.drape_coefficient_percent").change[1]));
    // The wool's G is assumed, so that nothing can be said of it.
    const ComparedNumber& G = compared(comparison, "shear.G_gf_per_cm_deg");
    CHECK(std::isnan(G.change[2]));
    CHECK(std::isnan(G.jnd[2]));
    // Cupro and knit were both stretched, but to other loads.
    const std::vector<Fabric> stretched{fabrics[2], fabrics[3], fabrics[2]};
    const ComparedNumber EMT =
        compared(compare_fabrics(stretched, bundled_thresholds()), "tensile.warp.EMT_percent");
    CHECK(EMT.first().condition != EMT.each[1].condition);
    CHECK(std::isnan(EMT.change[1]));
    CHECK(EMT.jnd[2] == 0.0);
  }
}
