// The paper's bending experiment: a strip of 17 x 9 particles, bent and felt at one particle.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", section 4.2 (Figs.
// 6-8).
//
//   (i)  impose_cylinder(): every particle is put on a uniform cylinder; nothing is solved
//   (ii) bend_to(): the first two columns are clamped and the middle particle of the last column is moved
//   along the
//        arc that pure bending would give, z = (1 - cos K s) / K; the rest relaxes. Going back to smaller
//        curvatures unloads, and the friction shows.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "fuai/solver/grasp_force.h"
#include "fuai/solver/relaxation.h"

namespace fuai {

/// The defaults are the paper's 17 x 9 particles at 1 cm, without gravity (section 4.2 mentions none).
struct PaperBendingOptions {
  PaperBendingOptions() { relaxation.gravity = Vec3::Zero(); }
  double length = 0.16;   ///< along the weft [m], a whole multiple of the spacing
  double width = 0.08;    ///< along the warp [m], an even multiple of the spacing
  double spacing = 0.01;  ///< l0 [m]
  RelaxationOptions relaxation;
  RelaxationStop stop;
  double largest_move = 0.001;  ///< the grip moves at most this far [m] before the sheet may follow
  int steps_per_move = 200;     ///< descent steps after each such move
};

/// Model, state and solver, ready for bend_to() or impose_cylinder().
struct PaperBending {
  PaperBendingOptions options;
  std::unique_ptr<const LatticeModel> model;
  std::unique_ptr<const FabricLaws> laws;
  LatticeState state;
  SolverRelaxation solver;
  int grip = 0;                ///< the moved particle
  double arc_curvature = 0.0;  ///< of the last bend_to() [1/m]
};

/// What one stage of the experiment shows.
struct PaperBendingStage {
  double arc_curvature = 0.0;   ///< K of the arc on which the grip lies [1/m]
  double grip_curvature = 0.0;  ///< of the triple that ends at the grip [1/m]
  double mid_curvature = 0.0;   ///< of the triple in the middle of the strip [1/m]
  double arc_moment = 0.0;      ///< the printed branch F_e + Y at the arc curvature, per width [N]
  double grip_moment = 0.0;     ///< t of the triple that ends at the grip, as in Eq. (7) [N]
  GraspForce force;             ///< on the hand [N]
  RelaxationResult relaxation;  ///< how well the sheet has settled
  std::vector<Vec3> positions;  ///< [m] (nodes)
};

/// The end of an arc that leaves the origin along x and bends up [m]: the way of the grip from the clamp's
/// edge. @param length of the arc [m] @param curvature [1/m]. Thread class: any.
Vec3 paper_arc_point(double length, double curvature);

/// Builds the strip, flat.
/// @throws Error (kUsage) when the sides do not fit the spacing or the solver refuses its options.
/// Thread class: set-up.
PaperBending make_paper_bending(const FabricLaws& laws, const PaperBendingOptions& options = {});

/// Puts every particle on a cylinder along the warp, legs of rest length, with the given curvature of every
/// weft triple, and commits the friction memory along the monotone path from flat.
/// @param curvature [1/m], |curvature| l0 < 2. Thread class: set-up.
void impose_cylinder(PaperBending& scene, double curvature);

/// Moves the grip to the arc of a curvature in small moves, lets the sheet settle, and reads everything.
/// @param curvature [1/m]; may be smaller than before. Thread class: set-up.
PaperBendingStage bend_to(PaperBending& scene, double curvature, const Progress& progress = {});

/// bend_to() for each curvature in turn. Thread class: set-up.
std::vector<PaperBendingStage> run_paper_bending(const FabricLaws& laws, std::span<const double> curvatures,
                                                 const PaperBendingOptions& options = {},
                                                 const Progress& progress = {});

}  // namespace fuai
