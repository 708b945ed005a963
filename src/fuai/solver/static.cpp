// Clamps, commits and readings; the work is done in static_system.h.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/static.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/solver/cloth_energy.h"
#include "fuai/solver/static_system.h"

namespace fuai {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

SolverStatic::SolverStatic(const ClothModel& model, const ClothMaterial& material, const ClothState& state,
                           const StaticOptions& options)
    : parts_(std::make_unique<StaticSystem>()) {
  if (!(options.tolerance > 0.0) || !(options.least_force > 0.0) || options.most_iterations < 1) {
    throw Error(ErrorKind::kUsage, "a static solve needs a positive tolerance and at least one iteration");
  }
  StaticSystem& p = *parts_;
  p.model = model, p.material = material, p.options = options;
  p.state = p.scratch = state;
  p.committed = state.positions;
  p.forces.assign(state.positions.size(), Vec3::Zero());
}

SolverStatic::~SolverStatic() = default;
SolverStatic::SolverStatic(SolverStatic&&) noexcept = default;
SolverStatic& SolverStatic::operator=(SolverStatic&&) noexcept = default;

std::size_t SolverStatic::add_clamp(std::span<const int> slots, const Vec3& pivot) {
  StaticSystem& p = *parts_;
  StaticClamp clamp;
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
  StaticSystem& p = *parts_;
  for (StaticClamp::Freedom& freedom : p.clamps[clamp].freedoms) {
    if (freedom.direction == direction) {
      freedom.force = force;
      return;
    }
  }
  p.clamps[clamp].freedoms.push_back({direction, force, 0.0, -1});
  p.committed_clamps = p.clamps;
  p.mapped = false;
}

void SolverStatic::hold(std::size_t clamp) {
  StaticSystem& p = *parts_;
  p.clamps[clamp].shift = p.clamps[clamp].whole_shift();
  p.clamps[clamp].freedoms.clear();
  p.committed_clamps = p.clamps;
  p.mapped = false;
}

void SolverStatic::set_gravity(const Vec3& gravity) noexcept { parts_->options.gravity = gravity; }

void SolverStatic::place(std::size_t clamp, const Mat3& rotation, const Vec3& shift) {
  parts_->clamps[clamp].rotation = rotation;
  parts_->clamps[clamp].shift = shift;
}

void SolverStatic::suggest(std::span<const Vec3> positions) {
  StaticSystem& p = *parts_;
  for (std::size_t slot = 0; slot < positions.size(); ++slot) {
    if (p.model.fixed[slot] == 0) p.state.positions[slot] = positions[slot];
  }
  p.suggested = true;
}

void SolverStatic::suggest_shift(std::size_t clamp, const Vec3& change) {
  for (StaticClamp::Freedom& freedom : parts_->clamps[clamp].freedoms)
    freedom.way += change.dot(freedom.direction);
}

StaticReport SolverStatic::settle() {
  StaticSystem& p = *parts_;
  p.map_unknowns();
  const std::vector<Vec3> before = p.state.positions;
  p.place_clamps();
  if (!std::exchange(p.suggested, false)) p.predict(before);
  StaticReport report;
  report.residual = p.find_rest(report.iterations);
  p.iterations += report.iterations;
  report.converged = report.residual <= p.limit();
  return report;
}

void SolverStatic::commit() {
  StaticSystem& p = *parts_;
  commit_cloth(p.model, p.material, p.state.positions, p.state);
  p.committed = p.state.positions;
  p.committed_clamps = p.clamps;
}

void SolverStatic::roll_back() {
  StaticSystem& p = *parts_;
  p.state.positions = p.committed;
  p.clamps = p.committed_clamps;
}

ClampReading SolverStatic::read(std::size_t clamp) const {
  const StaticSystem& p = *parts_;
  const StaticClamp& c = p.clamps[clamp];
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
