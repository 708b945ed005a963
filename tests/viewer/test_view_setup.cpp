// The factors of the sliders: 1 changes nothing, the others do what their names say and nothing else.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/view_setup.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <limits>

#include "fuai/core/error.h"
#include "fuai/io/curve_csv.h"
#include "fuai/io/fabric_library.h"
#include "fuai/solver/cloth_material.h"
#include "io/io_test_tools.h"

using namespace fuai;

namespace {

constexpr auto kWarp = static_cast<std::size_t>(Direction::kWarp);
constexpr auto kWeft = static_cast<std::size_t>(Direction::kWeft);
constexpr auto kBias = static_cast<std::size_t>(Direction::kBias);

ViewFabric bundled(const std::string& name) {
  ViewFabric fabric;
  fabric.source = name;
  fabric.measured = load_fabric(name);
  return fabric;
}

ViewFabric with(ViewFabric fabric, FabricFactor which, double factor) {
  fabric.factors[static_cast<std::size_t>(which)] = factor;
  return fabric;
}

/// Stress over one loading and unloading, from virgin.
std::vector<double> loop(const PlayLaw& law, double reach) {
  PlayState memory;
  std::vector<double> stress;
  for (int i = -20; i <= 20; ++i)
    stress.push_back(law.advance(reach * (20 - std::abs(i)) / 20.0, memory).stress);
  return stress;
}

void check_ratio(const std::vector<double>& scaled, const std::vector<double>& plain, double ratio) {
  REQUIRE(scaled.size() == plain.size());
  // A product and the same sums of scaled terms: some eps of the largest.
  for (std::size_t i = 0; i < plain.size(); ++i)
    CHECK(scaled[i] == doctest::Approx(ratio * plain[i]).epsilon(1e-12));
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("factors of 1 leave every bit, also when each law is rebuilt") {
    for (const std::string& name : bundled_fabric_ids()) {
      CAPTURE(name);
      const ViewFabric fabric = bundled(name);
      CHECK(!fabric.changed());
      const FabricLaws measured = make_fabric_laws(fabric.measured);
      CHECK(laws_hash(make_view_laws(fabric)) == laws_hash(measured));
      FabricLaws rebuilt = measured;
      for (PlayLaw& law : rebuilt.bending) law = scaled(law, 1.0, 1.0);
      rebuilt.shear = scaled(rebuilt.shear, 1.0, 1.0);
      for (PlayLaw& law : rebuilt.tensile) law = scaled(law, 1.0, 1.0);
      CHECK(laws_hash(rebuilt) == laws_hash(measured));
      for (std::size_t i = 0; i < 3; ++i) {
        // Within the table and well beyond it, and the derived numbers.
        CHECK(loop(rebuilt.bending[i], 900.0) == loop(measured.bending[i], 900.0));
        CHECK(rebuilt.bending[i].max_stick_tangent() == measured.bending[i].max_stick_tangent());
      }
    }
  }

  TEST_CASE("the hash of the laws sees every factor") {
    const ViewFabric fabric = bundled(bundled_fabric_ids().front());
    std::vector<std::uint64_t> hashes{laws_hash(make_view_laws(fabric))};
    for (std::size_t i = 0; i < kFabricFactorCount; ++i) {
      const ViewFabric one = with(fabric, static_cast<FabricFactor>(i), 1.5);
      CHECK(one.changed());
      const std::uint64_t hash = laws_hash(make_view_laws(one));
      for (const std::uint64_t other : hashes) CHECK(hash != other);
      hashes.push_back(hash);
    }
  }

  TEST_CASE("a factor out of range is refused") {
    const ViewFabric fabric = bundled(bundled_fabric_ids().front());
    for (double factor : {0.0, 0.099, 10.1, -1.0, std::numeric_limits<double>::quiet_NaN()})
      CHECK_THROWS_AS(make_view_laws(with(fabric, FabricFactor::kShear, factor)), Error);
    CHECK_NOTHROW(make_view_laws(with(fabric, FabricFactor::kShear, kMostFactor)));
  }

  TEST_CASE("a curve takes the place of what the fabric knows of its test, and of nothing else") {
    const std::string curve = data_folder() + "/fabrics/cupro-woven-su1098.shear.csv";
    const ViewFabric plain = load_view_fabric("wool-tropical");
    const ViewFabric fabric = load_view_fabric("wool-tropical + " + curve);
    CHECK(fabric.source == "wool-tropical + " + curve);
    CHECK(fabric.measured.name == "Wool tropical + cupro-woven-su1098.shear");
    CHECK(fabric.measured.id == "wool-tropical-cupro-woven-su1098.shear");
    REQUIRE(fabric.measured.shear.curve);
    CHECK(fabric.measured.shear.curve->curve.branches.size() == read_curve_csv(curve).branches.size());
    CHECK(fabric.measured.shear.curve->provenance.source == "curve file " + curve);
    CHECK(fabric.measured.areal_mass.value == plain.measured.areal_mass.value);
    const FabricLaws laws = make_view_laws(fabric), before = make_view_laws(plain);
    CHECK(loop(laws.shear, 0.1) != loop(before.shear, 0.1));
    CHECK(loop(laws.bending[kWarp], 300.0) == loop(before.bending[kWarp], 300.0));
    CHECK(loop(laws.tensile[kWeft], 0.1) == loop(before.tensile[kWeft], 0.1));

    // A second curve of the same test wins; the first one, put behind it again, too.
    const std::string other = data_folder() + "/fabrics/cupro-woven-su1098.tensile.warp.csv";
    const std::string twice = with_curve(with_curve(fabric.source, other), curve);
    CHECK(twice == "wool-tropical + " + other + " + " + curve);
    const FabricLaws both = make_view_laws(load_view_fabric(twice));
    CHECK(loop(both.shear, 0.1) == loop(laws.shear, 0.1));
    CHECK(loop(both.tensile[kWarp], 0.01) != loop(before.tensile[kWarp], 0.01));
  }

  TEST_CASE("names of files may hold the mark of a curve") {
    const test::TemporaryFolder folder;
    const std::string curve = folder / "warp + weft.csv", cloth = folder / "wool + silk.fabric.toml";
    std::filesystem::copy(data_folder() + "/fabrics/cupro-woven-su1098.shear.csv", curve);
    std::filesystem::copy(data_folder() + "/fabrics/wool-tropical.fabric.toml", cloth);
    CHECK(load_view_fabric(cloth).measured.name == "Wool tropical");
    CHECK(load_view_fabric(cloth + " + " + curve).measured.name == "Wool tropical + warp + weft");
    CHECK(load_view_fabric("wool-tropical + " + curve).measured.shear.curve);
    CHECK(with_curve("a + b.csv + b.csv.csv", "b.csv") == "a + b.csv.csv + b.csv");
  }

  TEST_CASE("a curve alone and one that is not there are refused with a cure") {
    const std::string curve = data_folder() + "/fabrics/cupro-woven-su1098.shear.csv";
    CHECK_THROWS_WITH_AS(load_view_fabric(curve), doctest::Contains("name the fabric before it"), Error);
    CHECK_THROWS_WITH_AS(load_view_fabric("wool-tropical + nosuch.csv"), doctest::Contains("nosuch.csv"),
                         Error);
    CHECK_THROWS_WITH_AS(load_view_fabric("nosuch + " + curve), doctest::Contains("nosuch"), Error);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("each factor multiplies its number") {
    for (const std::string& name : {std::string("cupro-woven-su1098"), bundled_fabric_ids().back()}) {
      CAPTURE(name);
      const ViewFabric fabric = bundled(name);
      const FabricLaws plain = make_view_laws(fabric);
      const auto changed = [&](FabricFactor which, double factor) {
        return make_view_laws(with(fabric, which, factor));
      };
      CHECK(changed(FabricFactor::kWeight, 3.0).areal_mass == 3.0 * plain.areal_mass);

      const FabricLaws warp = changed(FabricFactor::kWarpBending, 2.0);
      CHECK(bending_rigidity(warp.bending[kWarp]) ==
            doctest::Approx(2.0 * bending_rigidity(plain.bending[kWarp])).epsilon(1e-12));
      CHECK(bending_rigidity(warp.bending[kWeft]) == bending_rigidity(plain.bending[kWeft]));
      CHECK(warp.bending[kWarp].friction().nodes().front() ==
            plain.bending[kWarp].friction().nodes().front());

      const FabricLaws friction = changed(FabricFactor::kBendingFriction, 0.25);
      for (const std::size_t i : {kWarp, kWeft}) {
        CHECK(friction.bending[i].friction().evaluate(100.0).value ==
              doctest::Approx(0.25 * plain.bending[i].friction().evaluate(100.0).value).epsilon(1e-12));
        CHECK(bending_rigidity(friction.bending[i]) == bending_rigidity(plain.bending[i]));
      }

      // Both together: the whole loop, in the table and beyond, keeps its shape.
      ViewFabric both = with(fabric, FabricFactor::kShear, 4.0);
      both = with(both, FabricFactor::kShearFriction, 4.0);
      check_ratio(loop(make_view_laws(both).shear, 0.5), loop(plain.shear, 0.5), 4.0);
      check_ratio(loop(changed(FabricFactor::kWarpTension, 0.5).tensile[kWarp], 0.2),
                  loop(plain.tensile[kWarp], 0.2), 0.5);
      CHECK(loop(changed(FabricFactor::kWarpTension, 0.5).tensile[kWeft], 0.2) ==
            loop(plain.tensile[kWeft], 0.2));
    }
  }

  TEST_CASE("warp and weft scaled alike scale the twist alike, one alone by the root") {
    ViewFabric fabric;
    double twist = 0.0;
    for (const std::string& name : bundled_fabric_ids()) {
      if (twist > 0.0) break;
      fabric = bundled(name);
      twist = make_cloth_material(make_view_laws(fabric)).twist_stiffness;
    }
    REQUIRE(twist > 0.0);
    ViewFabric both = with(fabric, FabricFactor::kWarpBending, 5.0);
    CHECK(make_cloth_material(make_view_laws(both)).twist_stiffness ==
          doctest::Approx(std::sqrt(5.0) * twist).epsilon(1e-9));
    both = with(both, FabricFactor::kWeftBending, 5.0);
    // Differences of rigidities a few times the twist: some 1e-15 more.
    CHECK(make_cloth_material(make_view_laws(both)).twist_stiffness ==
          doctest::Approx(5.0 * twist).epsilon(1e-9));
    CHECK(bending_rigidity(make_view_laws(both).bending[kBias]) > 0.0);
  }
}
