// Small rectangular cloths of whole cells, with or without holes, and materials that use every term of the
// engine.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/fabric/laws.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/solver/cloth_material.h"
#include "fuai/units/constants.h"

namespace fuai_test {

using Index = std::size_t;

/// Shares out the area of one cell: quarters to its corners, halves to its edges.
inline void add_cell(fuai::ClothModel& model, Index slot) {
  const double area = model.spacing * model.spacing;
  const auto up = static_cast<Index>(model.columns);
  model.cell_area[slot] = area;
  for (Index corner : {slot, slot + 1, slot + up, slot + up + 1}) model.node_area[corner] += 0.25 * area;
  for (Index edge : {slot, slot + up}) model.weft_edge_area[edge] += 0.5 * area;
  for (Index edge : {slot, slot + 1}) model.warp_edge_area[edge] += 0.5 * area;
}

/// columns x rows slots, spacing h [m], areal mass [kg/m2]; the listed slots are dead. Nothing is fixed.
inline fuai::ClothModel sheet_model(int columns, int rows, double h, double areal_mass,
                                    const std::vector<int>& dead = {}) {
  fuai::ClothModel model;
  model.columns = columns;
  model.rows = rows;
  model.spacing = h;
  model.areal_mass = areal_mass;
  const auto count = static_cast<Index>(columns * rows), up = static_cast<Index>(columns);
  model.live.assign(count, 1);
  model.fixed.assign(count, 0);
  for (int slot : dead) model.live[static_cast<Index>(slot)] = 0;
  for (auto* area : {&model.node_area, &model.cell_area, &model.weft_edge_area, &model.warp_edge_area,
                     &model.weft_bend_area, &model.warp_bend_area}) {
    area->assign(count, 0.0);
  }
  model.weft_bend_length.assign(count, h);
  model.warp_bend_length.assign(count, h);
  const auto alive = [&](Index slot) { return model.live[slot] != 0; };
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      const auto s = static_cast<Index>(model.slot(column, row));
      if (alive(s) && alive(s + 1) && alive(s + up) && alive(s + up + 1)) add_cell(model, s);
    }
  }
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto s = static_cast<Index>(model.slot(column, row));
      if (!alive(s)) continue;
      if (column > 0 && column + 1 < columns && alive(s - 1) && alive(s + 1))
        model.weft_bend_area[s] = model.node_area[s];
      if (row > 0 && row + 1 < rows && alive(s - up) && alive(s + up))
        model.warp_bend_area[s] = model.node_area[s];
    }
  }
  model.twist_area = model.cell_area;
  return model;
}

/// Flat at z = 0, at rest, virgin.
inline fuai::ClothState flat_state(const fuai::ClothModel& model) {
  fuai::ClothState state;
  const auto count = static_cast<Index>(model.slot_count());
  for (int row = 0; row < model.rows; ++row) {
    for (int column = 0; column < model.columns; ++column) {
      const fuai::Vec2 m = model.material(column, row);
      state.positions.emplace_back(m.x(), m.y(), 0.0);
    }
  }
  state.velocities.assign(count, fuai::Vec3::Zero());
  for (auto* memory :
       {&state.weft_bending, &state.warp_bending, &state.shear, &state.weft_tension, &state.warp_tension}) {
    memory->assign(count, {});
  }
  return state;
}

/// F = k x over +-range with friction of half width `friction`, plays of 1/20, 1/5 and 1/2 of the range.
inline fuai::PlayLaw straight_law(double k, double friction, double range) {
  const std::vector<double> elastic{-k * range, 0.0, k * range}, width(3, friction);
  const std::vector<fuai::PlayElement> plays{{0.05 * range, 0.3}, {0.2 * range, 0.4}, {0.5 * range, 0.3}};
  return fuai::make_play_law(fuai::make_curve_table(-range, range, elastic),
                             fuai::make_curve_table(-range, range, width, fuai::constant_outside()), plays);
}

/// Every term is there, warp and weft differ, bending tells face from back.
inline fuai::ClothMaterial uneven_material() {
  using namespace fuai;
  std::vector<double> elastic, friction;
  for (int i = 0; i <= 100; ++i) {
    const double x = -2.5 + 0.05 * i;
    elastic.push_back(unit::kGfCmPerCm * (0.1 * x + 0.004 * x * x * x + 0.01 * std::abs(x) * x));
    friction.push_back(unit::kGfCmPerCm * (0.03 + 0.004 * x * x + 0.002 * x));
  }
  const double reach = 2.5 * unit::kPerCentimetre;
  ClothMaterial material;
  material.warp_bending =
      make_play_law(make_curve_table(-reach, reach, elastic),
                    make_curve_table(-reach, reach, friction, constant_outside()), kBendingPlays);
  material.weft_bending =
      make_bending_law(0.06 * unit::kGfCm2PerCm, 0.04 * unit::kGfCmPerCm, 10.0 * reach, kBendingPlays);
  material.shear = make_shear_law(0.8 * unit::kGfPerCmDeg, 1.5 * unit::kGfPerCm, 3.0 * unit::kGfPerCm);
  material.weft_tension = make_tensile_law(0.7, 0.6, 0.05, 500.0 * unit::kGfPerCm);
  material.warp_tension = make_tensile_law(0.8, 0.5, 0.03, 500.0 * unit::kGfPerCm);
  material.twist_stiffness = 2e-6;
  material.poisson_bending = 1e-6;
  return material;
}

/// The laws of that material, 150 g/m2.
inline fuai::FabricLaws uneven_laws() {
  const fuai::ClothMaterial m = uneven_material();
  fuai::FabricLaws laws;
  laws.areal_mass = 0.15;
  laws.bending = {m.warp_bending, m.weft_bending, m.warp_bending};
  laws.shear = m.shear;
  laws.tensile = {m.warp_tension, m.weft_tension};
  return laws;
}

/// Adds a random displacement of up to `amplitude` in every coordinate of every slot [m].
inline void jitter(std::vector<fuai::Vec3>& positions, double amplitude, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  for (fuai::Vec3& x : positions) {
    for (int i = 0; i < 3; ++i) x[i] += uniform(random);
  }
}

}  // namespace fuai_test
