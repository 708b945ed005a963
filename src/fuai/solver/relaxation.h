// The founding paper's solver: every particle goes down the gradient of stretching and bending energy.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", Eq. (6).
//
//   P(t+1) = P(t) - gamma1 dE_tns/dP - gamma2 dE_bnd/dP   (+ gamma2 weight, which the paper leaves out)
//
//   With k = 2 gamma1 / gamma2 this is P + gamma2 F, F the force of springs k, of bending and of weight:
//   gamma2 is a mobility [m/N], and the ratio k is the only spring stiffness in the method. Plane waves about
//   the flat sheet give the bounds (l0 spacing, B largest tangent dM/dK):
//     springs gamma1 < 1/8,   bending gamma2 < l0^2 / (16 B),   together 16 gamma1 + 32 B gamma2 / l0^2 < 2.
//
//   PaperMode        kAsPrinted                            kCorrected
//   gradient         of a particle's own triples: ends     full: the middle particle gets the reaction
//   law              ascending branch only, M(0) = +HB     elastic curve and friction with memory (PlayLaw)
//   curvature        sign |a + b| / l                      along the normal; within the sheet linear elastic
//   bending energy   |t K / 2|                             incremental potential W_n(K)
//   area weights     none                                  1, 1/2, 1/4 of l0^2
//
//   Sharp folds: both modes use the C1 form of Eq. (2); with the printed one a stiff drape ran to infinity.
//   The memory is committed at every step: the descent path is taken as the path of the cloth. The law is
//   rate-independent, so only the path counts; within the bounds springs + free energy + weight fall.
//   As printed the flat sheet is unstable: waves longer than four spacings grow, fastest at six.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fuai/cloth/lattice.h"
#include "fuai/core/constants.h"
#include "fuai/core/progress.h"
#include "fuai/fabric/laws.h"
#include "fuai/solver/relaxation_kernel.h"

namespace fuai {

/// The one switch between the paper's letter and its correction.
enum class PaperMode { kAsPrinted, kCorrected };

/// Which parts count only the cloth they stand for.
enum class AreaWeights {
  kNone,        ///< every particle, spring and triple whole (the paper)
  kWeightOnly,  ///< border nodes weigh 1/2 and 1/4; springs and triples whole
  kEverything,  ///< border springs and triples count half as well
};

/// The two constants of Eq. (6).
struct RelaxationSteps {
  double gamma1 = 0.0;  ///< [-]
  double gamma2 = 0.0;  ///< [m/N]
};

/// Spring stiffness of the reference drape [N/m]: 10 gf/cm, about a thousandth of a real thread's.
inline constexpr double kRelaxationSpringStiffness = 9.80665;

/// How to relax.
struct RelaxationOptions {
  PaperMode mode = PaperMode::kCorrected;
  std::optional<AreaWeights> area_weights;               ///< default: kNone as printed, else kEverything
  double spring_stiffness = kRelaxationSpringStiffness;  ///< k [N/m], > 0; not read when steps are given
  double step_fraction = 0.9;                            ///< of the joint bound, in (0, 1)
  std::optional<RelaxationSteps> steps;                  ///< chosen by the caller; k = 2 gamma1 / gamma2
  bool allow_unstable = false;                   ///< let steps go beyond the bound, to show what happens
  Vec3 gravity = {0.0, 0.0, -kStandardGravity};  ///< [m/s2]
};

/// Bits of RelaxationResult::status.
enum RelaxationStatus : std::uint32_t {
  kRelaxationNotFinite = 1,  ///< a position became infinite or NaN: the state is worthless
  kRelaxationStepLimit = 2,  ///< max_steps came before convergence
  kRelaxationSharpFold = 4,  ///< a thread is folded sharper than pi/4: the spacing is too coarse here
};

/// When to stop.
struct RelaxationStop {
  double tolerance = 1e-3;  ///< largest out-of-balance force, in weights of a whole node
  std::int64_t max_steps = 2'000'000;
  int check_every = 100;  ///< steps between two looks at the residual, > 0
};

/// What a run reached.
struct RelaxationResult {
  std::int64_t steps = 0;
  double residual = 0.0;  ///< largest out-of-balance force over the free nodes, in weights of a whole node
  bool converged = false;
  std::uint32_t status = 0;     ///< RelaxationStatus bits
  double max_stretch = 0.0;     ///< largest |d|/L - 1 over all springs [-]
  double stretch_energy = 0.0;  ///< [J]
  double bending_energy = 0.0;  ///< [J]: free energy, or |t K / 2| as printed
  double weight_energy = 0.0;   ///< [J], zero at the rest positions
  std::uint64_t position_hash = 0;
};

/// A triple at some state.
struct TripleReading {
  double curvature =
      0.0;              ///< [1/m], positive toward the face: along the normal, or as printed sign |a + b| / l
  double moment = 0.0;  ///< t per width [N]: the law's with memory, or as printed the ascending branch
  double energy = 0.0;  ///< per area [J/m2]: free energy and in-plane part, or |t K / 2| as printed
  double in_plane_energy = 0.0;  ///< per area [J/m2]: of the thread bent within the sheet; none as printed
};

/// Full gradient of the bending energy of a triple: through the nodes of the triple and of the edges at its
/// middle.
struct TripleGradient {
  std::array<int, 11> nodes{};  ///< a node may come more than once
  std::array<Vec3, 11> values;  ///< [N]
  std::size_t count = 0;
  void add(int node, const Vec3& value) noexcept {
    nodes[count] = node;
    values[count++] = value;
  }
};

/// Eq. (6). Build, prepare() once, then step() or run().
class SolverRelaxation {
 public:
  /// Sets up for one model. Of the laws it reads bending[warp], bending[weft]. Model and laws are not copied:
  /// they must outlive the solver.
  /// @throws Error (kUsage) when an option is out of range, or given steps are not below the stability bound
  /// and allow_unstable is off. Thread class: set-up.
  void prepare(const LatticeModel& model, const FabricLaws& laws, const RelaxationOptions& options = {});

  /// One step of Eq. (6); the friction memory moves to the positions before the step. Thread class:
  /// real-time.
  void step(LatticeState& state) noexcept;

  /// Steps until the residual is below the tolerance. Progress counts max_steps. Deterministic.
  /// Thread class: set-up.
  RelaxationResult run(LatticeState& state, const RelaxationStop& stop = {}, const Progress& progress = {});

  /// Force on a node in the last step [N]: all terms, also at fixed nodes. Thread class: real-time.
  Vec3 force(int node) const noexcept { return kernel_.force(node); }
  /// Forces at a state without a move; its memory does not change. Thread class: real-time.
  void compute_forces(const LatticeState& state) noexcept;
  /// Largest out-of-balance force of the last step or compute_forces(), in weights of a whole node.
  double residual() const noexcept;

  const RelaxationSteps& steps() const noexcept { return steps_; }
  /// k = 2 gamma1 / gamma2 [N/m].
  double spring_stiffness() const noexcept { return 2.0 * steps_.gamma1 / steps_.gamma2; }
  const RelaxationOptions& options() const noexcept { return options_; }
  const LatticeModel& model() const noexcept { return *model_; }  ///< prepare() first
  const FabricLaws& laws() const noexcept { return *laws_; }      ///< prepare() first
  AreaWeights area_weights() const noexcept { return area_weights_; }
  /// One triple of a state, by its index in the model. Thread class: real-time.
  TripleReading read_triple(const LatticeState& state, std::size_t triple) const noexcept;
  /// Its full gradient, area weight included, in both modes. Thread class: real-time.
  TripleGradient triple_gradient(const LatticeState& state, std::size_t triple) const noexcept;
  /// Energies and stretch of a state. Thread class: real-time.
  RelaxationResult measure(const LatticeState& state) const noexcept;

 private:
  CurvatureStencil stencil(const LatticeState& state, const LatticeTriple& triple) const noexcept;

  const LatticeModel* model_ = nullptr;  // not owned: outlives the solver
  const FabricLaws* laws_ = nullptr;     // not owned
  RelaxationOptions options_;
  RelaxationSteps steps_;
  AreaWeights area_weights_ = AreaWeights::kEverything;
  double node_weight_ = 1.0;  // [N]
  RelaxationKernel kernel_;
};

/// Largest tangent dM/dK that a triple of this law can show between the folds +-2/l0, and over the measured
/// range [N m]: the B of the stability bounds. With friction all elements stick; the printed branch has no
/// stick. Thread class: set-up.
double bending_stiffness_bound(const PlayLaw& law, double spacing, PaperMode mode);

/// Left side of the joint bound, 16 gamma1 + 32 B gamma2 / l0^2: the descent is stable below 2.
/// @param stiffness B [N m] @param spacing l0 [m]. Thread class: any.
constexpr double relaxation_stability_number(const RelaxationSteps& steps, double stiffness, double spacing) {
  return 16.0 * steps.gamma1 + 32.0 * stiffness * steps.gamma2 / (spacing * spacing);
}

}  // namespace fuai
