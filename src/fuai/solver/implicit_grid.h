// The arrays of the implicit solver: one piece of cloth as padded rows of numbers.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/implicit-step.md.
//
//   node (column, row) is number index(column, row) of every array. A row is cut into as many equal runs of
//   columns as a vector has lanes, one run a lane: the neighbour of a vector's nodes along the weft is the
//   next vector, lane by lane, and only the last vector's neighbour is the first one with its lanes moved by
//   one. There the last lane wraps round to the first column, which elements without cloth multiply by zero.
//   A row of zeros lies before the first and after the last row, so that every neighbour can be read.
#pragma once

#include <cstddef>

#include "fuai/core/types.h"
#include "fuai/solver/law_table.h"

namespace fuai {

inline constexpr int kPadRows = 1;
/// Of the widest machine.
inline constexpr std::size_t kVectorBytes = 64;

/// Of a node in the storage of the line solves.
inline constexpr int kLineFields = 12;

/// What stays the same during a step.
template <class T>
struct ImplicitConstants {
  T h = 1, inverse_h = 1;  ///< spacing [m]
  T twist = 0;             ///< 4 Bt / h^4, times the area: stiffness of D12 [1/m2 N/m]
  T poisson_bending = 0;   ///< B12 [N m]
  T free_edge_weft = 0,
    free_edge_warp = 0;  ///< B12^2 / B of the other direction [N m]: taken off at a free edge
  T viscosity_weft = 0, viscosity_warp = 0;  ///< eta [N s/m]
  T most_fold = 0;                           ///< no fold is taken for stiffer than this [N/m]
  T areal_mass = 0;                          ///< [kg/m2]
  T mass_drag = 0;                           ///< c [1/s]
  T air_normal = 0, air_tangential = 0;      ///< rho C / 2 [kg/m3]
  LawTableView<T> weft_bending, warp_bending, shear, weft_tension, warp_tension;
};

/// What changes from step to step but not within one.
template <class T>
struct ImplicitStepConstants {
  T dt = 0, inverse_dt = 0;
  T inertia = 0;         ///< (1 + c theta^2 dt) / (theta dt)^2 [1/s2]
  T velocity_gain = 0;   ///< dt / (1 + c theta^2 dt): y = xn + this * (v + past_dt a + theta^2 dt g) [s]
  T gravity_dt[3] = {};  ///< theta^2 dt g [m/s]
  T past_dt = 0;         ///< theta (1 - theta) dt: for how long the last acceleration goes on [s]
  T inverse_reach = 0;   ///< 1 / (theta dt) [1/s]
  T past = 0;            ///< (1 - theta) / theta
  T wind_dt[3] = {};     ///< dt times the velocity of the air [m]
};

/// Three components of one field.
template <class T>
struct Field3 {
  T* x = nullptr;
  T* y = nullptr;
  T* z = nullptr;
};

/// One number of each component.
template <class T>
Vec3 vector_at(const Field3<T>& field, std::ptrdiff_t p) noexcept {
  return {static_cast<double>(field.x[p]), static_cast<double>(field.y[p]), static_cast<double>(field.z[p])};
}
template <class T>
void put(const Field3<T>& field, std::ptrdiff_t p, const Vec3& value) noexcept {
  field.x[p] = static_cast<T>(value.x());
  field.y[p] = static_cast<T>(value.y());
  field.z[p] = static_cast<T>(value.z());
}

/// The arrays (nodes each, unless said).
template <class T>
struct ImplicitGrid {
  int columns = 0, rows = 0;
  int lanes = 0;    ///< numbers a vector
  int vectors = 0;  ///< a row
  int stride = 0;   ///< numbers a row
  // Constant.
  T* node_area = nullptr;   ///< [m2]; negative where the node is fixed or not live
  T* cell_area = nullptr;   ///< [m2]
  T* twist_area = nullptr;  ///< [m2]
  T* weft_edge = nullptr;   ///< areas [m2]
  T* warp_edge = nullptr;
  T* weft_bend = nullptr;
  T* warp_bend = nullptr;
  T* weft_curve = nullptr;  ///< 2 / bend length [1/m]
  T* warp_curve = nullptr;
  // State.
  Field3<T> x, v, a;           ///< positions, velocities, accelerations
  T* weft_strain_n = nullptr;  ///< strains at the start of the step, for viscosity
  T* warp_strain_n = nullptr;
  T* memory_weft_bending[kMaxPlays] = {};
  T* memory_warp_bending[kMaxPlays] = {};
  T* memory_shear[kMaxPlays] = {};
  T* memory_weft_tension[kMaxPlays] = {};
  T* memory_warp_tension[kMaxPlays] = {};
  // One step.
  Field3<T> xn;       ///< positions at its start
  Field3<T> force;    ///< -dE/dx of the step's potential; then the residual of the linear solve
  Field3<T> d, p, q;  ///< solution, direction, and A p or P r
  T* strain[5] =
      {};  ///< kappa weft, kappa warp, gamma, eps weft, eps warp of the last evaluation; shares p and q
  // Linearisation.
  T* ground = nullptr;  ///< stiffness to the world, isotropic: inertia, tangential air, grasp [N/m]
  T* air = nullptr;     ///< the same along the normal, in addition; null without air
  Field3<T> weft_axis, warp_axis;  ///< sqrt(k_along) u of the edges
  T* weft_side = nullptr;          ///< k_across of the edges [N/m]
  T* warp_side = nullptr;
  Field3<T> normal;
  T* weft_stiff = nullptr;  ///< of n.D1, n.D2 and their product [N/m]
  T* warp_stiff = nullptr;
  T* cross_stiff = nullptr;           ///< null without B12
  Field3<T> shear_plus, shear_minus;  ///< sqrt(k) times the gradient of gamma at x11 and at x10
  // Lines, one a lane: vector after vector of lines, node after node, kLineFields vectors each: 6 of the
  // inverted diagonal (xx, xy, xz, yy, yz, zz) and 6 of the coupling to the next node.
  T* warp_lines = nullptr;
  T* weft_lines = nullptr;
  Field3<T> meeting[2];  ///< what the halves of the warp lines bring to the row where they meet, one row
                         ///< each; shares the rows of d outside the cloth
  // Partial sums, one a row (of solve_warp_in: one a vector of columns of a half).
  double* partial = nullptr;
  double* partial_kinetic = nullptr;
  double* partial_weight = nullptr;

  std::ptrdiff_t at(int row) const noexcept { return static_cast<std::ptrdiff_t>(row + kPadRows) * stride; }
  std::ptrdiff_t index(int column, int row) const noexcept {
    return at(row) + static_cast<std::ptrdiff_t>(column % vectors) * lanes + column / vectors;
  }
  /// Of a slot of the model.
  std::ptrdiff_t slot_index(int slot) const noexcept { return index(slot % columns, slot / columns); }
  /// Whether the node of an index is live and not fixed.
  bool mobile(std::ptrdiff_t index) const noexcept { return node_area[index] > T(0); }
  int row_vectors() const noexcept { return (rows + lanes - 1) / lanes; }
  std::ptrdiff_t warp_line(int vector, int row) const noexcept {
    return (static_cast<std::ptrdiff_t>(vector) * rows + row) * kLineFields * lanes;
  }
  std::ptrdiff_t weft_line(int row_vector, int column) const noexcept {
    return (static_cast<std::ptrdiff_t>(row_vector) * stride + column) * kLineFields * lanes;
  }
};

}  // namespace fuai
