// The inside of SolverStatic: unknowns, forces, Hessian, steps.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "fuai/solver/static.h"

namespace fuai {

/// A clamp and where it is.
struct StaticClamp {
  std::vector<std::size_t> slots;
  std::vector<Vec3> arms;  // from the pivot, unturned
  Vec3 pivot;
  Mat3 rotation = Mat3::Identity();
  Vec3 shift = Vec3::Zero();  // told
  struct Freedom {
    Vec3 direction;
    double force = 0.0, way = 0.0;
    Eigen::Index unknown = -1;
  };
  std::vector<Freedom> freedoms;

  Vec3 whole_shift() const {
    Vec3 sum = shift;
    for (const Freedom& f : freedoms) sum += f.way * f.direction;
    return sum;
  }
};

/// What one coordinate of a slot follows.
struct StaticFollows {
  Eigen::Index unknown;
  double factor;
};

/// Everything of a SolverStatic.
struct StaticSystem {
  ClothModel model;
  ClothMaterial material;
  StaticOptions options;
  ClothState state;             // positions of the last settle(), memory of the last commit()
  std::vector<Vec3> committed;  // positions
  std::vector<StaticClamp> clamps, committed_clamps;
  std::vector<Vec3> forces;
  ClothState scratch;                               // memory that an evaluation may spoil
  std::vector<std::vector<StaticFollows>> follows;  // 3 slot + axis
  Eigen::Index unknowns = 0;
  bool mapped = false, suggested = false;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::SparseMatrix<double> matrix;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
  std::vector<int> pattern_outer, pattern_inner;  // of the matrix that `factor` has analysed
  int iterations = 0;
  double scale = 0.0;  // of the forces of the elements

  enum class Step { kNone, kExact, kSafe };

  void map_unknowns();
  void place_clamps();
  /// Forces of the cloth on every slot, from the committed memory.
  void evaluate();
  /// Force on each unknown. @return root of the sum of squares [N]
  double residual(Eigen::VectorXd& r);
  /// Hessian over the unknowns (lower half), and what known displacements of the slots pull on them.
  void assemble(bool safe, const std::vector<Vec3>& known, Eigen::VectorXd& pull);
  /// @return whether the matrix is positive definite
  bool factorise();
  /// One Newton step. The exact Hessian first; where it is not positive, the safe one, stiffened until it is.
  Step solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& step);
  /// What an equilibrium makes least: the incremental potential, the weight's and that of the clamps' loads
  /// [J].
  double potential();
  /// Force out of balance at which the cloth counts as at rest [N].
  double limit() const;
  /// Newton's method from where the cloth is. @return force out of balance [N]
  double find_rest(int& iterations_done);
  /// Goes along a step, half as far each time until it is of use.
  void take(Step kind, const Eigen::VectorXd& step, Eigen::VectorXd& force, double& residual_now);
  /// No further than slots may move in one iteration.
  double largest_share(const Eigen::VectorXd& step) const;
  void move(const Eigen::VectorXd& step, double share);
  /// Lets the free slots follow the clamps from where they were before these moved, to first order: otherwise
  /// the outermost edges alone would take the whole move, far up the curves of their laws.
  void predict(const std::vector<Vec3>& from);
};

}  // namespace fuai
