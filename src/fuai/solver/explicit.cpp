// Steps the cloth explicitly with the reference forces.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/explicit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fuai/core/assertion.h"
#include "fuai/core/error.h"
#include "fuai/solver/cloth_energy.h"
#include "fuai/solver/cloth_measures.h"

namespace fuai {
namespace {

std::size_t at(int slot) noexcept { return static_cast<std::size_t>(slot); }

/// -(A/h) eta d eps/dt along each edge of one direction, the rate from the velocities.
void add_viscosity(const ClothModel& model, const ClothState& state, const std::vector<double>& areas,
                   std::size_t stride, double eta, std::span<Vec3> forces) noexcept {
  const double h = model.spacing;
  for (std::size_t slot = 0; slot < areas.size(); ++slot) {
    if (!(areas[slot] > 0.0)) continue;
    const std::size_t next = slot + stride;
    const EdgeMeasure edge = measure_edge(state.positions[slot], state.positions[next], h);
    const double rate = edge.direction.dot(state.velocities[next] - state.velocities[slot]) / h;
    const Vec3 force = -(areas[slot] / h) * eta * rate * edge.direction;
    forces[next] += force;
    forces[slot] -= force;
  }
}

/// What the elements about a slot add to its row of stiffness [N/m] and of damping [N s/m].
struct RowSums {
  std::vector<double> stiffness, damping;
};

/// An edge: strain gradient 1/h at both ends.
void add_edge_rows(const ClothModel& model, const std::vector<double>& areas, std::size_t stride,
                   const PlayLaw& law, double viscosity_time, RowSums& rows) {
  const double eta = tension_viscosity(law, viscosity_time), h2 = model.spacing * model.spacing;
  for (std::size_t slot = 0; slot < areas.size(); ++slot) {
    if (!(areas[slot] > 0.0)) continue;
    for (std::size_t end : {slot, slot + stride}) {
      rows.stiffness[end] += 2.0 * areas[slot] / h2 * law.max_stick_tangent();
      rows.damping[end] += 2.0 * areas[slot] / h2 * eta;
    }
  }
}

/// A cell: shear gradient 1/(sqrt(2) h) at each of four corners; twist 4 A Bt / h^4 times the signs.
void add_cell_rows(const ClothModel& model, const ClothMaterial& material, RowSums& rows) {
  const double h2 = model.spacing * model.spacing;
  const auto up = static_cast<std::size_t>(model.columns);
  for (std::size_t slot = 0; slot < model.cell_area.size(); ++slot) {
    const double area = model.cell_area[slot];
    if (!(area > 0.0)) continue;
    const double row = 2.0 * area / h2 * material.shear.max_stick_tangent() +
                       16.0 * model.twist_area[slot] * material.twist_stiffness / (h2 * h2);
    for (std::size_t corner : {slot, slot + 1, slot + up, slot + up + 1}) rows.stiffness[corner] += row;
  }
}

/// A triple: curvature gradient 1, -2, 1 over (l h). |B12| couples two of them: at most as much as one of
/// each.
void add_bend_rows(const ClothModel& model, const std::vector<double>& areas,
                   const std::vector<double>& lengths, std::size_t stride, double tangent, RowSums& rows) {
  for (std::size_t slot = 0; slot < areas.size(); ++slot) {
    if (!(areas[slot] > 0.0)) continue;
    const double gradient = 1.0 / (lengths[slot] * model.spacing);
    const double row = 4.0 * areas[slot] * tangent * gradient * gradient;
    rows.stiffness[slot] += 2.0 * row;
    rows.stiffness[slot - stride] += row;
    rows.stiffness[slot + stride] += row;
  }
}

bool is_finite(const ClothState& state) noexcept {
  const auto finite = [](const Vec3& v) { return v.allFinite(); };
  return std::ranges::all_of(state.positions, finite) && std::ranges::all_of(state.velocities, finite);
}

}  // namespace

double stable_substep(const ClothModel& model, const ClothMaterial& material) {
  const auto up = static_cast<std::size_t>(model.columns), slots = at(model.slot_count());
  RowSums rows{std::vector<double>(slots, 0.0), std::vector<double>(slots, 0.0)};
  const double tau = material.viscosity_time, coupling = std::abs(material.poisson_bending);
  add_edge_rows(model, model.weft_edge_area, 1, material.weft_tension, tau, rows);
  add_edge_rows(model, model.warp_edge_area, up, material.warp_tension, tau, rows);
  add_cell_rows(model, material, rows);
  add_bend_rows(model, model.weft_bend_area, model.weft_bend_length, 1,
                material.weft_bending.max_stick_tangent() + coupling, rows);
  add_bend_rows(model, model.warp_bend_area, model.warp_bend_length, up,
                material.warp_bending.max_stick_tangent() + coupling, rows);
  double w2 = 0.0, d = 0.0;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    const double mass = model.areal_mass * model.node_area[slot];
    if (model.live[slot] == 0 || model.fixed[slot] != 0) continue;
    w2 = std::max(w2, rows.stiffness[slot] / mass);
    d = std::max(d, rows.damping[slot] / mass + material.mass_drag);
  }
  // Of v' = v - ds (w2 x + d v), x' = x + ds v': stable while w2 ds^2 + 2 d ds < 4.
  const double below = d + std::sqrt(d * d + 4.0 * w2);
  return below > 0.0 ? 4.0 / below : std::numeric_limits<double>::infinity();
}

Vec3 air_force(const ClothMaterial& material, double area, const Vec3& normal,
               const Vec3& velocity) noexcept {
  const Vec3 across = normal.dot(velocity) * normal, along = velocity - across;
  const double pressure = 0.5 * material.air_density * area;
  return -pressure *
         (material.air_normal * across.norm() * across + material.air_tangential * along.norm() * along);
}

void SolverExplicit::prepare(const ClothModel& model, const ClothMaterial& material,
                             const ExplicitOptions& options, const AttachmentRoom& room) {
  if (options.substeps < 1) throw Error(ErrorKind::kUsage, "an explicit step needs at least one substep");
  fixed_slots_.clear();
  free_slots_.clear();
  for (int slot = 0; slot < model.slot_count(); ++slot) {
    if (model.live[at(slot)] == 0) continue;
    (model.fixed[at(slot)] != 0 ? fixed_slots_ : free_slots_).push_back(slot);
    if (model.fixed[at(slot)] == 0 && !(model.areal_mass * model.node_area[at(slot)] > 0.0)) {
      throw Error(ErrorKind::kBadInput, "slot " + std::to_string(slot) + " is free and carries no cloth");
    }
  }
  model_ = &model;
  material_ = &material;
  options_ = options;
  const std::size_t slots = at(model.slot_count());
  forces_.assign(slots, Vec3::Zero());
  pulls_.assign(slots, Vec3::Zero());
  springs_.assign(room.attachments, {});
  groups_.assign(room.groups, {});
  hold_forces_.assign(room.groups, {});
  spring_count_ = group_count_ = 0;
  before_ = make_cloth_state(model);  // room for any state of this cloth
  stable_substep_ = fuai::stable_substep(model, material);
  failed_steps_ = 0;
}

std::uint32_t SolverExplicit::step(ClothState& state, double dt,
                                   std::span<const Vec3> fixed_positions) noexcept {
  FUAI_ASSERT(model_ != nullptr && dt > 0.0 && state.positions.size() == forces_.size());
  FUAI_ASSERT(fixed_positions.empty() || fixed_positions.size() == fixed_slots_.size());
  before_ = state;  // as large as before: no allocation
  for (std::size_t i = 0; i < fixed_slots_.size(); ++i) {
    const std::size_t slot = at(fixed_slots_[i]);
    state.velocities[slot] =
        fixed_positions.empty() ? Vec3::Zero() : Vec3((fixed_positions[i] - before_.positions[slot]) / dt);
  }
  for (std::size_t i = 0; i < spring_count_; ++i)
    if (springs_[i].fresh) springs_[i].from = state.positions[at(springs_[i].end.slot)];
  const double ds = dt / options_.substeps;
  const auto part = [&](int substep) { return static_cast<double>(substep) / options_.substeps; };
  for (int i = 1; i <= options_.substeps; ++i) {
    take_forces(state);
    take_holds(state, part(i - 1));
    move_free(state, ds);
    move_fixed(state, fixed_positions, part(i));
  }
  take_forces(state);
  take_holds(state, 1.0);
  const bool finite = is_finite(state);
  for (std::size_t i = 0; i < spring_count_; ++i) {
    springs_[i].from = springs_[i].end.target;
    springs_[i].fresh = !finite;
  }
  if (!finite) {
    state = before_;
    std::fill(forces_.begin(), forces_.end(), Vec3::Zero());
    std::fill(hold_forces_.begin(), hold_forces_.end(), HoldForce{});
    ++failed_steps_;
    return kExplicitNotFinite;
  }
  state.time += dt;
  return ds > stable_substep_ ? kExplicitUnstableSubstep : 0U;
}

void SolverExplicit::take_forces(ClothState& state) noexcept {
  const ClothModel& m = *model_;
  advance_cloth(m, *material_, state, forces_);
  const double tau = material_->viscosity_time;
  add_viscosity(m, state, m.weft_edge_area, 1, tension_viscosity(material_->weft_tension, tau), forces_);
  add_viscosity(m, state, m.warp_edge_area, at(m.columns), tension_viscosity(material_->warp_tension, tau),
                forces_);
}

void SolverExplicit::move_free(ClothState& state, double ds) const noexcept {
  const bool in_air = material_->air_density > 0.0;
  // All velocities first: the air reads the normals, hence the neighbours' positions.
  for (int free : free_slots_) {
    const std::size_t slot = at(free);
    const double area = model_->node_area[slot];
    Vec3 force = forces_[slot] + pulls_[slot];
    Vec3& v = state.velocities[slot];
    if (in_air) {
      const Vec3 normal = measure_bend(*model_, state.positions, slot).normal;
      force += air_force(*material_, area, normal, v - options_.wind);
    }
    v += ds * (force / (model_->areal_mass * area) + options_.gravity - material_->mass_drag * v);
  }
  for (int free : free_slots_) state.positions[at(free)] += ds * state.velocities[at(free)];
}

void SolverExplicit::move_fixed(ClothState& state, std::span<const Vec3> targets,
                                double fraction) const noexcept {
  if (targets.empty()) return;
  for (std::size_t i = 0; i < fixed_slots_.size(); ++i) {
    const Vec3& start = before_.positions[at(fixed_slots_[i])];
    // (1 - f) a + f b ends on b exactly.
    state.positions[at(fixed_slots_[i])] = (1.0 - fraction) * start + fraction * targets[i];
  }
}

void SolverExplicit::attach(std::span<const Attachment> attachments,
                            std::span<const AttachmentGroup> groups) noexcept {
  for (std::size_t i = 0; i < spring_count_; ++i) pulls_[at(springs_[i].end.slot)].setZero();
  std::size_t used = 0, taken = 0;
  for (const AttachmentGroup& group : groups) {
    if (taken == groups_.size() || used + group.count > std::min(springs_.size(), attachments.size())) break;
    for (std::size_t end = used + group.count; used < end; ++used) {
      Spring& spring = springs_[used];
      // The same slot in the same place of the list: the hold of the last step, carried on.
      const bool carried = used < spring_count_ && spring.end.slot == attachments[used].slot;
      spring.fresh = !carried || spring.fresh;
      spring.end = attachments[used];
    }
    hold_forces_[taken] = {};
    groups_[taken++] = group;
  }
  spring_count_ = used;
  group_count_ = taken;
}

std::vector<double> SolverExplicit::holds() const {
  std::vector<double> carried;
  for (std::size_t i = 0; i < spring_count_ && !springs_[i].fresh; ++i) {
    const Vec3& from = springs_[i].from;
    carried.insert(carried.end(), {static_cast<double>(springs_[i].end.slot), from.x(), from.y(), from.z()});
  }
  return carried;
}

void SolverExplicit::restore_holds(std::span<const double> carried) noexcept {
  attach({}, {});
  if (carried.size() % 4 != 0 || carried.size() / 4 > springs_.size()) return;
  for (std::size_t i = 0; i < carried.size(); i += 4) {
    const double slot = carried[i];
    if (!(slot >= 0.0 && slot < model_->slot_count())) break;
    Attachment end;  // without stiffness until attach() finds the slot again
    end.slot = static_cast<int>(slot);
    springs_[spring_count_++] = {end, Vec3(carried[i + 1], carried[i + 2], carried[i + 3]), false};
  }
}

// f_i = s k_i (target - x_i), s = min(1, most / |sum k_i (target - x_i)|): docs/theory/grasp.md, written a
// second time as everything here.
void SolverExplicit::take_holds(const ClothState& state, double fraction) noexcept {
  for (std::size_t i = 0; i < spring_count_; ++i) pulls_[at(springs_[i].end.slot)].setZero();
  std::size_t first = 0;
  for (std::size_t g = 0; g < group_count_; first += groups_[g].count, ++g) {
    const std::span<const Spring> springs(springs_.data() + first, groups_[g].count);
    const auto pull = [&](const Spring& s) -> Vec3 {
      const Vec3 target = (1.0 - fraction) * s.from + fraction * s.end.target;
      return s.end.stiffness * (target - state.positions[at(s.end.slot)]);
    };
    Vec3 sum = Vec3::Zero();
    for (const Spring& s : springs) sum += pull(s);
    HoldForce hold;
    hold.share = sum.norm() > groups_[g].most_force ? groups_[g].most_force / sum.norm() : 1.0;
    for (const Spring& s : springs) {
      const Vec3 force = hold.share * pull(s);
      pulls_[at(s.end.slot)] += force;
      hold.force += force;
      hold.moment += (state.positions[at(s.end.slot)] - groups_[g].origin).cross(force);
    }
    hold_forces_[g] = hold;
  }
}

int SolverExplicit::safe_substeps(double dt, double margin) const noexcept {
  double w2 = 0.0;  // of the stiffest spring on its slot
  for (std::size_t i = 0; i < spring_count_; ++i) {
    const Attachment& a = springs_[i].end;
    w2 = std::max(w2, a.stiffness / (model_->areal_mass * model_->node_area[at(a.slot)]));
  }
  // A spring adds its w2 to the row of its slot; the slope of 1 / ds^2 over w2 is at most 1/2.
  const double inverse = std::sqrt(1.0 / (stable_substep_ * stable_substep_) + 0.5 * w2);
  const double count = std::ceil(dt / margin * inverse);
  return static_cast<int>(std::clamp(count, 1.0, 1e9));
}

Vec3 SolverExplicit::reaction() const noexcept {
  Vec3 sum = Vec3::Zero();
  for (int slot : fixed_slots_) sum += forces_[at(slot)];
  return sum;
}

}  // namespace fuai
