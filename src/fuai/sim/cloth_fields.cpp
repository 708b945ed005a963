// Spreads what edges, cells and triples show over the slots.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/sim/cloth_fields.h"

#include <cstddef>
#include <limits>

#include "fuai/solver/cloth_energy.h"
#include "fuai/solver/cloth_measures.h"

namespace fuai {
namespace {

using Pair = ClothProbe::Pair;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// What is read: the cloth at a moment.
struct Look {
  const ClothModel& model;
  const ClothMaterial& material;
  const ClothState& state;

  std::size_t up() const noexcept { return static_cast<std::size_t>(model.columns); }
};

/// An element kind: where its cloth stands in the model, which slots an element touches, as steps from its
/// own slot, and what it shows. A collapsed element shows zero.
struct WeftEdges {
  static constexpr std::size_t kCorners = 2;
  static std::array<std::size_t, kCorners> corners(const Look&) noexcept { return {0, 1}; }
  static const std::vector<double>& areas(const Look& look) noexcept { return look.model.weft_edge_area; }
  static Pair pair(const Look& look, std::size_t slot) noexcept {
    const std::vector<Vec3>& x = look.state.positions;
    const double strain = measure_edge(x[slot], x[slot + 1], look.model.spacing).strain;
    return {strain, look.material.weft_tension.evaluate(strain, look.state.weft_tension[slot]).stress};
  }
};

struct WarpEdges {
  static constexpr std::size_t kCorners = 2;
  static std::array<std::size_t, kCorners> corners(const Look& look) noexcept { return {0, look.up()}; }
  static const std::vector<double>& areas(const Look& look) noexcept { return look.model.warp_edge_area; }
  static Pair pair(const Look& look, std::size_t slot) noexcept {
    const std::vector<Vec3>& x = look.state.positions;
    const double strain = measure_edge(x[slot], x[slot + look.up()], look.model.spacing).strain;
    return {strain, look.material.warp_tension.evaluate(strain, look.state.warp_tension[slot]).stress};
  }
};

struct Cells {
  static constexpr std::size_t kCorners = 4;
  static std::array<std::size_t, kCorners> corners(const Look& look) noexcept {
    return {0, 1, look.up(), look.up() + 1};
  }
  static const std::vector<double>& areas(const Look& look) noexcept { return look.model.cell_area; }
  static Pair pair(const Look& look, std::size_t slot) noexcept {
    const double angle = measure_cell(look.model, look.state.positions, slot).angle;
    return {angle, look.material.shear.evaluate(angle, look.state.shear[slot]).stress};
  }
};

/// Cloth of the elements that touch a slot, all together [m2]. Areas are zero where there is no element, so
/// that the last column needs no care.
template <class Elements>
double area_about(const Look& look, std::size_t slot) noexcept {
  double sum = 0.0;
  for (const std::size_t step : Elements::corners(look))
    if (slot >= step) sum += Elements::areas(look)[slot - step];
  return sum;
}

/// Adds to every slot the mean over its elements, weighted by their cloth. @param density of an element per
/// area; real-time
template <class Elements, class Density>
void add_means(const Look& look, std::span<double> values, const Density& density) noexcept {
  const std::vector<double>& areas = Elements::areas(look);
  for (std::size_t slot = 0; slot < areas.size(); ++slot) {
    if (!(areas[slot] > 0.0)) continue;
    const double share = areas[slot] * density(slot);
    for (const std::size_t step : Elements::corners(look))
      values[slot + step] += share / area_about<Elements>(look, slot + step);
  }
}

/// The same as the value itself: slots that touch no element have none.
template <class Elements>
void show_means(const Look& look, std::span<double> values, double Pair::*part) noexcept {
  for (std::size_t slot = 0; slot < values.size(); ++slot)
    values[slot] = area_about<Elements>(look, slot) > 0.0 ? 0.0 : kNothing;
  add_means<Elements>(look, values, [&](std::size_t slot) { return Elements::pair(look, slot).*part; });
}

/// Curvature and moment at a slot; not a number without a triple. @param direction 0 weft, 1 warp
Pair bending_pair(const Look& look, std::size_t slot, std::size_t direction) noexcept {
  const ClothModel& m = look.model;
  const bool warp = direction == 1;
  if (!((warp ? m.warp_bend_area : m.weft_bend_area)[slot] > 0.0)) return {kNothing, kNothing};
  const double curvature = measure_bend(m, look.state.positions, slot).curvature[direction];
  const PlayLaw& law = warp ? look.material.warp_bending : look.material.weft_bending;
  const PlayState& memory = (warp ? look.state.warp_bending : look.state.weft_bending)[slot];
  return {curvature, law.evaluate(curvature, memory).stress};
}

void show_bending(const Look& look, std::span<double> values, std::size_t direction,
                  double Pair::*part) noexcept {
  for (std::size_t slot = 0; slot < values.size(); ++slot)
    values[slot] = bending_pair(look, slot, direction).*part;
}

/// Free energy of the elements over their cloth, summed over the kinds.
void show_energy(const Look& look, std::span<double> values) noexcept {
  const ClothModel& m = look.model;
  const auto energy = [&](ClothElement element, std::size_t slot) {
    return element_free_energy(m, look.material, look.state, element, slot);
  };
  for (std::size_t slot = 0; slot < values.size(); ++slot) {
    values[slot] = kNothing;
    if (!(m.node_area[slot] > 0.0)) continue;
    values[slot] = energy(ClothElement::kTriples, slot) / m.node_area[slot];
  }
  add_means<WeftEdges>(look, values, [&](std::size_t slot) {
    return energy(ClothElement::kWeftEdge, slot) / m.weft_edge_area[slot];
  });
  add_means<WarpEdges>(look, values, [&](std::size_t slot) {
    return energy(ClothElement::kWarpEdge, slot) / m.warp_edge_area[slot];
  });
  add_means<Cells>(look, values,
                   [&](std::size_t slot) { return energy(ClothElement::kCell, slot) / m.cell_area[slot]; });
}

void show_speed(const Look& look, std::span<double> values) noexcept {
  for (std::size_t slot = 0; slot < values.size(); ++slot)
    values[slot] = look.model.live[slot] != 0 ? look.state.velocities[slot].norm() : kNothing;
}

/// How much of a patch is at the corners of an element.
template <class Elements>
double share_of_patch(const Look& look, std::size_t element, std::span<const int> slots,
                      std::span<const double> weights) noexcept {
  double share = 0.0;
  for (std::size_t i = 0; i < slots.size(); ++i)
    for (const std::size_t step : Elements::corners(look))
      if (static_cast<std::size_t>(slots[i]) == element + step) share += weights[i];
  return share;
}

/// Strain and stress of the element with most of a patch; zeros where it touches none.
template <class Elements>
Pair pair_at(const Look& look, std::span<const int> slots, std::span<const double> weights) noexcept {
  double most = 0.0;
  std::size_t chosen = 0;
  for (const int slot : slots) {
    for (const std::size_t step : Elements::corners(look)) {
      if (static_cast<std::size_t>(slot) < step) continue;
      const std::size_t element = static_cast<std::size_t>(slot) - step;
      if (!(Elements::areas(look)[element] > 0.0)) continue;
      const double share = share_of_patch<Elements>(look, element, slots, weights);
      if (share <= most) continue;
      most = share;
      chosen = element;
    }
  }
  return most > 0.0 ? Elements::pair(look, chosen) : Pair{};
}

/// The same of the triple in the middle of most of the patch.
Pair bending_at(const Look& look, std::size_t direction, std::span<const int> slots,
                std::span<const double> weights) noexcept {
  double most = 0.0;
  Pair chosen;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const Pair pair = bending_pair(look, static_cast<std::size_t>(slots[i]), direction);
    if (weights[i] <= most || pair.strain != pair.strain) continue;
    most = weights[i];
    chosen = pair;
  }
  return chosen;
}

}  // namespace

void evaluate_field(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                    ClothField field, std::span<double> values) noexcept {
  const Look look{model, material, state};
  switch (field) {
    case ClothField::kWarpStrain:
      return show_means<WarpEdges>(look, values, &Pair::strain);
    case ClothField::kWeftStrain:
      return show_means<WeftEdges>(look, values, &Pair::strain);
    case ClothField::kShearAngle:
      return show_means<Cells>(look, values, &Pair::strain);
    case ClothField::kWarpCurvature:
      return show_bending(look, values, 1, &Pair::strain);
    case ClothField::kWeftCurvature:
      return show_bending(look, values, 0, &Pair::strain);
    case ClothField::kWarpMoment:
      return show_bending(look, values, 1, &Pair::stress);
    case ClothField::kWeftMoment:
      return show_bending(look, values, 0, &Pair::stress);
    case ClothField::kWarpStress:
      return show_means<WarpEdges>(look, values, &Pair::stress);
    case ClothField::kWeftStress:
      return show_means<WeftEdges>(look, values, &Pair::stress);
    case ClothField::kShearStress:
      return show_means<Cells>(look, values, &Pair::stress);
    case ClothField::kEnergy:
      return show_energy(look, values);
    case ClothField::kSpeed:
      return show_speed(look, values);
  }
}

ClothProbe probe_cloth(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                       std::span<const int> slots, std::span<const double> weights) noexcept {
  const Look look{model, material, state};
  return {bending_at(look, 1, slots, weights), bending_at(look, 0, slots, weights),
          pair_at<Cells>(look, slots, weights), pair_at<WarpEdges>(look, slots, weights),
          pair_at<WeftEdges>(look, slots, weights)};
}

}  // namespace fuai
