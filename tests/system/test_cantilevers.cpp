// Cantilevered strips under their own weight and under a load at the tip, against the elastica.
// SPDX-License-Identifier: Apache-2.0
// Source: reference values by shooting, six digits: clamped horizontally, L the free length, w weight an
// area, P load a width; lambda = w L^3 / B, alpha = P L^2 / B.
#include <algorithm>
#include <string>

#include "fuai/core/constants.h"
#include "system/linear_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

/// A load and where the tip of the exact curve is, over L.
struct Elastica {
  double load, ahead, droop;
};

constexpr Elastica kHeavy[] = {{1, .99124640, .12347140},  {4, .89011075, .42515928},
                               {8, .72442473, .64063072},  {20, .44523205, .82988144},
                               {40, .28351886, .89464339}, {64, .20920134, .92011284}};
constexpr Elastica kPointLoaded[] = {{.25, .99588218, .08274592}, {.5, .98408104, .16214358},
                                     {1, .94356676, .30172077},   {2, .83935828, .49345748},
                                     {3, .74557982, .60325344},   {5, .61237164, .71379152},
                                     {10, .44500440, .81060902}};

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
    CHECK(order >= 1.9);
  }
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a strip bent by its own weight is the heavy elastica within 0.1 % at 40 segments") {
    check_strip(kHeavy, false);
  }
  TEST_CASE("a strip bent by a load at its tip is the elastica within 0.1 % at 40 segments") {
    check_strip(kPointLoaded, true);
  }
}

TEST_SUITE("convergence+slow") {
  TEST_CASE("strips bent by their own weight converge with order 2") { check_order(kHeavy, false); }
  TEST_CASE("strips bent by a load at the tip converge with order 2") { check_order(kPointLoaded, true); }
}
