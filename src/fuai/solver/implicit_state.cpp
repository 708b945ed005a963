// Copies states slot by slot.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/implicit_state.h"

namespace fuai {
namespace {

/// Calls work(law, memory arrays, memory of the state) for every law.
template <class T, class State, class Work>
void each_law(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, State& state, const Work& work) {
  work(k.weft_bending, g.memory_weft_bending, state.weft_bending);
  work(k.warp_bending, g.memory_warp_bending, state.warp_bending);
  work(k.shear, g.memory_shear, state.shear);
  work(k.weft_tension, g.memory_weft_tension, state.weft_tension);
  work(k.warp_tension, g.memory_warp_tension, state.warp_tension);
}

}  // namespace

template <class T>
void load_state(const ClothState& state, const ImplicitConstants<T>& constants, const ImplicitGrid<T>& g) {
  for (int slot = 0; slot < g.rows * g.columns; ++slot) {
    const auto i = static_cast<std::size_t>(slot);
    const std::ptrdiff_t p = g.slot_index(slot);
    put(g.x, p, state.positions[i]);
    put(g.v, p, state.velocities[i]);
    put(g.a, p, state.accelerations.empty() ? Vec3::Zero() : state.accelerations[i]);
    each_law(g, constants, state, [&](const auto& law, T* const* to, const std::vector<PlayState>& from) {
      for (int j = 0; j < law.plays; ++j)
        to[j][p] = static_cast<T>(from[i].position[static_cast<std::size_t>(j)]);
    });
  }
}

template <class T>
void store_state(const ImplicitGrid<T>& g, const ImplicitConstants<T>& constants, ClothState& state) {
  const auto count = static_cast<std::size_t>(g.rows) * static_cast<std::size_t>(g.columns);
  state.positions.resize(count);
  state.velocities.resize(count);
  state.accelerations.resize(count);
  each_law(g, constants, state,
           [&](const auto&, T* const*, std::vector<PlayState>& to) { to.resize(count); });
  for (int slot = 0; slot < g.rows * g.columns; ++slot) {
    const auto i = static_cast<std::size_t>(slot);
    const std::ptrdiff_t p = g.slot_index(slot);
    state.positions[i] = vector_at(g.x, p);
    state.velocities[i] = vector_at(g.v, p);
    state.accelerations[i] = vector_at(g.a, p);
    each_law(g, constants, state, [&](const auto& law, T* const* from, std::vector<PlayState>& to) {
      for (int j = 0; j < law.plays; ++j)
        to[i].position[static_cast<std::size_t>(j)] = static_cast<double>(from[j][p]);
    });
  }
}

template void load_state(const ClothState&, const ImplicitConstants<float>&, const ImplicitGrid<float>&);
template void load_state(const ClothState&, const ImplicitConstants<double>&, const ImplicitGrid<double>&);
template void store_state(const ImplicitGrid<float>&, const ImplicitConstants<float>&, ClothState&);
template void store_state(const ImplicitGrid<double>&, const ImplicitConstants<double>&, ClothState&);

}  // namespace fuai
