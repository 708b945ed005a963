// The vector kernels of the implicit solver, chosen for the processor at run time.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/implicit-step.md.
#pragma once

#include "fuai/solver/implicit_grid.h"

namespace fuai {

/// What an evaluation leaves behind besides forces and strains.
enum class Evaluation {
  kForces,     ///< nothing
  kLinearise,  ///< the linearisation arrays
};

/// Kernels over rows [begin, end), or over vectors of rows or columns where said. All are
/// noexcept, allocate nothing and write only what belongs to their rows, so that rows may be shared out to
/// threads in any way without changing a bit. Sums go to `partial`, one a row.
template <class T>
struct ImplicitKernels {
  using Grid = ImplicitGrid<T>;
  /// force = -dE/dx of internal energy, weight, inertia and air; strains; the linearisation on request.
  void (*evaluate)(const Grid&, const ImplicitConstants<T>&, const ImplicitStepConstants<T>&, Evaluation,
                   int begin, int end);
  /// Moves the friction memory to the strains of the last evaluation and remembers the strains of the edges.
  void (*commit)(const Grid&, const ImplicitConstants<T>&, int begin, int end);
  /// q = A p; partial = p.q. Nodes that are not mobile are left out.
  void (*multiply)(const Grid&, const ImplicitConstants<T>&, int begin, int end);
  /// Diagonal blocks of A and couplings along the yarns into the storage of the lines; without links the
  /// preconditioner is block Jacobi. Vectors of rows.
  void (*assemble)(const Grid&, const ImplicitConstants<T>&, bool links, int begin, int end);
  /// Factors the rows of half 0 (the first ones) or 1 of the warp lines of vectors of columns, all but the
  /// row where they meet; then that row, over vectors of columns, when both are done.
  void (*factor_warp)(const Grid&, int half, int begin, int end);
  void (*factor_meeting)(const Grid&, int begin, int end);
  /// Factors the weft lines of vectors of rows.
  void (*factor_weft)(const Grid&, int begin, int end);
  /// force -= alpha q, with partial = force.force; then q = (warp lines)^-1 force: half of the rows from the
  /// end of the cloth in to the meeting row, and, when both halves are there, out again. Vectors of columns
  /// of a half, and so the sums. Without alpha the sums are zero.
  void (*solve_warp_in)(const Grid&, T alpha, int half, int begin, int end);
  void (*solve_warp_out)(const Grid&, int half, int begin, int end);
  /// q = (q + (weft lines)^-1 force) / 2; partial = force.q. Vectors of rows, the sums a row.
  /// @param scratch scratch_size() numbers, one set a caller
  void (*solve_weft)(const Grid&, T* scratch, int begin, int end);
  /// d += alpha p.
  void (*advance)(const Grid&, T alpha, int begin, int end);
  /// d += alpha p, p = q + beta p.
  void (*direct)(const Grid&, T alpha, T beta, int begin, int end);
  /// force *= mobile, d = p = 0; partial = force.force.
  void (*begin_solve)(const Grid&, int begin, int end);
  /// xn = x.
  void (*keep)(const Grid&, int begin, int end);
  /// x of mobile nodes = xn + scale v.
  void (*replace)(const Grid&, T scale, int begin, int end);
  /// d *= scale.
  void (*scale_d)(const Grid&, T scale, int begin, int end);
  /// v = a = 0.
  void (*stop)(const Grid&, int begin, int end);
  /// x += scale d.
  void (*move)(const Grid&, T scale, int begin, int end);
  /// partial = force.d and force.v over mobile nodes.
  void (*work_d)(const Grid&, int begin, int end);
  void (*work_v)(const Grid&, int begin, int end);
  /// partial = d.d.
  void (*length_d)(const Grid&, int begin, int end);
  /// partial = force.force over mobile nodes.
  void (*square)(const Grid&, int begin, int end);
  /// v and a at x, xn = x; over mobile nodes partial = (force of the cloth).v without inertia and weight,
  /// partial_kinetic = m v.(v + past_dt a), partial_weight = theta^2 dt m g.v.
  void (*finish)(const Grid&, const ImplicitConstants<T>&, const ImplicitStepConstants<T>&, int begin,
                 int end);
  /// Numbers of scratch that solve_weft needs.
  int (*scratch_size)(const Grid&);
  const char* target = "";  ///< name of the instruction set
  int lanes = 0;            ///< numbers a vector
};

/// The kernels for this processor. Thread class: set-up.
template <class T>
const ImplicitKernels<T>& implicit_kernels();
template <>
const ImplicitKernels<float>& implicit_kernels<float>();
template <>
const ImplicitKernels<double>& implicit_kernels<double>();

}  // namespace fuai
