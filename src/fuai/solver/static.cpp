// Newton's method with a sparse factorisation.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/static.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/solver/cloth_energy.h"
#include "fuai/solver/static_hessian.h"

namespace fuai {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// No slot moves further than this in one iteration [spacings].
constexpr double kLargestMove = 0.5;
/// A step is halved so often at most while the force out of balance does not fall.
constexpr int kHalvings = 8;
/// What is added to the diagonal where the Hessian is not positive, as a part of its largest entry.
constexpr double kFirstShift = 1e-6, kShiftGrowth = 10.0;
/// What is always added: slack yarns have no stiffness at all along themselves, and nothing pulls on them.
constexpr double kLeastShift = 1e-12;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct Clamp {
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
struct Follows {
  Eigen::Index unknown;
  double factor;
};
/// A row of a block and what it follows.
struct Row {
  Eigen::Index place;
  Follows to;
};

}  // namespace

struct SolverStatic::Parts {
  ClothModel model;
  ClothMaterial material;
  StaticOptions options;
  ClothState state;             // positions of the last settle(), memory of the last commit()
  std::vector<Vec3> committed;  // positions
  std::vector<Clamp> clamps, committed_clamps;
  std::vector<Vec3> forces;
  ClothState scratch;                         // memory that an evaluation may spoil
  std::vector<std::vector<Follows>> follows;  // 3 slot + axis
  Eigen::Index unknowns = 0;
  bool mapped = false, suggested = false;
  std::vector<Eigen::Triplet<double>> entries;
  Sparse matrix;
  Eigen::SimplicialLDLT<Sparse> factor;
  std::vector<int> pattern_outer, pattern_inner;  // of the matrix that `factor` has analysed
  int iterations = 0;
  double scale = 0.0;  // of the forces of the elements

  void map_unknowns();
  void place_clamps();
  void evaluate();
  double residual(Vector& r);
  void assemble(bool safe, const std::vector<Vec3>& known, Vector& pull);
  bool factorise();
  bool solve(const Vector& rhs, Vector& step);
  void predict(const std::vector<Vec3>& from);
  void move(const Vector& step, double share);
};

void SolverStatic::Parts::map_unknowns() {
  if (mapped) return;
  follows.assign(3 * state.positions.size(), {});
  unknowns = 0;
  for (std::size_t slot = 0; slot < state.positions.size(); ++slot) {
    if (model.live[slot] == 0 || model.fixed[slot] != 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (options.axes[axis]) follows[3 * slot + axis].push_back({unknowns++, 1.0});
    }
  }
  for (Clamp& clamp : clamps) {
    for (Clamp::Freedom& freedom : clamp.freedoms) {
      freedom.unknown = unknowns++;
      for (std::size_t slot : clamp.slots) {
        for (int axis = 0; axis < 3; ++axis) {
          if (freedom.direction[axis] != 0.0)
            follows[3 * slot + at(axis)].push_back({freedom.unknown, freedom.direction[axis]});
        }
      }
    }
  }
  mapped = true;
}

void SolverStatic::Parts::place_clamps() {
  for (const Clamp& clamp : clamps) {
    const Vec3 centre = clamp.pivot + clamp.whole_shift();
    for (std::size_t i = 0; i < clamp.slots.size(); ++i)
      state.positions[clamp.slots[i]] = centre + clamp.rotation * clamp.arms[i];
  }
}

/// Forces of the cloth on every slot, from the committed memory.
void SolverStatic::Parts::evaluate() {
  scratch.positions = state.positions;
  scratch.weft_bending = state.weft_bending, scratch.warp_bending = state.warp_bending;
  scratch.shear = state.shear;
  scratch.weft_tension = state.weft_tension, scratch.warp_tension = state.warp_tension;
  advance_cloth(model, material, scratch, forces);
}

/// Force on each unknown. @return root of the sum of squares [N]
double SolverStatic::Parts::residual(Vector& r) {
  r.setZero(unknowns);
  double reactions = 0.0;
  for (std::size_t slot = 0; slot < state.positions.size(); ++slot) {
    if (model.live[slot] == 0) continue;
    if (model.fixed[slot] != 0) reactions += forces[slot].squaredNorm();
    const Vec3 f = forces[slot] + model.areal_mass * model.node_area[slot] * options.gravity;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const Follows& to : follows[3 * slot + axis])
        r[to.unknown] += to.factor * f[static_cast<Eigen::Index>(axis)];
    }
  }
  for (const Clamp& clamp : clamps) {
    for (const Clamp::Freedom& freedom : clamp.freedoms) {
      r[freedom.unknown] += freedom.force;
      reactions += freedom.force * freedom.force;
    }
  }
  scale = std::sqrt(reactions);
  return r.norm();
}

/// Hessian over the unknowns (lower half), and what known displacements of the slots pull on them.
void SolverStatic::Parts::assemble(bool safe, const std::vector<Vec3>& known, Vector& pull) {
  const HessianPoint point{model, material, state, state.positions, options.axes, safe};
  entries.clear();
  pull.setZero(unknowns);
  HessianBlock block;
  std::vector<Row> rows;
  const auto add = [&] {
    rows.clear();
    for (std::size_t a = 0; a < 3 * block.count; ++a) {
      for (const Follows& to : follows[3 * block.slots[a / 3] + a % 3])
        rows.push_back({static_cast<Eigen::Index>(a), to});
    }
    for (const Row& i : rows) {
      for (const Row& j : rows) {
        if (j.to.unknown <= i.to.unknown) {
          const double value = i.to.factor * block.values(i.place, j.place) * j.to.factor;
          entries.emplace_back(i.to.unknown, j.to.unknown, value);
        }
      }
    }
    for (std::size_t b = 0; !known.empty() && b < 3 * block.count; ++b) {
      const double way = known[block.slots[b / 3]][static_cast<Eigen::Index>(b % 3)];
      if (way == 0.0) continue;
      for (const Row& i : rows)
        pull[i.to.unknown] -= i.to.factor * block.values(i.place, static_cast<Eigen::Index>(b)) * way;
    }
  };
  for (std::size_t slot = 0; slot < state.positions.size(); ++slot) {
    if (edge_block(point, slot, 0, block)) add();
    if (edge_block(point, slot, 1, block)) add();
    if (cell_block(point, slot, block)) add();
    if (bend_block(point, slot, block)) add();
  }
  matrix.resize(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
}

/// Factorises the matrix. @return whether it is positive definite
bool SolverStatic::Parts::factorise() {
  // A collapsed element leaves its entries out, so the pattern is compared each time.
  const auto* outer = matrix.outerIndexPtr();
  const auto* inner = matrix.innerIndexPtr();
  const std::vector<int> now_outer(outer, outer + matrix.outerSize() + 1),
      now_inner(inner, inner + matrix.nonZeros());
  if (now_outer != pattern_outer || now_inner != pattern_inner) {
    factor.analyzePattern(matrix);
    pattern_outer = now_outer, pattern_inner = now_inner;
  }
  factor.factorize(matrix);
  return factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 0.0;
}

/// One Newton step. The exact Hessian first; where it is not positive, the safe one, stiffened until it is.
bool SolverStatic::Parts::solve(const Vector& rhs, Vector& step) {
  Vector unused;
  for (bool safe : {false, true}) {
    assemble(safe, {}, unused);
    const double largest = matrix.diagonal().cwiseAbs().maxCoeff();
    for (double shift = kLeastShift; shift < 1.0; shift = std::max(kFirstShift, shift * kShiftGrowth)) {
      matrix.diagonal().array() += shift * largest;
      if (factorise()) {
        step = factor.solve(rhs);
        if (step.allFinite()) return true;
      }
      if (!safe) break;
    }
  }
  return false;
}

void SolverStatic::Parts::move(const Vector& step, double share) {
  for (std::size_t slot = 0; slot < state.positions.size(); ++slot) {
    if (model.fixed[slot] != 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const Follows& to : follows[3 * slot + axis])
        state.positions[slot][static_cast<Eigen::Index>(axis)] += share * to.factor * step[to.unknown];
    }
  }
  for (Clamp& clamp : clamps) {
    for (Clamp::Freedom& freedom : clamp.freedoms) freedom.way += share * step[freedom.unknown];
  }
  place_clamps();
}

/// Lets the free slots follow the clamps from where they were before these moved, to first order: otherwise
/// the outermost edges alone would take the whole move, far up the curves of their laws.
void SolverStatic::Parts::predict(const std::vector<Vec3>& from) {
  std::vector<Vec3> known(state.positions.size(), Vec3::Zero());
  double moved = 0.0;
  for (const Clamp& clamp : clamps) {
    for (std::size_t slot : clamp.slots) {
      known[slot] = state.positions[slot] - from[slot];
      moved = std::max(moved, known[slot].norm());
    }
  }
  if (moved == 0.0) return;
  const std::vector<Vec3> placed = std::exchange(state.positions, from);
  Vector pull;
  assemble(true, known, pull);
  state.positions = placed;
  if (!factorise()) return;
  const Vector step = factor.solve(pull);
  if (step.allFinite() && step.cwiseAbs().maxCoeff() < 4.0 * moved + model.spacing) move(step, 1.0);
}

SolverStatic::SolverStatic(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                           const StaticOptions& options)
    : parts_(std::make_unique<Parts>()) {
  if (!(options.tolerance > 0.0) || !(options.least_force > 0.0) || options.most_iterations < 1) {
    throw Error(ErrorKind::kUsage, "a static solve needs a positive tolerance and at least one iteration");
  }
  Parts& p = *parts_;
  p.model = model, p.material = material, p.options = options;
  p.state = p.scratch = state;
  p.committed = state.positions;
  p.forces.assign(state.positions.size(), Vec3::Zero());
}

SolverStatic::~SolverStatic() = default;
SolverStatic::SolverStatic(SolverStatic&&) noexcept = default;
SolverStatic& SolverStatic::operator=(SolverStatic&&) noexcept = default;

std::size_t SolverStatic::add_clamp(std::span<const int> slots, const Vec3& pivot) {
  Parts& p = *parts_;
  Clamp clamp;
  clamp.pivot = pivot;
  for (int slot : slots) {
    if (p.model.fixed[at(slot)] == 0) {
      throw Error(ErrorKind::kUsage, "a clamp holds slots that the model fixes, and no others");
    }
    clamp.slots.push_back(at(slot));
    clamp.arms.emplace_back(p.state.positions[at(slot)] - pivot);
  }
  p.clamps.push_back(std::move(clamp));
  p.committed_clamps = p.clamps;
  return p.clamps.size() - 1;
}

void SolverStatic::set_freedom(std::size_t clamp, const Vec3& direction, double force) {
  Parts& p = *parts_;
  for (Clamp::Freedom& freedom : p.clamps[clamp].freedoms) {
    if (freedom.direction == direction) {
      freedom.force = force;
      return;
    }
  }
  p.clamps[clamp].freedoms.push_back({direction, force, 0.0, -1});
  p.committed_clamps = p.clamps;
  p.mapped = false;
}

void SolverStatic::place(std::size_t clamp, const Mat3& rotation, const Vec3& shift) {
  parts_->clamps[clamp].rotation = rotation;
  parts_->clamps[clamp].shift = shift;
}

void SolverStatic::suggest(std::span<const Vec3> positions) {
  Parts& p = *parts_;
  for (std::size_t slot = 0; slot < positions.size(); ++slot) {
    if (p.model.fixed[slot] == 0) p.state.positions[slot] = positions[slot];
  }
  p.suggested = true;
}

void SolverStatic::suggest_shift(std::size_t clamp, const Vec3& change) {
  for (Clamp::Freedom& freedom : parts_->clamps[clamp].freedoms) freedom.way += change.dot(freedom.direction);
}

StaticReport SolverStatic::settle() {
  Parts& p = *parts_;
  p.map_unknowns();
  const std::vector<Vec3> before = p.state.positions;
  p.place_clamps();
  if (!std::exchange(p.suggested, false)) p.predict(before);
  StaticReport report;
  Vector force, next, step;
  p.evaluate();
  report.residual = p.residual(force);
  const auto limit = [&] { return std::max(p.options.least_force, p.options.tolerance * p.scale); };
  while (report.residual > limit() && report.iterations < p.options.most_iterations) {
    ++report.iterations;
    if (!p.solve(force, step)) break;
    double share = std::min(1.0, kLargestMove * p.model.spacing / step.cwiseAbs().maxCoeff());
    // At a corner of a law the force may not fall along the step: then the shortest one goes past it.
    double last = 0.0;
    for (int halving = 0; halving <= kHalvings; ++halving, share *= 0.5) {
      p.move(step, share - last);
      last = share;
      p.evaluate();
      const double now = p.residual(next);
      if (std::isfinite(now) && (now < report.residual || halving == kHalvings)) {
        report.residual = now;
        force = next;
        break;
      }
    }
  }
  p.iterations += report.iterations;
  report.converged = report.residual <= limit();
  return report;
}

void SolverStatic::commit() {
  Parts& p = *parts_;
  commit_cloth(p.model, p.material, p.state.positions, p.state);
  p.committed = p.state.positions;
  p.committed_clamps = p.clamps;
}

void SolverStatic::roll_back() {
  Parts& p = *parts_;
  p.state.positions = p.committed;
  p.clamps = p.committed_clamps;
}

ClampReading SolverStatic::read(std::size_t clamp) const {
  const Parts& p = *parts_;
  const Clamp& c = p.clamps[clamp];
  ClampReading reading;
  reading.shift = c.whole_shift();
  const Vec3 centre = c.pivot + reading.shift;
  for (std::size_t slot : c.slots) {
    reading.force += p.forces[slot];
    reading.moment += (p.state.positions[slot] - centre).cross(p.forces[slot]);
  }
  return reading;
}

std::span<const Vec3> SolverStatic::forces() const noexcept { return parts_->forces; }
const ClothState& SolverStatic::state() const noexcept { return parts_->state; }
const ClothModel& SolverStatic::model() const noexcept { return parts_->model; }
int SolverStatic::iterations() const noexcept { return parts_->iterations; }

}  // namespace fuai
