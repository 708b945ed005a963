// Plates of cloth in small deflection: squares and the annulus, against the plate theory.
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/LU>
#include <array>
#include <numbers>
#include <random>
#include <string>

#include "fuai/cloth/material_point.h"
#include "system/linear_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr Plate kIsotropic{1.0, 1.0, 0.3, 0.35}, kOrthotropic{0.15, 0.08, 0.02, 0.03},
    kNoTwist{1.0, 1.0, 0.0, 0.0};

/// Of tension and shear [N/m]. Deflections w are so small that the membrane has no part in them: k w^2 / B is
/// below 1e-5, and so is the square of the slope; and so large that its rounding, 1e-16 k, is far below the
/// weight of a slot.
constexpr double kMembrane = 1.0;

/// Deflection in the middle of a unit square under unit pressure.
double square_deflection(const Plate& plate, bool clamped, int cells) {
  const double h = 1.0 / cells, rim = clamped ? h : 0.0, g = 1e-2;
  ClothPieceSpec spec;
  spec.outline = make_rectangle_outline(1.0 + 2.0 * rim, 1.0 + 2.0 * rim);
  spec.spacing = h;
  spec.areal_mass = 1.0;
  if (clamped) {
    for (const Vec2& normal : {Vec2(1.0, 0.0), Vec2(0.0, 1.0)}) {
      spec.clamps.push_back({HalfPlaneRegion{normal, rim}, true});
      spec.clamps.push_back({HalfPlaneRegion{-normal, -1.0 - rim}, true});
    }
  }
  ClothModel model = make_cloth_model(spec);
  for (int slot = 0; !clamped && slot < model.slot_count(); ++slot) {
    const int row = slot / model.columns, column = slot % model.columns;
    if (row == 0 || column == 0 || row == model.rows - 1 || column == model.columns - 1)
      model.fixed[static_cast<Index>(slot)] = 1;
  }
  EquilibriumOptions options = small_deflection(g);
  options.tolerance = 1e-6;
  options.reduction = 1e-7;  // the tolerance alone would leave 5e-6 of the deflection
  ClothState state = make_cloth_state(model);
  const EquilibriumReport report =
      find_equilibrium(model, linear_material(plate, kMembrane, kMembrane), state, options);
  CHECK(report.converged);
  return -state.positions[static_cast<Index>(model.slot(model.columns / 2, model.rows / 2))].z() / g;
}

/// Clamped within `inner`, free at `outer`, isotropic, under pressure q: deflection of the outer edge.
/// w = q r^4 / (64 D) + c0 + c1 ln r + c2 r^2 + c3 r^2 ln r with w = w' = 0 inside, M = Q = 0 outside.
double annulus_deflection(double inner, double outer, double D, double nu, double q) {
  const double K = q / (64.0 * D), a = outer, b = inner, la = std::log(a), lb = std::log(b);
  Eigen::Matrix4d M;
  M << 1.0, lb, b * b, b * b * lb,                                                        //
      0.0, 1.0 / b, 2.0 * b, 2.0 * b * lb + b,                                            //
      0.0, (nu - 1.0) / (a * a), 2.0 + 2.0 * nu, 2.0 * la + 3.0 + nu * (2.0 * la + 1.0),  //
      0.0, 0.0, 0.0, 4.0 / a;
  const Eigen::Vector4d rhs(-K * std::pow(b, 4), -4.0 * K * std::pow(b, 3), -(12.0 + 4.0 * nu) * K * a * a,
                            -32.0 * K * a);
  const Eigen::Vector4d c = M.inverse() * rhs;
  return K * std::pow(a, 4) + c[0] + c[1] * la + c[2] * a * a + c[3] * a * a * la;
}

/// Deflection of the border over the exact one.
struct Edge {
  double mean = 0.0, low = 1e300, high = 0.0;
};

Edge annulus_edge(double spacing, const Vec2& shift) {
  const double inner = 0.09, outer = 0.15, D = 1e-5, nu = 0.3, g = 1e-5;
  ClothPieceSpec spec;
  spec.outline = make_disc_outline(2.0 * outer);
  spec.spacing = spacing;
  spec.areal_mass = 0.1;
  spec.lattice_shift = shift;
  spec.clamps = {Clamp{DiscRegion{Vec2(0.0, 0.0), inner}, true}};
  const ClothModel model = make_cloth_model(spec);
  EquilibriumOptions options = small_deflection(g);
  options.tolerance = 1e-6;
  ClothState state = make_cloth_state(model);
  const ClothMaterial material = linear_material({D, D, nu * D, 0.5 * (1.0 - nu) * D}, kMembrane, kMembrane);
  CHECK(find_equilibrium(model, material, state, options).converged);
  const double exact = annulus_deflection(inner, outer, D, nu, spec.areal_mass * g);
  Edge edge;
  for (const MaterialPoint& point : model.border) {
    const double z = -material_position(point, state.positions).z() / exact;
    edge.mean += z / static_cast<double>(model.border.size());
    edge.low = std::min(edge.low, z);
    edge.high = std::max(edge.high, z);
  }
  MESSAGE("annulus, ", 1e3 * spacing, " mm, shift ", shift.x(), " ", shift.y(), ": mean ", edge.mean,
          ", from ", edge.low, " to ", edge.high);
  return edge;
}

/// @param mean,uneven bounds on |mean - 1| and on the largest distance from the mean
void check_annulus(double spacing, double mean, double uneven) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 4; ++i) {
    const double x = share(random), y = share(random);
    const Edge edge = annulus_edge(spacing, Vec2(x, y));
    CHECK(std::abs(edge.mean - 1.0) < mean);
    CHECK(std::max(edge.high - edge.mean, edge.mean - edge.low) < uneven);
  }
}

struct Square {
  const char* name;
  Plate plate;
  bool clamped;
  double exact;  ///< deflection in the middle
};

// Navier's series; clamped isotropic: Timoshenko and Woinowsky-Krieger; the other clamped ones extrapolated
// from N = 64 and 128 of an independent solution of the lattice with half a cell at the clamps.
const Square kSquares[] = {{"supported isotropic", kIsotropic, false, .00406235},
                           {"supported orthotropic", kOrthotropic, false, .04170541},
                           {"supported without twist", kNoTwist, false, .00820416},
                           {"clamped isotropic", kIsotropic, true, .00126532},
                           {"clamped orthotropic", kOrthotropic, true, .011810},
                           {"clamped without twist", kNoTwist, true, .0016646}};

}  // namespace

TEST_SUITE("convergence") {
  TEST_CASE("simply supported and clamped squares: order 2, within 0.1 % at 64 cells") {
    for (const Square& square : kSquares) {
      CAPTURE(std::string(square.name));
      // Demanded: 0.1 % at 64 cells. What is left of the clamped ones is so small that it changes its sign on
      // the way, so their order 2 is asked of a curve above the errors.
      const double at_64 = square.clamped ? 3e-4 : 1e-3;
      std::vector<double> errors;
      for (int cells : {16, 32, 64}) {
        errors.push_back(square_deflection(square.plate, square.clamped, cells) / square.exact - 1.0);
        CHECK(std::abs(errors.back()) < at_64 * std::pow(64.0 / cells, 2));
      }
      MESSAGE(std::string(square.name), " ", 100 * errors[0], " ", 100 * errors[1], " ", 100 * errors[2],
              " % order ", convergence_order(errors));
      if (!square.clamped) CHECK(convergence_order(errors) >= 1.9);
    }
  }

  TEST_CASE("the annulus at four random shifts of the lattice: 3 % at 10 mm, 1 % and even at 5 mm") {
    check_annulus(0.01, 0.03, 1.0);
    check_annulus(0.005, 0.01, 0.02);
  }
}

TEST_SUITE("convergence+slow") {
  TEST_CASE("the annulus at four random shifts of the lattice: 0.5 % at 3.75 mm") {
    check_annulus(0.00375, 0.005, 0.02);
  }
}
