// Static equilibrium of a small piece held by rigid clamps: Newton's method with a direct solve.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/virtual-kes.md, "Solver"; energies: cloth_energy.h.
//
//   make -> add_clamp -> [set_freedom / place -> settle -> read]* -> commit -> ...
//
//   A clamp is a frame: its slots sit at  pivot + shift + R (rest - pivot).  R and shift are told, but along
//   a freedom the clamp moves by itself until the cloth pulls on it with the force that is told. settle()
//   finds  dW_n/dx = loads  from the memory of the last commit(); it may be called again with other places
//   before commit(), so that a stop ("until 500 gf/cm") is found by trying.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/solver/cloth_material.h"

namespace fuai {

/// How to solve.
struct StaticOptions {
  std::array<bool, 3> axes{true, true, true};  ///< along which free slots move: a plane test leaves one out
  Vec3 gravity = Vec3::Zero();                 ///< [m/s2]
  double tolerance = 1e-9;    ///< force out of balance, root of the sum of squares, as a part of the
                              ///< forces on the clamps
  double least_force = 1e-9;  ///< the same where there is next to no force [N]
  int most_iterations = 80;   ///< of one settle()
};

/// What settle() reached.
struct StaticReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;  ///< force out of balance [N]
};

/// What a clamp shows.
struct ClampReading {
  Vec3 force = Vec3::Zero();   ///< of the cloth on the clamp, without the weight of what it holds [N]
  Vec3 moment = Vec3::Zero();  ///< of the same about the pivot where it is now [N m]
  Vec3 shift = Vec3::Zero();   ///< of the pivot, what was told and what is free [m]
};

struct StaticSystem;

/// The solver. Double throughout; deterministic.
class SolverStatic {
 public:
  /// Copies model, material and state. @throws Error (kUsage) for options out of range. Thread class: set-up.
  SolverStatic(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
               const StaticOptions& options);
  ~SolverStatic();
  SolverStatic(SolverStatic&&) noexcept;
  SolverStatic& operator=(SolverStatic&&) noexcept;

  /// Takes hold of fixed slots. All slots that the model fixes and no clamp holds stay where they are.
  /// @param pivot about which the clamp turns, in the coordinates of the state [m]  @return its number
  /// @throws Error (kUsage) when a slot is not fixed. Thread class: set-up.
  std::size_t add_clamp(std::span<const int> slots, const Vec3& pivot);
  /// Lets a clamp move along a direction, in addition to those it has, until it is pulled by `force`.
  /// @param direction unit vector, at right angles to the clamp's other freedoms
  /// @param force that the instrument puts on the clamp along it [N]. Thread class: set-up.
  void set_freedom(std::size_t clamp, const Vec3& direction, double force);
  /// Takes a clamp's freedoms away; it is told to stay where they brought it. Thread class: set-up.
  void hold(std::size_t clamp);
  /// Of the next settle() [m/s2].
  void set_gravity(const Vec3& gravity) noexcept;
  /// Where a clamp is at the next settle(). @param shift of the pivot from where it was at add_clamp() [m]
  void place(std::size_t clamp, const Mat3& rotation, const Vec3& shift);

  /// Where the next settle() starts from instead of its own linear guess: free slots [m] (slots), and how far
  /// a clamp goes along its freedoms. Cloth turns where a line shears; who knows how, saves iterations.
  void suggest(std::span<const Vec3> positions);
  void suggest_shift(std::size_t clamp, const Vec3& change);

  /// Puts the clamps in their places and finds the rest shape from the present one. Nothing is committed.
  /// Thread class: set-up.
  StaticReport settle();
  /// Accepts the shape: the friction memory moves.
  void commit();
  /// Back to the shape of the last commit(), places too.
  void roll_back();

  ClampReading read(std::size_t clamp) const;
  /// Forces of the cloth on every slot as of the last settle(), without weight [N] (slots).
  std::span<const Vec3> forces() const noexcept;
  /// Positions as of the last settle(), memory as of the last commit().
  const ClothState& state() const noexcept;
  const ClothModel& model() const noexcept;
  /// Newton iterations since the beginning.
  int iterations() const noexcept;

 private:
  std::unique_ptr<StaticSystem> parts_;
};

}  // namespace fuai
