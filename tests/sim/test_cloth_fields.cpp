// The fields that are shown: closed forms of each measure, friction included, and that the energy adds up.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/sim/cloth_fields.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "fuai/solver/cloth_energy.h"
#include "support/allocation_guard.h"
#include "support/small_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr double kH = 0.01;
constexpr double kStiffness = 3e-5, kFriction = 2e-4, kReach = 250.0;  // bending: [N m], [N], [1/m]

/// Bending with numbers that can be done in the head; the rest uneven.
ClothMaterial plain_material() {
  ClothMaterial material = uneven_material();
  material.weft_bending = straight_law(kStiffness, kFriction, kReach);
  material.warp_bending = straight_law(2.0 * kStiffness, 3.0 * kFriction, kReach);
  return material;
}

std::vector<double> field_of(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                             ClothField field) {
  std::vector<double> values(static_cast<Index>(model.slot_count()), 7.0);
  evaluate_field(model, material, state, field, values);
  return values;
}

/// Largest distance of the slots from a value; what is not a number is left out.
double off(const std::vector<double>& values, double expected) {
  double worst = 0.0;
  for (double v : values)
    if (!std::isnan(v)) worst = std::max(worst, std::abs(v - expected));
  return worst;
}

std::ptrdiff_t blanks(const std::vector<double>& values) {
  return std::count_if(values.begin(), values.end(), [](double v) { return std::isnan(v); });
}

/// Every slot moved, and the memory of the laws with it.
template <class Place>
void shape(const ClothModel& model, const ClothMaterial& material, ClothState& state, const Place& place) {
  for (int row = 0; row < model.rows; ++row) {
    for (int column = 0; column < model.columns; ++column)
      state.positions[static_cast<Index>(model.slot(column, row))] = place(model.material(column, row));
  }
  commit_cloth(model, material, state.positions, state);
}

/// On a cylinder about the warp, chords of length h, toward the face. The curvature is the turn of a chord
/// over its length.
double roll(const ClothModel& model, const ClothMaterial& material, ClothState& state, double curvature) {
  const double turn = curvature * model.spacing, radius = 0.5 * model.spacing / std::sin(0.5 * turn);
  shape(model, material, state, [&](const Vec2& m) {
    const double angle = turn * m.x() / model.spacing;
    return Vec3(radius * std::sin(angle), m.y(), radius * (1.0 - std::cos(angle)));
  });
  return turn / model.spacing;
}

ClothState crumpled(const ClothModel& model, const ClothMaterial& material) {
  std::mt19937 random(3);
  ClothState state = flat_state(model);
  for (int k = 0; k < 3; ++k) {
    jitter(state.positions, 0.05 * kH, random);
    commit_cloth(model, material, state.positions, state);
  }
  for (Vec3& v : state.velocities) v = Vec3(0.3, -0.4, 1.2);
  return state;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("a sheet stretched alike everywhere shows its strains and stresses in every slot") {
    const ClothModel model = sheet_model(6, 7, kH, 0.15);
    const ClothMaterial material = plain_material();
    ClothState state = flat_state(model);
    const double weft = 0.012, warp = 0.007;
    shape(model, material, state,
          [&](const Vec2& m) { return Vec3((1.0 + weft) * m.x(), (1.0 + warp) * m.y(), 0.0); });
    // Rounding of coordinates of 6 cm against edges of 1 cm: 6 eps, and a mean of up to four of them.
    CHECK(off(field_of(model, material, state, ClothField::kWeftStrain), weft) < 1e-14);
    CHECK(off(field_of(model, material, state, ClothField::kWarpStrain), warp) < 1e-14);
    CHECK(off(field_of(model, material, state, ClothField::kShearAngle), 0.0) < 1e-14);
    const double stress = material.weft_tension.evaluate(weft, state.weft_tension[0]).stress;
    // The stiffest tangent times that strain error.
    CHECK(off(field_of(model, material, state, ClothField::kWeftStress), stress) <
          1e-14 * material.weft_tension.max_stick_tangent());
    CHECK(stress > 1.0);
  }

  TEST_CASE("a sheet sheared alike shows the angle and its stress in every slot, and no strain") {
    const ClothModel model = sheet_model(6, 7, kH, 0.15);
    const ClothMaterial material = plain_material();
    ClothState state = flat_state(model);
    const double angle = 0.2;
    shape(model, material, state,
          [&](const Vec2& m) { return Vec3(m.x() + std::sin(angle) * m.y(), std::cos(angle) * m.y(), 0.0); });
    // The series of the arc sine leaves out 35/1152 s^9 = 1.5e-8.
    CHECK(off(field_of(model, material, state, ClothField::kShearAngle), angle) < 2e-8);
    CHECK(off(field_of(model, material, state, ClothField::kWarpStrain), 0.0) < 1e-14);
    const double stress = material.shear.evaluate(angle, state.shear[0]).stress;
    CHECK(off(field_of(model, material, state, ClothField::kShearStress), stress) < 1e-6 * stress);
    CHECK(stress > 1.0);
  }

  TEST_CASE("on a cylinder: its curvature, the elastic moment, and friction on either side of it") {
    const ClothModel model = sheet_model(8, 6, kH, 0.15);
    ClothMaterial material = plain_material();
    ClothState state = flat_state(model);
    const double far = 40.0, near = 20.0;
    roll(model, material, state, far);
    const double bent = roll(model, material, state, near);
    const std::vector<double> curvature = field_of(model, material, state, ClothField::kWeftCurvature);
    // The arc tangent is met to O(t^7), t = tan(0.1): 1e-7 of it at most.
    CHECK(off(curvature, bent) < 1e-6 * bent);
    CHECK(blanks(curvature) == 2 * model.rows);  // no triple in the first and last column
    // Across the cylinder the sheet is straight, but for rounding: a thousandth of a thousandth is far more.
    CHECK(off(field_of(model, material, state, ClothField::kWarpCurvature), 0.0) < 1e-9);

    // Come back by 20 1/m: plays of 12.5 slip partly, those of 50 and 125 stick. The law on its own says
    // where.
    PlayState alone, fresh;
    material.weft_bending.commit(far, alone);
    const double back = material.weft_bending.advance(near, alone).stress;
    const double elastic = kStiffness * near;
    CHECK(back < material.weft_bending.evaluate(near, fresh).stress - 0.1 * kFriction);
    CHECK(off(field_of(model, material, state, ClothField::kWeftMoment), back) < 1e-6 * elastic);

    // Where every play slips, 2 r = 20 1/m apart, friction has its full strength: M = B K +- HB.
    material.weft_bending = straight_law(kStiffness, kFriction, 20.0);
    ClothState slipped = flat_state(model);
    roll(model, material, slipped, 30.0);
    CHECK(off(field_of(model, material, slipped, ClothField::kWeftMoment), kStiffness * 30.0 + kFriction) <
          1e-6 * kStiffness * 30.0);
    roll(model, material, slipped, 9.0);
    CHECK(off(field_of(model, material, slipped, ClothField::kWeftMoment), kStiffness * 9.0 - kFriction) <
          1e-6 * kStiffness * 9.0);

    // Without friction there is one moment.
    material.weft_bending = straight_law(kStiffness, 0.0, kReach);
    CHECK(off(field_of(model, material, state, ClothField::kWeftMoment), elastic) < 1e-6 * elastic);
  }

  TEST_CASE("a probe of a patch shows what the cloth there shows") {
    const ClothModel model = sheet_model(8, 6, kH, 0.15);
    const ClothMaterial material = plain_material();
    ClothState state = flat_state(model);
    const double bent = roll(model, material, state, 30.0);
    const std::array slots{model.slot(3, 2), model.slot(4, 2), model.slot(0, 2)};  // the last has no triple
    const std::array weights{0.5, 0.25, 0.25};
    const ClothProbe probe = probe_cloth(model, material, state, slots, weights);
    CHECK(probe.weft_bending.strain == doctest::Approx(bent).epsilon(1e-6));
    const double moment =
        field_of(model, material, state, ClothField::kWeftMoment)[static_cast<Index>(slots[0])];
    CHECK(probe.weft_bending.stress == doctest::Approx(moment).epsilon(1e-9));
    CHECK(std::abs(probe.warp_bending.strain) < 1e-9);
    CHECK(std::abs(probe.weft_tension.strain) < 1e-14);

    // Strained more and more along the weft: the edge between the first two has most of the patch.
    shape(model, material, state,
          [&](const Vec2& m) { return Vec3(m.x() + 0.5 * m.x() * m.x(), m.y(), 0.0); });
    const std::vector<Vec3>& x = state.positions;
    const double expected =
        (x[static_cast<Index>(slots[1])] - x[static_cast<Index>(slots[0])]).norm() / kH - 1.0;
    const ClothProbe stretched = probe_cloth(model, material, state, slots, weights);
    CHECK(stretched.weft_tension.strain == doctest::Approx(expected).epsilon(1e-12));
    // On the loop, where the mean of the field over the patch is not.
    const double stress =
        material.weft_tension
            .evaluate(stretched.weft_tension.strain, state.weft_tension[static_cast<Index>(slots[0])])
            .stress;
    CHECK(stretched.weft_tension.stress == doctest::Approx(stress).epsilon(1e-12));
    CHECK(expected > 0.01);
  }
}

TEST_SUITE("property") {
  TEST_CASE("energy times cloth sums to the free energy, and element by element too") {
    const ClothModel model = sheet_model(6, 7, kH, 0.15);
    const ClothMaterial material = uneven_material();
    const ClothState state = crumpled(model, material);
    const double whole = cloth_free_energy(model, material, state, Vec3::Zero()).internal();
    const std::vector<double> field = field_of(model, material, state, ClothField::kEnergy);
    double sum = 0.0, elements = 0.0;
    for (Index slot = 0; slot < field.size(); ++slot) {
      sum += field[slot] * model.node_area[slot];
      for (ClothElement element :
           {ClothElement::kWeftEdge, ClothElement::kWarpEdge, ClothElement::kCell, ClothElement::kTriples})
        elements += element_free_energy(model, material, state, element, slot);
    }
    // Sums of some hundred terms in another order: 1e-14 a term at most.
    CHECK(sum == doctest::Approx(whole).epsilon(1e-12));
    CHECK(elements == doctest::Approx(whole).epsilon(1e-12));
    CHECK(whole > 1e-6);
  }

  TEST_CASE("where there is no cloth there is no value, and speed is speed") {
    const ClothModel model = sheet_model(6, 7, kH, 0.15, {0, 1, 6});
    const ClothMaterial material = uneven_material();
    const ClothState state = crumpled(model, material);
    const std::vector<double> speed = field_of(model, material, state, ClothField::kSpeed);
    CHECK(blanks(speed) == 3);
    CHECK(off(speed, 1.3) < 1e-15);
    for (int f = 0; f < kClothFieldCount; ++f) {
      const std::vector<double> values = field_of(model, material, state, static_cast<ClothField>(f));
      CAPTURE(f);
      CHECK(std::isnan(values[0]));
      CHECK(std::none_of(values.begin(), values.end(), [](double v) { return v == 7.0; }));
    }
  }
}

TEST_SUITE("realtime") {
  TEST_CASE("no allocation") {
    const ClothModel model = sheet_model(6, 7, kH, 0.15);
    const ClothMaterial material = uneven_material();
    const ClothState state = crumpled(model, material);
    std::vector<double> values(static_cast<Index>(model.slot_count()));
    const std::array slots{14, 15};
    const std::array weights{0.5, 0.5};
    const AllocationGuard guard;
    for (int f = 0; f < kClothFieldCount; ++f)
      evaluate_field(model, material, state, static_cast<ClothField>(f), values);
    const ClothProbe probe = probe_cloth(model, material, state, slots, weights);
    CHECK(guard.count() == 0);
    CHECK(std::isfinite(probe.shear.stress));
  }
}
