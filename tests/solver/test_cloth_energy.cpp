// The reference energies: gradients, balance, invariance, closed forms of each measure, collapsed elements.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/cloth_energy.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "fuai/solver/cloth_measures.h"
#include "support/small_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

constexpr double kH = 0.01;
constexpr double kDt = 1e-3;

/// 6 x 7 slots with a hole of two dead slots.
ClothModel holed_sheet() { return sheet_model(6, 7, kH, 0.15, {2 + 6 * 3, 3 + 6 * 3}); }

/// One term of the engine alone: the others have no stiffness.
ClothMaterial only(const std::string& term) {
  const ClothMaterial all = uneven_material();
  ClothMaterial material;
  if (term == "all") return all;
  material.viscosity_time = 0.0;
  if (term == "stretch" || term == "viscosity") {
    material.weft_tension = all.weft_tension;
    material.warp_tension = all.warp_tension;
  }
  if (term == "viscosity") material.viscosity_time = 1.0;  // outweighs the elastic part
  if (term == "shear") material.shear = all.shear;
  if (term == "bending") {
    material.weft_bending = all.weft_bending;
    material.warp_bending = all.warp_bending;
  }
  if (term == "coupling") material.poisson_bending = all.poisson_bending;
  if (term == "twist") material.twist_stiffness = all.twist_stiffness;
  return material;
}

/// A state with a past: its memory was committed at several random shapes.
ClothState with_past(const ClothModel& model, const ClothMaterial& material, std::mt19937& random) {
  ClothState state = flat_state(model);
  for (int k = 0; k < 4; ++k) {
    std::vector<Vec3> shape = state.positions;
    jitter(shape, 0.1 * kH, random);
    commit_cloth(model, material, shape, state);
  }
  jitter(state.positions, 0.05 * kH, random);
  return state;
}

/// Largest difference of the forces from central differences with this step, over the largest force.
double gradient_error(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                      std::vector<Vec3> x, double step) {
  const ClothLoad load{kDt, Vec3::Zero()};
  std::vector<Vec3> forces(x.size());
  evaluate_cloth(model, material, state, x, load, forces);
  double worst = 0.0, largest = 0.0;
  for (Index s = 0; s < x.size(); ++s) {
    for (int i = 0; i < 3; ++i) {
      const double middle = x[s][i];
      x[s][i] = middle + step;
      const double high = evaluate_cloth(model, material, state, x, load, {}).internal();
      x[s][i] = middle - step;
      const double low = evaluate_cloth(model, material, state, x, load, {}).internal();
      x[s][i] = middle;
      worst = std::max(worst, std::abs(forces[s][i] + (high - low) / (2.0 * step)));
      largest = std::max(largest, std::abs(forces[s][i]));
    }
  }
  return worst / largest;
}

/// Difference over the reference: energies here are far below one joule.
double relative(double value, double reference) { return std::abs(value - reference) / std::abs(reference); }

constexpr const char* kTerms[] = {"stretch", "viscosity", "shear", "bending", "coupling", "twist", "all"};

/// Net force and moment over the sum of the magnitudes that they cancel from.
std::array<double, 2> imbalance(std::span<const Vec3> x, std::span<const Vec3> forces) {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double force_scale = 0.0, moment_scale = 0.0;
  for (Index s = 0; s < x.size(); ++s) {
    force += forces[s];
    moment += x[s].cross(forces[s]);
    force_scale += forces[s].norm();
    moment_scale += x[s].norm() * forces[s].norm();
  }
  return {force.norm() / force_scale, moment.norm() / moment_scale};
}

/// Rolls a flat sheet on a cylinder of this radius about the warp (chords of length h); toward the face.
std::vector<Vec3> rolled(const ClothModel& model, double radius) {
  const double turn = 2.0 * std::asin(0.5 * model.spacing / radius);
  std::vector<Vec3> x;
  for (int row = 0; row < model.rows; ++row) {
    for (int column = 0; column < model.columns; ++column) {
      const double angle = turn * (column - 0.5 * (model.columns - 1));
      x.emplace_back(radius * std::sin(angle), model.spacing * row, radius * (1.0 - std::cos(angle)));
    }
  }
  return x;
}

}  // namespace

TEST_SUITE("derivative") {
  TEST_CASE("forces are the negative gradient of the incremental energy, term by term") {
    const ClothModel model = holed_sheet();
    for (const char* term : kTerms) {
      for (bool past : {false, true}) {
        CAPTURE(term);
        CAPTURE(past);
        const ClothMaterial material = only(term);
        std::mt19937 random(7);
        ClothState state = flat_state(model);
        if (past) state = with_past(model, material, random);
        std::vector<Vec3> x = state.positions;
        jitter(x, 0.1 * kH, random);
        double best = 1.0;
        for (double step : {1e-3, 1e-4, 1e-5, 1e-6}) {
          best = std::min(best, gradient_error(model, material, state, x, step * kH));
        }
        MESSAGE(std::string(term) << std::string(past ? " with" : " without")
                                  << " memory: best relative error " << best);
        // Central differences in double reach eps^(2/3) = 4e-11 at best; knots of the tables (jumps of the
        // second derivative) inside the step cost the rest.
        CHECK(best < 1e-6);
      }
    }
  }
}

TEST_SUITE("property") {
  TEST_CASE("internal forces have no net force and no net moment") {
    const ClothModel model = holed_sheet();
    for (const char* term : kTerms) {
      CAPTURE(term);
      const ClothMaterial material = only(term);
      std::mt19937 random(11);
      const ClothState state = with_past(model, material, random);
      std::vector<Vec3> x = state.positions;
      jitter(x, 0.2 * kH, random);
      std::vector<Vec3> forces(x.size());
      evaluate_cloth(model, material, state, x, {kDt, Vec3::Zero()}, forces);
      const auto [force, moment] = imbalance(x, forces);
      CHECK(force < 1e-12);  // rounding: about 1e3 terms of 1e-16
      CHECK(moment < 1e-12);
    }
  }

  TEST_CASE("a rigid motion changes no energy and turns the forces") {
    const ClothModel model = holed_sheet();
    const ClothMaterial material = uneven_material();
    std::mt19937 random(13);
    ClothState state = with_past(model, material, random);
    std::vector<Vec3> x = state.positions;
    jitter(x, 0.2 * kH, random);
    const Mat3 turn = Eigen::AngleAxisd(2.1, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
    std::vector<Vec3> forces(x.size()), turned_forces(x.size());
    const ClothEnergy before = evaluate_cloth(model, material, state, x, {kDt, Vec3::Zero()}, forces);
    for (auto* points : {&x, &state.positions}) {
      for (Vec3& p : *points) p = turn * p + Vec3(0.3, 0.2, -0.4);
    }
    const ClothEnergy after = evaluate_cloth(model, material, state, x, {kDt, Vec3::Zero()}, turned_forces);
    // Coordinates of 0.5 m carry 1e-16 m, i.e. 1e-14 of the spacing, into the strains.
    CHECK(relative(after.stretch, before.stretch) < 1e-11);
    CHECK(relative(after.viscosity, before.viscosity) < 1e-11);
    CHECK(relative(after.shear, before.shear) < 1e-11);
    CHECK(relative(after.bending, before.bending) < 1e-11);
    CHECK(relative(after.twist, before.twist) < 1e-11);
    double largest = 0.0, worst = 0.0;
    for (Index s = 0; s < x.size(); ++s) {
      largest = std::max(largest, forces[s].norm());
      worst = std::max(worst, (turn * forces[s] - turned_forces[s]).norm());
    }
    CHECK(worst < 1e-11 * largest);
  }

  TEST_CASE("the incremental energy is free energy plus what friction took") {
    const ClothModel model = holed_sheet();
    ClothMaterial material = uneven_material();
    std::mt19937 random(17);
    ClothState state = with_past(model, material, random);
    commit_cloth(model, material, state.positions, state);
    const Vec3 none = Vec3::Zero();
    for (int k = 0; k < 20; ++k) {
      const double start =
          evaluate_cloth(model, material, state, state.positions, {0.0, none}, {}).internal();
      const double free_start = cloth_free_energy(model, material, state, none).internal();
      std::vector<Vec3> x = state.positions;
      jitter(x, 0.05 * kH, random);
      const double end = evaluate_cloth(model, material, state, x, {0.0, none}, {}).internal();
      commit_cloth(model, material, x, state);
      state.positions = x;
      const double loss =
          end - start - (cloth_free_energy(model, material, state, none).internal() - free_start);
      CHECK(loss > 0.0);
    }
  }

  TEST_CASE("advance_cloth is evaluate_cloth and commit_cloth in one pass") {
    const ClothModel model = holed_sheet();
    const ClothMaterial material = uneven_material();
    std::mt19937 random(19);
    ClothState state = with_past(model, material, random);
    jitter(state.positions, 0.1 * kH, random);
    ClothState twin = state;
    std::vector<Vec3> forces(state.positions.size()), twin_forces(forces);
    evaluate_cloth(model, material, state, state.positions, {}, forces);
    commit_cloth(model, material, state.positions, state);
    advance_cloth(model, material, twin, twin_forces);
    CHECK(forces == twin_forces);
    for (Index s = 0; s < forces.size(); ++s) {
      CHECK(state.shear[s].position == twin.shear[s].position);
      CHECK(state.warp_bending[s].position == twin.warp_bending[s].position);
      CHECK(state.weft_tension[s].position == twin.weft_tension[s].position);
    }
  }

  TEST_CASE("collapsed and folded cloth stays finite") {
    const ClothModel model = sheet_model(6, 7, kH, 0.15);
    const ClothMaterial material = uneven_material();
    const ClothState flat = flat_state(model);
    std::vector<std::vector<Vec3>> shapes(5, flat.positions);
    for (Vec3& x : shapes[0]) x.setZero();                                  // a point
    for (Vec3& x : shapes[1]) x.y() = 0.0;                                  // a line: |N| = 0
    for (Vec3& x : shapes[2]) x.x() = std::abs(x.x() - 2.0 * kH);           // a full fold, |T| = 0 there
    for (Vec3& x : shapes[3]) x = Vec3(x.x() + x.y(), x.x() + x.y(), 0.0);  // warp and weft coincide
    shapes[4][8] = shapes[4][9];                                            // one edge without length
    for (const std::vector<Vec3>& x : shapes) {
      CAPTURE(&x - shapes.data());
      ClothState state = flat;
      std::vector<Vec3> forces(x.size());
      const ClothEnergy energy = evaluate_cloth(model, material, state, x, {kDt, Vec3::Zero()}, forces);
      CHECK(std::isfinite(energy.total()));
      CHECK(std::ranges::all_of(forces, [](const Vec3& f) { return f.allFinite(); }));
      commit_cloth(model, material, x, state);
      state.positions = x;
      CHECK(std::isfinite(cloth_free_energy(model, material, state, Vec3::Zero()).total()));
    }
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("a sheet rolled on a cylinder has its curvature, toward the face positive") {
    const ClothModel model = sheet_model(9, 4, kH, 0.15);
    for (double sign : {1.0, -1.0}) {
      std::vector<Vec3> x = rolled(model, 0.04);
      for (Vec3& p : x) p.z() *= sign;
      const double turn = 2.0 * std::asin(0.5 * kH / 0.04);
      for (int row = 0; row < 4; ++row) {
        const BendMeasure bend = measure_bend(model, x, static_cast<Index>(model.slot(4, row)));
        // phi = arc tangent + (4/175) t^7, of t = 0.126: 9.1e-8
        CHECK(relative(bend.curvature[0], sign * turn / kH) < 1e-7);
        CHECK(std::abs(bend.curvature[1]) < 1e-12 / kH);
      }
    }
  }

  TEST_CASE("each energy of a uniform strain is area times the law's") {
    const ClothModel model = sheet_model(7, 5, kH, 0.15);
    const double area = 6.0 * 4.0 * kH * kH;
    const ClothMaterial material = uneven_material();
    const ClothState state = flat_state(model);
    const PlayState virgin;
    const auto energy_of = [&](auto&& map) {
      std::vector<Vec3> x = state.positions;
      for (Vec3& p : x) p = map(p);
      return evaluate_cloth(model, material, state, x, {}, {});
    };
    // Rounding of coordinates of 0.1 m over h: 1e-15; the sums have 35 terms.
    const double e = 0.02;
    const auto stretched = energy_of([&](const Vec3& p) { return Vec3((1.0 + e) * p.x(), p.y(), 0.0); });
    CHECK(relative(stretched.stretch, area * material.weft_tension.incremental_potential(e, virgin)) < 1e-11);
    const double g =
        0.1;  // y along the sheared warp: the angle is g to the series' s^9 (35/1152) / s = 3e-10
    const auto sheared =
        energy_of([&](const Vec3& p) { return Vec3(p.x() + std::sin(g) * p.y(), std::cos(g) * p.y(), 0.0); });
    CHECK(relative(sheared.shear, area * material.shear.incremental_potential(g, virgin)) < 1e-8);
    CHECK(std::abs(sheared.stretch) < 1e-12 * stretched.stretch);
    const double k = 3.0;  // [1/m]
    const auto twisted = energy_of([&](const Vec3& p) { return Vec3(p.x(), p.y(), k * p.x() * p.y()); });
    CHECK(relative(twisted.twist, area * 2.0 * material.twist_stiffness * k * k) < 1e-11);
  }

  TEST_CASE("viscosity: a strain rate costs eta rate^2 dt / 2 per area, and the weight is m g z") {
    const ClothModel model = sheet_model(4, 3, kH, 0.15);
    const ClothMaterial material = uneven_material();
    const ClothState state = flat_state(model);
    std::vector<Vec3> x = state.positions;
    const double e = 1e-3, area = 3.0 * 2.0 * kH * kH;
    for (Vec3& p : x) p = Vec3(p.x(), (1.0 + e) * p.y(), 0.25);
    const ClothEnergy energy = evaluate_cloth(model, material, state, x, {kDt, Vec3(0.0, 0.0, -10.0)}, {});
    const double eta = 5e-5 * material.warp_tension.elastic().evaluate(0.0).slope;
    CHECK(eta > 0.0);
    CHECK(relative(energy.viscosity, area * 0.5 * eta * e * e / kDt) < 1e-10);
    CHECK(relative(energy.weight, 0.15 * area * 10.0 * 0.25) < 1e-12);
  }
}
