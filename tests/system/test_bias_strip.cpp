// Strips cut at an angle to the yarns: which rigidity a free strip and a held sheet show.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md, "Bias".
#include <Eigen/LU>
#include <numbers>
#include <string>

#include "fuai/cloth/material_point.h"
#include "fuai/solver/cloth_energy.h"
#include "system/linear_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

/// Rigidity of a sheet in cylindrical bending about an axis across `angle` [N m]: no curvature along the
/// axis.
double held_rigidity(const Plate& p, double angle) {
  const double c2 = std::pow(std::cos(angle), 2), s2 = 1.0 - c2;
  return p.weft * c2 * c2 + p.warp * s2 * s2 + (2.0 * p.poisson + 4.0 * p.twist) * c2 * s2;
}

/// Rigidity of a narrow strip along `angle` with free sides [N m]: no moment across it and no twisting
/// moment, so its compliances add, 1/B = S11 c^4 + S22 s^4 + (2 S12 + S66) c^2 s^2 with S the inverse of (B1
/// B12; B12 B2) and S66 = 1 / Bt.
double free_rigidity(const Plate& p, double angle) {
  const double c2 = std::pow(std::cos(angle), 2), s2 = 1.0 - c2;
  Eigen::Matrix2d B;
  B << p.weft, p.poisson, p.poisson, p.warp;
  const Eigen::Matrix2d S = B.inverse();
  return 1.0 / (S(0, 0) * c2 * c2 + S(1, 1) * s2 * s2 + (2.0 * S(0, 1) + 1.0 / p.twist) * c2 * s2);
}

constexpr double kUnit = 1e-5;  // [N m]
constexpr double kBias = 0.25 * std::numbers::pi;
/// k w^2 / B and rounding as in test_plates.cpp.
constexpr double kMembrane = 1.0;

/// A narrow strip of `length` cut at 45 degrees, clamped at one end, free elsewhere, under its own weight:
/// rigidity from the curvature in its middle, far from the clamp.
double strip_rigidity(const Plate& plate, double length, double width, double spacing) {
  const double g = 1e-6, held = 4.0 * spacing, mass = 0.1;
  const Vec2 along(std::cos(kBias), std::sin(kBias)), across(-along.y(), along.x());
  ClothPieceSpec spec;
  spec.outline = rotate_outline(make_rectangle_outline(length + held, width), kBias);
  spec.spacing = spacing;
  spec.areal_mass = mass;
  spec.lattice_shift = Vec2(0.3, 0.1);
  spec.clamps = {Clamp{HalfPlaneRegion{along, held}, true}};
  const ClothModel model = make_cloth_model(spec);
  EquilibriumOptions options = small_deflection(g);
  options.tolerance = 1e-5;
  ClothState state = make_cloth_state(model);
  const EquilibriumReport report =
      find_equilibrium(model, linear_material(plate, kMembrane, kMembrane), state, options);
  CHECK(report.converged);
  // Mean deflection across the strip at a distance from the clamp.
  const auto deflection = [&](double x) {
    double sum = 0.0;
    constexpr int kLines = 9;
    for (int i = 0; i < kLines; ++i) {
      const Vec2 at = (held + x) * along + width * (i + 0.5) / kLines * across;
      sum -= material_position(make_material_point(model, at), state.positions).z();
    }
    return sum / kLines;
  };
  // w'' = q (L - x)^2 / (2 B); over a finite reach a the second difference adds q a^2 / (12 B).
  const double x = 0.5 * length, a = 0.2 * length;
  const double second = (deflection(x + a) - 2.0 * deflection(x) + deflection(x - a)) / (a * a);
  return mass * g * (0.5 * (length - x) * (length - x) + a * a / 12.0) / second;
}

/// A wide, short specimen as in the bending tester, its two clamps turned by a small angle into a cylinder:
/// rigidity from the energy of bending.
double specimen_rigidity(const Plate& plate, double length, double width, double spacing) {
  const double held = 3.0 * spacing, angle = 1e-4;
  const Vec2 along(std::cos(kBias), std::sin(kBias));
  ClothPieceSpec spec;
  spec.outline = rotate_outline(make_rectangle_outline(length + 2.0 * held, width), kBias);
  spec.spacing = spacing;
  spec.areal_mass = 0.1;
  spec.lattice_shift = Vec2(0.3, 0.1);
  spec.clamps = {Clamp{HalfPlaneRegion{along, held}, true},
                 Clamp{HalfPlaneRegion{-along, -held - length}, true}};
  const ClothModel model = make_cloth_model(spec);
  ClothState state = make_cloth_state(model);
  for (int slot = 0; slot < model.slot_count(); ++slot) {
    Vec3& x = state.positions[static_cast<Index>(slot)];
    const double s = x.head<2>().dot(along) - held;  // from the first clamp
    if (model.fixed[static_cast<Index>(slot)] != 0)
      x.z() = s > 0.5 * length ? angle * (s - 0.5 * length) : 0.0;
    else
      x.z() = 0.5 * angle / length * s * s;
  }
  const ClothMaterial material = linear_material(plate, kMembrane, kMembrane);
  EquilibriumOptions options = small_deflection(0.0);
  options.gravity = Vec3::Zero();
  options.least_force = 1e-13;
  const EquilibriumReport report = find_equilibrium(model, material, state, options);
  CHECK(report.converged);
  const ClothEnergy energy = cloth_free_energy(model, material, state, Vec3::Zero());
  return 2.0 * (energy.bending + energy.twist) * length / (width * angle * angle);
}

struct Cloth {
  const char* name;
  Plate plate;
};
const Cloth kCloths[] = {{"isotropic", {kUnit, kUnit, 0.3 * kUnit, 0.35 * kUnit}},
                         {"B12 = 0, Bt = B / 4", {kUnit, kUnit, 0.0, 0.25 * kUnit}},
                         {"unlike yarns", {1.5 * kUnit, 0.8 * kUnit, 0.2 * kUnit, 0.3 * kUnit}}};

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a free narrow bias strip shows the inverse of its compliance") {
    for (const Cloth& cloth : kCloths) {
      CAPTURE(std::string(cloth.name));
      const double ratio =
          strip_rigidity(cloth.plate, 0.12, 0.02, 0.0025) / free_rigidity(cloth.plate, kBias);
      const double coarse =
          strip_rigidity(cloth.plate, 0.12, 0.02, 0.005) / free_rigidity(cloth.plate, kBias);
      MESSAGE(std::string(cloth.name), ": free bias strip over 1 / S45 ", ratio, " (5 mm: ", coarse,
              "); S45 B45 ", held_rigidity(cloth.plate, kBias) / free_rigidity(cloth.plate, kBias));
      CHECK(std::abs(ratio - 1.0) < 0.01);
    }
  }

  TEST_CASE("a wide bias specimen between clamps shows B45 of the plate formula") {
    for (const Cloth& cloth : kCloths) {
      CAPTURE(std::string(cloth.name));
      const double ratio =
          specimen_rigidity(cloth.plate, 0.01, 0.1, 0.00125) / held_rigidity(cloth.plate, kBias);
      const double coarse =
          specimen_rigidity(cloth.plate, 0.01, 0.1, 0.0025) / held_rigidity(cloth.plate, kBias);
      MESSAGE(std::string(cloth.name), ": wide bias specimen over B45 ", ratio, " (2.5 mm: ", coarse, ")");
      CHECK(std::abs(ratio - 1.0) < 0.01);
    }
  }
}
