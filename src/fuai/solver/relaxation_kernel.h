// The inner loop of the relaxation: forces of springs, threads and weight on flat arrays, and one descent
// move.
// SPDX-License-Identifier: Apache-2.0
//
//   Every stencil of a lattice joins nodes that are a fixed stride apart: 1 (weft), columns (warp), columns +
//   1 and columns - 1 (diagonals). So each family is one long loop over the node index; where a stencil would
//   wrap round the border its weight is zero. Stencils write their own arrays, and one last pass gathers
//   them:
//
//     1 edges     dx[i] = x[i+s] - x[i]     T[i] = k (|d| - L) d / |d|,  U[i] = d / |d| for threads
//     2 triples   e = U[i] - U[i-s]         moment M from the law at the normal curvature kappa = e.n / l, or
//     as
//                 printed at sign |e| / l;  dE/de, its gradients GP[i], GR[i], and what turns the normal,
//                 dE/dU, which joins T
//     4 move      x += mobility F
//
//   All arrays carry columns + 1 zeros on both sides, so that no loop looks at the border.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fuai/cloth/lattice.h"
#include "fuai/energy/curvature.h"
#include "fuai/solver/bend_table.h"

namespace fuai {

/// Three coordinates of a quantity at every node.
struct KernelVectors {
  std::vector<double> x, y, z;
  void assign(std::size_t n) {
    x.assign(n, 0.0);
    y.assign(n, 0.0);
    z.assign(n, 0.0);
  }
};

/// The springs of one stride.
struct KernelSprings {
  std::size_t stride = 0;
  double rest_length = 0.0;
  std::vector<double> stiffness;  ///< [N/m]; zero where there is no edge
  std::vector<double> mask;       ///< 1 where there is an edge
  KernelVectors tension;          ///< T [N]
};

/// The triples of one thread direction.
struct KernelThread {
  KernelVectors unit;                     ///< U [-]
  std::vector<double> inverse_length;     ///< 1/|d| [1/m]
  KernelVectors sum;                      ///< e
  std::vector<double> sum_norm, on_face;  ///< |e|, e . N
  KernelVectors bend;                     ///< dE/de [J]; zero where there is no triple
  KernelVectors turn;                    ///< dE/d tangent of this thread at each node [J], through the normal
  KernelVectors gradient_p, gradient_r;  ///< GP, GR [N]
  std::vector<std::size_t> middle;       ///< padded index of each real triple's middle node
  std::vector<double> weight;            ///< tributary factor times l0^2 [m2] of each real triple
  BendTable table;
  std::vector<PlayState> memory;  ///< of each real triple
};

/// See the head of this file. Set it up with SolverRelaxation::prepare(); then every function is real-time.
class RelaxationKernel {
 public:
  /// What the set-up decides. Stiffness and weights are multiplied by the factors given per stencil.
  struct SetUp {
    double spring_stiffness = 0.0;       ///< [N/m]
    double mobility = 0.0;               ///< gamma2 [m/N]
    Vec3 weight = Vec3::Zero();          ///< weight of a whole node [N]
    bool weigh_nodes = true;             ///< tributary factors on the weight
    bool weigh_stencils = true;          ///< tributary factors on springs and triples
    bool as_printed = false;             ///< ends only, |t K / 2|
    std::array<const PlayLaw*, 2> laws;  ///< warp, weft
  };

  /// Thread class: set-up.
  void prepare(const LatticeModel& model, const SetUp& set_up);

  void load(const LatticeState& state) noexcept;
  void store(LatticeState& state) const noexcept;
  /// Forces at the loaded positions; friction memory moves to them.
  void compute_forces() noexcept;
  /// x += mobility * force.
  void move() noexcept;
  /// Largest |force|^2 over the nodes that may move [N2].
  double largest_force_squared() const noexcept;
  Vec3 force(int node) const noexcept;
  /// True when a triple was sharper than pi/4 in the last compute_forces().
  bool sharp_fold() const noexcept { return sharp_fold_; }

 private:
  void compute_springs(KernelSprings& springs, KernelThread* thread) noexcept;
  void compute_normals() noexcept;
  void compute_sums(KernelThread& thread, std::size_t stride) noexcept;
  void compute_moments(KernelThread& thread) noexcept;
  Vec3 energy_slope(KernelThread& thread, std::size_t triple) noexcept;
  Vec3 energy_slope_as_printed(const KernelThread& thread, std::size_t triple) noexcept;
  void turn_edges(KernelThread& thread, KernelSprings& springs) noexcept;
  void compute_gradients(KernelThread& thread, std::size_t stride) noexcept;
  void gather() noexcept;
  std::size_t padded(int node) const noexcept { return pad_ + static_cast<std::size_t>(node); }

  std::size_t nodes_ = 0, pad_ = 0;
  double leg_ = 1.0, inverse_leg_ = 1.0;
  bool as_printed_ = false, sharp_fold_ = false;
  KernelVectors position_, force_, weight_, normal_;
  std::vector<double> mobility_;
  std::array<KernelSprings, 4> springs_;  // weft, warp, diagonals
  std::array<KernelThread, 2> threads_;   // weft, warp: the order of the triples of the model
};

}  // namespace fuai
