// Cantilevered strips under their own weight and under a load at the tip, against the elastica.
// SPDX-License-Identifier: Apache-2.0
// Source: reference values of support/elastica_table.h.
#include <algorithm>
#include <string>

#include "fuai/core/constants.h"
#include "support/elastica_table.h"
#include "system/linear_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

/// A load and where the tip of the exact curve is, over L.
struct Elastica {
  double load, ahead, droop;
};

/// The demanded loads of the strip under its own weight.
std::vector<Elastica> heavy() {
  std::vector<Elastica> rows;
  for (const HeavyRow& row : kHeavyRows)
    for (double load : {1.0, 4.0, 8.0, 20.0, 40.0, 64.0})
      if (row.load == load) rows.push_back({row.load, row.reach, row.droop});
  return rows;
}
std::vector<Elastica> point_loaded() {
  std::vector<Elastica> rows;
  for (const PointRow& row : kPointRows) rows.push_back({row.load, row.reach, row.droop});
  return rows;
}

constexpr double kLength = 0.2, kRigidity = 1e-5;  // [m], [N m]

/// Distance of the tip from where it should be, over L.
double tip_error(const Elastica& exact, bool at_the_tip, int segments) {
  const double h = kLength / segments, width = 2.0 * h;
  const double force = exact.load * kRigidity / (kLength * kLength);  // a width [N/m]
  ClothPieceSpec spec;
  spec.outline = make_rectangle_outline(kLength + 2.0 * h, width);
  spec.spacing = h;
  // A load at the tip is cloth that is heavy there; the strip itself weighs a millionth of it.
  const double own = at_the_tip ? 1e-6 * force : force;
  spec.areal_mass = own / (kLength * kStandardGravity);
  spec.clamps = {Clamp{HalfPlaneRegion{Vec2(1.0, 0.0), 2.0 * h}, true}};
  ClothModel model = make_cloth_model(spec);
  if (at_the_tip) {
    const double share[3] = {0.25, 0.5, 0.25};
    for (int row = 0; row < 3; ++row)
      model.node_area[static_cast<Index>(model.slot(model.columns - 1, row))] +=
          share[row] * force * width / (spec.areal_mass * kStandardGravity);
  }
  // The strip is 5e-6 longer at most, and the rounding of its tension stays below 1e-9 of the load.
  const ClothMaterial material =
      linear_material({kRigidity, kRigidity, 0.0, 0.25 * kRigidity}, 2e5 * force, 50.0);
  ClothState state = make_cloth_state(model);
  EquilibriumOptions options;
  options.tolerance = 1e-6;
  options.first_dt = 0.02;
  options.iterations = 3000;  // bending of a long strip is stiff: a step solved by halves creeps
  options.reduction = 1e-3;
  const EquilibriumReport report = find_equilibrium(model, material, state, options);
  CHECK(report.converged);
  const Vec3 tip = state.positions[static_cast<Index>(model.slot(model.columns - 1, 1))];
  const Vec2 off((tip.x() - 2.0 * h) / kLength - exact.ahead, -tip.z() / kLength - exact.droop);
  MESSAGE((at_the_tip ? "point load " : "own weight "), exact.load, ", ", segments, " segments: tip off by ",
          100.0 * off.x(), " % ahead, ", 100.0 * off.y(), " % down; steps ", report.steps);
  return off.norm();
}

void check_strip(std::span<const Elastica> loads, bool at_the_tip) {
  for (const Elastica& exact : loads) {
    CAPTURE(exact.load);
    // Demanded: 0.1 % of the length.
    CHECK(tip_error(exact, at_the_tip, 40) < 1e-3);
  }
}

void check_order(std::span<const Elastica> loads, bool at_the_tip) {
  for (const Elastica& exact : loads) {
    CAPTURE(exact.load);
    std::vector<double> errors;
    for (int segments : {20, 40, 80}) errors.push_back(tip_error(exact, at_the_tip, segments));
    const double order = convergence_order(errors);
    MESSAGE("order ", order);
    // The strip is up to 5e-6 longer than the elastica: an error near that has no order, and stays near it.
    if (errors.front() > 1e-5) {
      CHECK(order >= 1.9);
    } else {
      CHECK(errors.back() < 1e-5);
    }
  }
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a strip bent by its own weight is the heavy elastica within 0.1 % at 40 segments") {
    check_strip(heavy(), false);
  }
  TEST_CASE("a strip bent by a load at its tip is the elastica within 0.1 % at 40 segments") {
    check_strip(point_loaded(), true);
  }
}

TEST_SUITE("convergence+slow") {
  TEST_CASE("strips bent by their own weight converge with order 2") { check_order(heavy(), false); }
  TEST_CASE("strips bent by a load at the tip converge with order 2") { check_order(point_loaded(), true); }
}
