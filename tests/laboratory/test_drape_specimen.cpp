// The specimen: its cloth, its small differences, and what is refused; the material that a lattice can bear.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "fuai/core/error.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/io/fabric_library.h"
#include "fuai/laboratory/drape_material.h"
#include "fuai/scenes/drape_specimen.h"
#include "fuai/scenes/smooth_noise.h"

using namespace fuai;

namespace {

constexpr DrapeGeometry kCoarse{0.127, 0.254, 0.01};

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double node_area_at(const ClothModel& model, std::size_t slot) { return model.node_area[slot]; }

}  // namespace

TEST_SUITE("property") {
  TEST_CASE("a seed makes the cloth uneven by up to 3 %, and its mass stays") {
    for (std::uint64_t seed : {1, 2, 3, 4, 5}) {
      const ClothModel even = make_drape_model(kCoarse, 0.1, seed, {true, 0.0, 0.0});
      const ClothModel uneven = make_drape_model(kCoarse, 0.1, seed);
      REQUIRE(even.columns == uneven.columns);
      CHECK(even.origin == uneven.origin);
      // The disc's area: a polygon of equal area; sums of some 500 doubles.
      CHECK(std::abs(sum(uneven.node_area) - 0.25 * std::numbers::pi * 0.254 * 0.254) < 1e-12);
      double largest = 0.0;
      for (std::size_t i = 0; i < even.node_area.size(); ++i) {
        if (even.node_area[i] > 0.0)
          largest = std::max(largest, std::abs(node_area_at(uneven, i) / node_area_at(even, i) - 1.0));
      }
      // Not more than 3 % but for the common factor that keeps the mass, which is within the mean of the
      // noise.
      CHECK(largest < 0.04);
      CHECK(largest > 0.015);
    }
  }

  TEST_CASE("a seed means the same on every lattice, and another one something else") {
    const DrapeGeometry fine{0.127, 0.254, 0.005};
    const auto speed_at = [](const DrapeGeometry& g, std::uint64_t seed, const Vec2& point) {
      const ClothModel model = make_drape_model(g, 0.1, seed, {false, 0.03, 0.03});
      const ClothState state = make_drape_start(g, model, seed);
      const Vec2 place = (point - model.origin) / g.spacing;
      return state
          .velocities[static_cast<std::size_t>(
              model.slot(static_cast<int>(std::lround(place.x())), static_cast<int>(std::lround(place.y()))))]
          .z();
    };
    // A slot of both lattices: the low corner of the specimen's box is one of each.
    const Vec2 point(-0.127 + 0.03, -0.127 + 0.10);
    CHECK(speed_at(kCoarse, 1, point) == doctest::Approx(speed_at(fine, 1, point)).epsilon(1e-9));
    CHECK(speed_at(kCoarse, 1, point) != doctest::Approx(speed_at(kCoarse, 2, point)).epsilon(1e-3));
  }

  TEST_CASE("at the start the cloth is flat, moves up and down by at most 3 cm/s, and is still on the disc") {
    const ClothModel model = make_drape_model(kCoarse, 0.1, 7);
    const ClothState state = make_drape_start(kCoarse, model, 7);
    double fastest = 0.0;
    for (std::size_t i = 0; i < state.velocities.size(); ++i) {
      CHECK(state.positions[i].z() == 0.0);
      CHECK(state.velocities[i].head<2>().norm() == 0.0);
      if (model.fixed[i] != 0) CHECK(state.velocities[i].z() == 0.0);
      fastest = std::max(fastest, std::abs(state.velocities[i].z()));
    }
    CHECK(fastest <= 0.03);
    CHECK(fastest > 0.015);
    // Two slots are held on every yarn that enters the disc: half a spacing beyond its edge too.
    for (int slot = 0; slot < model.slot_count(); ++slot) {
      const double r = model.material(slot % model.columns, slot / model.columns).norm();
      if (r < 0.0635) CHECK(model.fixed[static_cast<std::size_t>(slot)] == 1);
      if (r > 0.0635 + 0.005) CHECK(model.fixed[static_cast<std::size_t>(slot)] == 0);
    }
  }

  TEST_CASE("noise is smooth, spans its range and has its wavelengths") {
    const SmoothNoise noise(5, 0.03, 0.12, 0.15);
    double largest = 0.0, steepest = 0.0, mean = 0.0;
    int count = 0;
    for (double x = -0.15; x <= 0.15; x += 0.0025) {
      for (double y = -0.15; y <= 0.15; y += 0.0025) {
        const double here = noise.at({x, y});
        largest = std::max(largest, std::abs(here));
        steepest = std::max(steepest, std::abs(noise.at({x + 1e-4, y}) - here) / 1e-4);
        mean += here;
        ++count;
      }
    }
    CHECK(largest > 0.9);
    CHECK(largest <= 1.0);
    // Every wave at its steepest at once, the shortest length: 2 pi / 3 cm times the sum of amplitudes, of
    // which the largest value is at least 1 / sqrt(24).
    CHECK(steepest < 2.0 * std::numbers::pi / 0.03 * std::sqrt(24.0));
    CHECK(steepest > 2.0 * std::numbers::pi / 0.12 * 0.2);
    CHECK(std::abs(mean / count) < 0.2);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("sizes that make no sense are refused") {
    const auto refused = [](const DrapeGeometry& g, const char* says) {
      try {
        make_drape_model(g, 0.1, 1);
        FAIL("accepted");
      } catch (const Error& e) {
        CHECK(e.kind() == ErrorKind::kUsage);
        CHECK(std::string(e.what()).find(says) != std::string::npos);
      }
    };
    refused({0.3, 0.18, 0.005}, "smaller than the specimen");
    refused({0.0, 0.18, 0.005}, "smaller than the specimen");
    refused({0.18, 0.18, 0.005}, "smaller than the specimen");
    refused({0.18, std::nan(""), 0.005}, "smaller than the specimen");
    refused({0.18, 0.30, 0.021}, "the spacing does not suit");
    refused({0.18, 0.30, 0.0}, "the spacing does not suit");
    refused({0.03, 0.30, 0.01}, "the spacing does not suit");
    CHECK(fits({0.18, 0.30, 0.02}));
  }

  TEST_CASE("a yarn is capped where k h^4 / (B c^2) passes 1000, never below 200 N/m, and says so") {
    const FabricLaws laws = make_fabric_laws(load_fabric("wool-tropical"));
    const double B = bending_rigidity(laws.bending[0]);
    const double c = std::cbrt(B / (laws.areal_mass * kStandardGravity));
    const DrapeMaterial fine = make_drape_material(laws, 0.002, false);
    CHECK(!fine.capped());
    for (double h : {0.004, 0.005, 0.006}) {
      const DrapeMaterial made = make_drape_material(laws, h, false);
      CHECK(made.capped());
      for (const YarnLocking& yarn : made.locking) {
        CHECK(yarn.limit * std::pow(h, 4) / (B * c * c) == doctest::Approx(1000.0).epsilon(1e-12));
        CHECK(yarn.factor * yarn.stiffness == doctest::Approx(yarn.limit).epsilon(1e-12));
      }
      // The laws: stiffness within the strain of a drape is the limit, of the elastic curve and friction
      // alike; bending and shear are untouched.
      double stiffest = 0.0;
      for (int i = 1; i <= 50; ++i)
        stiffest = std::max(stiffest, made.material.warp_tension.stick_tangent(1e-4 * i));
      CHECK(stiffest ==
            doctest::Approx(made.locking[0].limit).epsilon(1e-3));  // the onset's table has its own nodes
      CHECK(made.material.warp_bending.evaluate(30.0, {}).stress ==
            fine.material.warp_bending.evaluate(30.0, {}).stress);
    }
    CHECK(make_drape_material(laws, 0.02, false).locking[0].limit == 200.0);
  }

  TEST_CASE("variants put what was assumed to its ends and nothing else") {
    const FabricLaws laws = make_fabric_laws(load_fabric("polyester-faille"));
    CHECK(twist_is_assumed(laws));
    CHECK(shear_is_assumed(laws));
    const FabricLaws cupro = make_fabric_laws(load_fabric("cupro-woven-su1098"));
    CHECK(!twist_is_assumed(cupro));
    CHECK(!shear_is_assumed(cupro));
    const auto made = [&](DrapeVariant variant, bool elastic = false) {
      return make_drape_material(laws, 0.005, elastic, variant).material;
    };
    const ClothMaterial as_is = made(DrapeVariant::kNone);
    const double B = bending_rigidity(laws.bending[0]);  // warp and weft are the same here
    CHECK(as_is.twist_stiffness == doctest::Approx(0.25 * B).epsilon(1e-9));
    CHECK(made(DrapeVariant::kNoTwist).twist_stiffness == 0.0);
    CHECK(made(DrapeVariant::kMostTwist).twist_stiffness == doctest::Approx(0.5 * B).epsilon(1e-9));
    const double gamma = 0.05;  // on the straight part of the law, all plays slipped
    // Read in the shear test under its tension, as the fabric's own numbers are.
    const auto sheared = [&](double G_gf_per_cm_deg) {
      const double G = G_gf_per_cm_deg * unit::kGfPerCmDeg, hysteresis = G * 1.5 * unit::kDegree;
      return make_shear_law(G, hysteresis, hysteresis, laws.shear_test).evaluate(gamma, {}).stress;
    };
    CHECK(as_is.shear.evaluate(gamma, {}).stress == doctest::Approx(sheared(0.8)).epsilon(1e-9));
    CHECK(made(DrapeVariant::kLeastShear).shear.evaluate(gamma, {}).stress ==
          doctest::Approx(sheared(0.3)).epsilon(1e-9));
    CHECK(made(DrapeVariant::kMostShear).shear.evaluate(gamma, {}).stress ==
          doctest::Approx(sheared(2.0)).epsilon(1e-9));
    CHECK(made(DrapeVariant::kMostShear).twist_stiffness == as_is.twist_stiffness);
    // Without friction: the bending moment falls by half of 2HB once all plays have slipped.
    const double curvature = 100.0, hysteresis = 0.007 * unit::kGfCmPerCm;
    CHECK(as_is.warp_bending.evaluate(curvature, {}).stress -
              made(DrapeVariant::kNone, true).warp_bending.evaluate(curvature, {}).stress ==
          doctest::Approx(0.5 * hysteresis).epsilon(1e-9));
  }
}
