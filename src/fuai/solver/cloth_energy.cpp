// One loop an element kind; a reader decides what a law is asked for: incremental potential, free energy,
// commit.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/cloth_energy.h"

#include <algorithm>
#include <cmath>

#include "fuai/solver/cloth_measures.h"

namespace fuai {
namespace {

/// Energy per area and stress of one law at one strain.
struct Reading {
  double energy = 0.0;
  double stress = 0.0;
};

/// Asks for the incremental potential.
struct ReadIncrement {
  Reading operator()(const PlayLaw& law, double x, const PlayState& memory) const noexcept {
    return {law.incremental_potential(x, memory), law.evaluate(x, memory).stress};
  }
};

/// Asks for the free energy.
struct ReadFreeEnergy {
  Reading operator()(const PlayLaw& law, double x, const PlayState& memory) const noexcept {
    return {law.free_energy(x, memory), 0.0};
  }
};

/// Asks for the stress and moves the memory.
struct ReadAndCommit {
  Reading operator()(const PlayLaw& law, double x, PlayState& memory) const noexcept {
    return {0.0, law.advance(x, memory).stress};
  }
};

/// One evaluation. State is const unless the reader commits.
template <class State, class Reader>
struct Pass {
  const ClothModel& model;
  const ClothMaterial& material;
  State& state;
  std::span<const Vec3> x;
  double dt;
  std::span<Vec3> forces;  // empty: not wanted
  Reader read{};
  ClothEnergy energy{};

  void pull(std::size_t slot, const Vec3& force) const noexcept {
    if (!forces.empty()) forces[slot] += force;
  }
};

/// Kelvin-Voigt part of an edge, energy per area and stress: eta (eps - eps_n)^2 / (2 dt).
Reading viscous(double eta, double strain, double last_strain, double dt) noexcept {
  const double rate = dt > 0.0 ? (strain - last_strain) / dt : 0.0;
  return {0.5 * eta * rate * rate * dt, eta * rate};
}

/// The yarn edges of one direction: what differs between weft and warp.
template <class Memory>
struct Edges {
  std::size_t stride;
  const std::vector<double>& area;
  const PlayLaw& law;
  double eta;  // viscosity [N s/m]
  Memory& memory;
};

template <class State, class Reader, class Memory>
void add_edge(Pass<State, Reader>& pass, const Edges<Memory>& edges, std::size_t slot) noexcept {
  const double area = edges.area[slot], h = pass.model.spacing;
  if (!(area > 0.0)) return;
  const std::size_t next = slot + edges.stride;
  const EdgeMeasure edge = measure_edge(pass.x[slot], pass.x[next], h);
  if (!edge.valid) return;
  const Reading elastic = pass.read(edges.law, edge.strain, edges.memory[slot]);
  const double last = measure_edge(pass.state.positions[slot], pass.state.positions[next], h).strain;
  const Reading viscosity = viscous(edges.eta, edge.strain, last, pass.dt);
  pass.energy.stretch += area * elastic.energy;
  pass.energy.viscosity += area * viscosity.energy;
  const Vec3 force = -(area / h) * (elastic.stress + viscosity.stress) * edge.direction;
  pass.pull(next, force);
  pass.pull(slot, -force);
}

template <class State, class Reader>
auto weft_edges(Pass<State, Reader>& pass) noexcept {
  using Memory = std::remove_reference_t<decltype((pass.state.weft_tension))>;
  const PlayLaw& law = pass.material.weft_tension;
  return Edges<Memory>{1, pass.model.weft_edge_area, law,
                       tension_viscosity(law, pass.material.viscosity_time), pass.state.weft_tension};
}

template <class State, class Reader>
auto warp_edges(Pass<State, Reader>& pass) noexcept {
  using Memory = std::remove_reference_t<decltype((pass.state.warp_tension))>;
  const PlayLaw& law = pass.material.warp_tension;
  return Edges<Memory>{static_cast<std::size_t>(pass.model.columns), pass.model.warp_edge_area, law,
                       tension_viscosity(law, pass.material.viscosity_time), pass.state.warp_tension};
}

template <class State, class Reader>
void add_tension(Pass<State, Reader>& pass) noexcept {
  const auto weft = weft_edges(pass);
  for (std::size_t slot = 0; slot < weft.area.size(); ++slot) add_edge(pass, weft, slot);
  const auto warp = warp_edges(pass);
  for (std::size_t slot = 0; slot < warp.area.size(); ++slot) add_edge(pass, warp, slot);
}

/// a and b gather the corners with signs over 2h.
template <class State, class Reader>
void add_shear(Pass<State, Reader>& pass, std::size_t slot) noexcept {
  const ClothModel& m = pass.model;
  const CellMeasure cell = measure_cell(m, pass.x, slot);
  if (!cell.valid) return;
  const double area = m.cell_area[slot];
  const Reading law = pass.read(pass.material.shear, cell.angle, pass.state.shear[slot]);
  pass.energy.shear += area * law.energy;
  const auto up = static_cast<std::size_t>(m.columns);
  const double scale = area * law.stress / (2.0 * m.spacing);
  const Vec3 along = scale * (cell.by_weft + cell.by_warp), across = scale * (cell.by_weft - cell.by_warp);
  pass.pull(slot, along);
  pass.pull(slot + up + 1, -along);
  pass.pull(slot + 1, -across);
  pass.pull(slot + up, across);
}

/// A 2 Bt |D12|^2 / h^4.
template <class State, class Reader>
void add_twist(Pass<State, Reader>& pass, std::size_t slot) noexcept {
  const ClothModel& m = pass.model;
  const Vec3 d = twist_vector(m, pass.x, slot);
  const double h2 = m.spacing * m.spacing;
  const double stiffness = 4.0 * m.twist_area[slot] * pass.material.twist_stiffness / (h2 * h2);
  pass.energy.twist += 0.5 * stiffness * d.squaredNorm();
  const Vec3 force = stiffness * d;
  const auto up = static_cast<std::size_t>(m.columns);
  pass.pull(slot, -force);
  pass.pull(slot + up + 1, -force);
  pass.pull(slot + 1, force);
  pass.pull(slot + up, force);
}

template <class State, class Reader>
void add_bending(Pass<State, Reader>& pass, std::size_t slot) noexcept {
  const ClothModel& m = pass.model;
  const BendMeasure bend = measure_bend(m, pass.x, slot);
  if (!bend.valid) return;
  const double weft_area = m.weft_bend_area[slot], warp_area = m.warp_bend_area[slot];
  const double coupling = std::min(weft_area, warp_area) * pass.material.poisson_bending;
  const auto [weft, warp] = bend.curvature;
  Reading weft_law, warp_law;
  if (bend.bends[0]) weft_law = pass.read(pass.material.weft_bending, weft, pass.state.weft_bending[slot]);
  if (bend.bends[1]) warp_law = pass.read(pass.material.warp_bending, warp, pass.state.warp_bending[slot]);
  // Where only one curvature is known (a free edge) the other relaxes, which softens this one.
  const double weft_soft =
      warp_area == 0.0 ? weft_area * free_edge_softening(pass.material, pass.material.warp_bending) : 0.0;
  const double warp_soft =
      weft_area == 0.0 ? warp_area * free_edge_softening(pass.material, pass.material.weft_bending) : 0.0;
  pass.energy.bending += weft_area * weft_law.energy + warp_area * warp_law.energy + coupling * weft * warp -
                         0.5 * (weft_soft * weft * weft + warp_soft * warp * warp);
  const BendGradient gradient =
      bend_gradient(bend, {weft_area * weft_law.stress + coupling * warp - weft_soft * weft,
                           warp_area * warp_law.stress + coupling * weft - warp_soft * warp});
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [low, high] = bend.ends[i];
    pass.pull(low, gradient.by_tangent[i] - gradient.by_second[i]);
    pass.pull(high, -gradient.by_tangent[i] - gradient.by_second[i]);
    pass.pull(slot, 2.0 * gradient.by_second[i]);
  }
}

/// Shear and twist of a cell.
template <class State, class Reader>
void add_cell(Pass<State, Reader>& pass, std::size_t slot) noexcept {
  if (!(pass.model.cell_area[slot] > 0.0)) return;
  add_shear(pass, slot);
  add_twist(pass, slot);
}

/// Bending of the triples about a slot.
template <class State, class Reader>
void add_triples(Pass<State, Reader>& pass, std::size_t slot) noexcept {
  if (pass.model.weft_bend_area[slot] > 0.0 || pass.model.warp_bend_area[slot] > 0.0) add_bending(pass, slot);
}

template <class State, class Reader>
void add_all(Pass<State, Reader>& pass) noexcept {
  const ClothModel& m = pass.model;
  const auto slots = static_cast<std::size_t>(m.slot_count());
  std::fill(pass.forces.begin(), pass.forces.end(), Vec3::Zero());
  add_tension(pass);
  for (std::size_t slot = 0; slot < slots; ++slot) {
    add_cell(pass, slot);
    add_triples(pass, slot);
  }
}

double weight_energy(const ClothModel& model, std::span<const Vec3> x, const Vec3& gravity) noexcept {
  double energy = 0.0;
  for (std::size_t slot = 0; slot < x.size(); ++slot) {
    if (model.live[slot] != 0) energy -= model.areal_mass * model.node_area[slot] * gravity.dot(x[slot]);
  }
  return energy;
}

}  // namespace

ClothEnergy evaluate_cloth(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                           std::span<const Vec3> positions, const ClothLoad& load,
                           std::span<Vec3> forces) noexcept {
  Pass<const ClothState, ReadIncrement> pass{model, material, state, positions, load.dt, forces};
  add_all(pass);
  pass.energy.weight = weight_energy(model, positions, load.gravity);
  return pass.energy;
}

ClothEnergy cloth_free_energy(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                              const Vec3& gravity) noexcept {
  Pass<const ClothState, ReadFreeEnergy> pass{model, material, state, state.positions, 0.0, {}};
  add_all(pass);
  pass.energy.weight = weight_energy(model, state.positions, gravity);
  return pass.energy;
}

double element_free_energy(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                           ClothElement element, std::size_t slot) noexcept {
  Pass<const ClothState, ReadFreeEnergy> pass{model, material, state, state.positions, 0.0, {}};
  switch (element) {
    case ClothElement::kWeftEdge:
      add_edge(pass, weft_edges(pass), slot);
      break;
    case ClothElement::kWarpEdge:
      add_edge(pass, warp_edges(pass), slot);
      break;
    case ClothElement::kCell:
      add_cell(pass, slot);
      break;
    case ClothElement::kTriples:
      add_triples(pass, slot);
      break;
  }
  return pass.energy.internal();
}

double cloth_kinetic_energy(const ClothModel& model, const ClothState& state) noexcept {
  double energy = 0.0;
  for (std::size_t slot = 0; slot < state.velocities.size(); ++slot) {
    if (model.live[slot] == 0) continue;
    energy += 0.5 * model.areal_mass * model.node_area[slot] * state.velocities[slot].squaredNorm();
  }
  return energy;
}

void commit_cloth(const ClothModel& model, const ClothMaterial& material, std::span<const Vec3> positions,
                  ClothState& state) noexcept {
  Pass<ClothState, ReadAndCommit> pass{model, material, state, positions, 0.0, {}};
  add_all(pass);
}

void advance_cloth(const ClothModel& model, const ClothMaterial& material, ClothState& state,
                   std::span<Vec3> forces) noexcept {
  Pass<ClothState, ReadAndCommit> pass{model, material, state, state.positions, 0.0, forces};
  add_all(pass);
}

}  // namespace fuai
