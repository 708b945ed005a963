// States of cloth into and out of the arrays of the implicit solver.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/cloth/cloth_model.h"
#include "fuai/solver/implicit_grid.h"

namespace fuai {

/// Positions, velocities and friction memory of a state into the arrays. Thread class: set-up.
template <class T>
void load_state(const ClothState& state, const ImplicitConstants<T>& constants, const ImplicitGrid<T>& grid);
/// And out of them: loading the result gives the same bits. Thread class: set-up.
template <class T>
void store_state(const ImplicitGrid<T>& grid, const ImplicitConstants<T>& constants, ClothState& state);

extern template void load_state(const ClothState&, const ImplicitConstants<float>&,
                                const ImplicitGrid<float>&);
extern template void load_state(const ClothState&, const ImplicitConstants<double>&,
                                const ImplicitGrid<double>&);
extern template void store_state(const ImplicitGrid<float>&, const ImplicitConstants<float>&, ClothState&);
extern template void store_state(const ImplicitGrid<double>&, const ImplicitConstants<double>&, ClothState&);

}  // namespace fuai
