// The implicit step.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/implicit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Guard B lets the slope along the step come out at this part of what it was, and tries this often.
constexpr double kOvershoot = 0.25;
constexpr int kMostShortenings = 4;
/// Line searches take a slope for real beyond this many times what force_noise() makes of it; tuned on the
/// bending scene in float, where without it the force lags by 1.8 %, with 4 by 0.3 %; with 16 crumpled cloth
/// takes minutes to come to rest at two iterations.
constexpr double kNoiseMargin = 4.0;

template <class T>
T part(const Vec3& v, int i) {
  return static_cast<T>(v[i]);
}

template <class T>
Vec3 vector_at(const Field3<T>& field, std::ptrdiff_t p) {
  return {static_cast<double>(field.x[p]), static_cast<double>(field.y[p]), static_cast<double>(field.z[p])};
}

template <class T>
void put(const Field3<T>& field, std::ptrdiff_t p, const Vec3& value) {
  field.x[p] = part<T>(value, 0);
  field.y[p] = part<T>(value, 1);
  field.z[p] = part<T>(value, 2);
}

void check_options(const ImplicitOptions& o) {
  if (o.iterations < 1 || o.linearisations < 1 || !(o.relinearise > 0.0) || !(o.tolerance >= 0.0) ||
      !(o.noise_floor >= 0.0)) {
    throw Error(ErrorKind::kUsage,
                "the implicit solver needs at least one iteration and one linearisation, a positive "
                "relinearise and a tolerance that is not negative");
  }
  if (!o.gravity.allFinite() || !o.wind.allFinite())
    throw Error(ErrorKind::kUsage, "gravity and wind must be finite");
}

}  // namespace

template <class T>
SolverImplicit<T>::SolverImplicit(const ClothModel& model, const ClothMaterial& material,
                                  const ImplicitOptions& options, const AttachmentRoom& room)
    : kernels_(&implicit_kernels<T>()),
      storage_(std::make_unique<ImplicitStorage<T>>(model, material)),
      grid_(storage_->grid()),
      constants_(storage_->constants()),
      options_(options),
      attachments_(room.attachments),
      groups_(room.groups),
      holds_(room.groups),
      columns_(model.columns) {
  check_options(options);
  const auto toe = [](const PlayLaw& law) {
    return law.elastic().node_count() > 1 ? law.stick_tangent(0.0) : 0.0;
  };
  stiffest_ = std::max(toe(material.weft_tension), toe(material.warp_tension));
  size_ = model.spacing * std::hypot(model.columns, model.rows);
  for (std::size_t i = 0; i < model.live.size(); ++i)
    mobile_count_ += model.live[i] != 0 && model.fixed[i] == 0;
  set_team(nullptr);
  restore(make_cloth_state(model));
}

template <class T>
void SolverImplicit<T>::set_team(Team* team) {
  team_ = team != nullptr && team->size() > 1 ? team : nullptr;
  const auto members = static_cast<std::size_t>(team_ != nullptr ? team_->size() : 1);
  scratch_.assign(members * static_cast<std::size_t>(kernels_->scratch_size(grid_)), T(0));
}

// Always in the order of the rows, whoever did them.
template <class T>
double SolverImplicit<T>::sum_rows() const noexcept {
  double sum = 0.0;
  for (int row = 0; row < grid_.rows; ++row) sum += grid_.partial[row];
  return sum;
}

template <class T>
template <class Kernel, class... Arguments>
double SolverImplicit<T>::rows(Kernel kernel, const Arguments&... arguments) noexcept {
  const int members = team_ != nullptr ? team_->size() : 1;
  run_together(team_, [&](int member) {
    const Share share = share_of(grid_.rows, member, members);
    kernel(grid_, arguments..., share.begin, share.end);
  });
  return sum_rows();
}

// Rows in whole vectors.
template <class T>
template <class Kernel, class... Arguments>
double SolverImplicit<T>::vectors(Kernel kernel, const Arguments&... arguments) noexcept {
  const int members = team_ != nullptr ? team_->size() : 1;
  const int count = (grid_.rows + kernels_->lanes - 1) / kernels_->lanes;
  run_together(team_, [&](int member) {
    const Share share = share_of(count, member, members);
    kernel(grid_, arguments..., share.begin, share.end);
  });
  return sum_rows();
}

// Both directions at the same time: the even members take the warp, the odd ones the weft; alone, both.
template <class T>
template <class Kernel>
void SolverImplicit<T>::lines(Kernel warp, Kernel weft) noexcept {
  const int members = team_ != nullptr ? team_->size() : 1;
  const int warp_count = (grid_.columns + kernels_->lanes - 1) / kernels_->lanes;
  const int weft_count = (grid_.rows + kernels_->lanes - 1) / kernels_->lanes;
  run_together(team_, [&](int member) {
    if (members == 1) {
      warp(grid_, 0, warp_count);
      weft(grid_, 0, weft_count);
      return;
    }
    const bool odd = member % 2 != 0;
    const Share share =
        share_of(odd ? weft_count : warp_count, member / 2, odd ? members / 2 : (members + 1) / 2);
    (odd ? weft : warp)(grid_, share.begin, share.end);
  });
}

// Rows, with a set of scratch for each member.
template <class T>
template <class Work>
void SolverImplicit<T>::with_scratch(const Work& work) noexcept {
  const int members = team_ != nullptr ? team_->size() : 1;
  const std::size_t size = scratch_.size() / static_cast<std::size_t>(members);
  run_together(team_, [&](int member) {
    const Share share = share_of(grid_.rows, member, members);
    work(scratch_.data() + size * static_cast<std::size_t>(member), share.begin, share.end);
  });
}

template <class T>
void SolverImplicit<T>::begin_step(double dt) noexcept {
  const double drag = static_cast<double>(constants_.mass_drag);
  step_.dt = static_cast<T>(dt);
  step_.inverse_dt = static_cast<T>(1.0 / dt);
  step_.inertia = static_cast<T>((1.0 + drag * dt) / (dt * dt));
  step_.velocity_gain = static_cast<T>(dt / (1.0 + drag * dt));
  for (int i = 0; i < 3; ++i) {
    step_.gravity_dt[i] = static_cast<T>(dt * load_ * options_.gravity[i]);
    step_.wind_dt[i] = static_cast<T>(dt * options_.wind[i]);
  }
}

// The springs of a group weaken together when their sum would exceed what the hold can bear.
template <class T>
void SolverImplicit<T>::add_attachments(bool linearise) noexcept {
  std::size_t first = 0;
  for (std::size_t g = 0; g < group_count_; first += groups_[g].count, ++g) {
    const AttachmentGroup& group = groups_[g];
    const std::span<const Attachment> springs(attachments_.data() + first, group.count);
    HoldForce hold;
    for (const Attachment& a : springs) {
      const Vec3 x = position(a.slot), force = a.stiffness * (a.target - x);
      hold.force += force;
      hold.moment += (x - group.origin).cross(force);
    }
    const double size = hold.force.norm();
    hold.share = size > group.most_force ? group.most_force / size : 1.0;
    hold.force *= hold.share;
    hold.moment *= hold.share;
    holds_[g] = hold;
    for (const Attachment& a : springs) {
      const std::ptrdiff_t p = at(a.slot);
      const double k = hold.share * a.stiffness * static_cast<double>(grid_.mobile[p]);
      const Vec3 force = k * (a.target - position(a.slot));
      grid_.force.x[p] += part<T>(force, 0);
      grid_.force.y[p] += part<T>(force, 1);
      grid_.force.z[p] += part<T>(force, 2);
      if (linearise) grid_.ground[p] += static_cast<T>(k);
    }
  }
}

template <class T>
void SolverImplicit<T>::evaluate(Evaluation what) noexcept {
  with_scratch([&](T* scratch, int begin, int end) {
    kernels_->evaluate(grid_, constants_, step_, what, scratch, begin, end);
  });
  add_attachments(what == Evaluation::kLinearise);
}

/// Power of the attachments on the cloth as it moves now, at full stiffness.
template <class T>
double SolverImplicit<T>::attachment_power() const noexcept {
  double power = 0.0;
  std::size_t first = 0;
  for (std::size_t g = 0; g < group_count_; first += groups_[g].count, ++g) {
    for (std::size_t i = first; i < first + groups_[g].count; ++i) {
      const Attachment& a = attachments_[i];
      power += holds_[g].share * a.stiffness * (a.target - position(a.slot)).dot(velocity(a.slot));
    }
  }
  return power;
}

/// How fast the potential of the coming step falls along v at xn [W], from the sums of the last step.
template <class T>
double SolverImplicit<T>::fall_at_start(double dt) const noexcept {
  return fall_.cloth + attachment_power() + fall_.kinetic / dt + fall_.weight_power;
}

template <class T>
void SolverImplicit<T>::finish_step(double dt) noexcept {
  fall_.cloth = rows(kernels_->finish, constants_, step_);
  fall_.kinetic = fall_.weight_power = 0.0;
  for (int row = 0; row < grid_.rows; ++row) {
    fall_.kinetic += grid_.partial_kinetic[row];
    fall_.weight_power += grid_.partial_weight[row] / dt;
  }
  fall_.cloth -= attachment_power();
  fall_.known = true;
}

// Positions are rounded, and a yarn edge turns half a last digit into this force [N]: what no step can get
// below and no line search should listen to.
template <class T>
double SolverImplicit<T>::force_noise() const noexcept {
  const double reach = position(0).cwiseAbs().maxCoeff() + size_;
  return 0.5 * static_cast<double>(std::numeric_limits<T>::epsilon()) * reach * stiffest_;
}

// Guard A: the first guess xn + dt v may hold more energy than xn (slopes at both ends, trapezoid rule); then
// go back along v to where the potential stops falling, by one secant step.
template <class T>
void SolverImplicit<T>::start(double dt, StepReport& report) noexcept {
  rows(kernels_->replace, step_.dt);
  evaluate(Evaluation::kLinearise);
  ++report.evaluations;
  if (!options_.guards) return;
  const double at_end = rows(kernels_->work_v);
  if (at_end >= 0.0) return;
  double at_start = fall_at_start(dt);
  if (!fall_.known) {
    rows(kernels_->replace, T(0));
    evaluate(Evaluation::kForce);
    ++report.evaluations;
    at_start = rows(kernels_->work_v);
  }
  const double node_mass = static_cast<double>(constants_.areal_mass * constants_.h * constants_.h);
  const double noise = node_mass > 0.0 ? force_noise() * std::sqrt(fall_.kinetic / node_mass) : 0.0;
  if (fall_.known && -at_end <= at_start + kNoiseMargin * noise) return;
  const double part_way = at_start > 0.0 ? std::clamp(at_start / (at_start - at_end), 0.0, 1.0) : 0.0;
  rows(kernels_->replace, static_cast<T>(part_way) * step_.dt);
  evaluate(Evaluation::kLinearise);
  ++report.evaluations;
  report.status |= StepReport::kStartedBack;
}

// Conjugate gradients from zero on A d = force. Returns force.d, the slope of the potential along d at d = 0.
template <class T>
double SolverImplicit<T>::solve(StepReport& report) noexcept {
  const bool links = options_.preconditioner == Preconditioner::kYarnLines;
  vectors(kernels_->assemble, constants_, links);
  lines(kernels_->factor_warp, kernels_->factor_weft);
  const double first = rows(kernels_->begin_solve);
  const double least = std::max(options_.tolerance * options_.tolerance * 0.01,
                                first * options_.reduction * options_.reduction);
  double slope = 0.0, previous = 0.0, square = first;
  for (int i = 0; i < options_.iterations && square > least; ++i) {
    lines(kernels_->solve_warp, kernels_->solve_weft);
    const double rz = vectors(kernels_->average);
    if (!(rz > 0.0)) break;
    rows(kernels_->direct, static_cast<T>(i == 0 ? 0.0 : rz / previous));
    with_scratch(
        [&](T* scratch, int begin, int end) { kernels_->multiply(grid_, constants_, scratch, begin, end); });
    const double curvature = sum_rows();
    if (!(curvature > 0.0)) break;
    const double alpha = rz / curvature;
    square = rows(kernels_->advance, static_cast<T>(alpha));
    slope += alpha * rz;
    previous = rz;
    ++report.iterations;
  }
  return slope;
}

// Guard B: if the potential rises again along d by more than it should, back to where it stops falling.
template <class T>
void SolverImplicit<T>::search_back(double slope, StepReport& report) noexcept {
  double at = 1.0, near = 0.0, near_fall = slope;
  for (int i = 0; i < kMostShortenings; ++i) {
    const double fall = rows(kernels_->work_d);
    if (fall >= -kOvershoot * slope) return;
    const double noise = force_noise() * std::sqrt(rows(kernels_->length_d));
    if (fall >= -kOvershoot * slope - kNoiseMargin * noise) return;
    const double next = near + (at - near) * near_fall / (near_fall - fall);
    rows(kernels_->move, static_cast<T>(next - at));
    at = next;
    evaluate(Evaluation::kForce);
    ++report.evaluations;
    report.status |= StepReport::kShortened;
  }
}

template <class T>
void SolverImplicit<T>::give_up() noexcept {
  fall_.known = false;
  rows(kernels_->replace, T(0));
  // Fixed nodes too: their targets may be what was wrong.
  const ImplicitGrid<T>& g = grid_;
  for (int row = 0; row < g.rows; ++row) {
    const std::ptrdiff_t p = g.at(row);
    std::copy(g.xn.x + p, g.xn.x + p + g.stride, g.x.x + p);
    std::copy(g.xn.y + p, g.xn.y + p + g.stride, g.x.y + p);
    std::copy(g.xn.z + p, g.xn.z + p + g.stride, g.x.z + p);
    std::fill(g.v.x + p, g.v.x + p + g.stride, T(0));
    std::fill(g.v.y + p, g.v.y + p + g.stride, T(0));
    std::fill(g.v.z + p, g.v.z + p + g.stride, T(0));
    std::fill(g.force.x + p, g.force.x + p + g.stride, T(0));
    std::fill(g.force.y + p, g.force.y + p + g.stride, T(0));
    std::fill(g.force.z + p, g.force.z + p + g.stride, T(0));
  }
}

template <class T>
StepReport SolverImplicit<T>::step(double dt) noexcept {
  StepReport report;
  begin_step(dt);
  start(dt, report);
  const double before = rows(kernels_->square);
  const double least =
      std::max(options_.tolerance, options_.noise_floor * force_noise() * std::sqrt(mobile_count_));
  for (report.linearisations = 1;; ++report.linearisations) {
    const double slope = solve(report);
    rows(kernels_->move, T(1));
    evaluate(Evaluation::kForce);
    ++report.evaluations;
    if (options_.guards) search_back(slope, report);
    const double after = rows(kernels_->square);
    report.residual = std::sqrt(after);
    const double limit = options_.relinearise * options_.relinearise * before;
    if (!(after > limit) || report.residual <= least) break;
    if (report.linearisations >= options_.linearisations) break;
    evaluate(Evaluation::kLinearise);
    ++report.evaluations;
  }
  if (!std::isfinite(report.residual)) {
    give_up();
    report.status |= StepReport::kNotFinite;
    rows(kernels_->keep);
  } else {
    rows(kernels_->commit, constants_);
    finish_step(dt);
  }
  time_ += dt;
  return report;
}

template <class T>
StepReport SolverImplicit<T>::descend(double dt, double largest_move) noexcept {
  StepReport report;
  begin_step(dt);
  rows(kernels_->keep);
  rows(kernels_->stop);
  evaluate(Evaluation::kLinearise);
  report.residual = std::sqrt(rows(kernels_->square));
  double slope = solve(report);
  const double longest = std::sqrt(longest_square());
  if (longest > largest_move) {
    const double share = largest_move / longest;
    rows(kernels_->scale_d, static_cast<T>(share));
    slope *= share;
    report.status |= StepReport::kShortened;
  }
  rows(kernels_->move, T(1));
  evaluate(Evaluation::kForce);
  report.evaluations = 2;
  report.linearisations = 1;
  if (options_.guards) search_back(slope, report);
  if (!std::isfinite(report.residual) || !std::isfinite(rows(kernels_->square))) {
    give_up();
    report.status |= StepReport::kNotFinite;
  }
  return report;
}

template <class T>
double SolverImplicit<T>::longest_square() const noexcept {
  double longest = 0.0;
  for (int row = 0; row < grid_.rows; ++row) {
    for (std::ptrdiff_t p = grid_.at(row), end = p + grid_.columns; p < end; ++p)
      longest = std::max(longest, vector_at(grid_.d, p).squaredNorm());
  }
  return longest;
}

template <class T>
void SolverImplicit<T>::commit() noexcept {
  begin_step(1.0);
  rows(kernels_->keep);
  rows(kernels_->stop);
  evaluate(Evaluation::kForce);
  rows(kernels_->commit, constants_);
}

template <class T>
double SolverImplicit<T>::out_of_balance() noexcept {
  begin_step(1.0);
  rows(kernels_->keep);
  rows(kernels_->stop);
  evaluate(Evaluation::kForce);
  return std::sqrt(rows(kernels_->square));
}

template <class T>
double SolverImplicit<T>::mobile_weight() const noexcept {
  double area = 0.0;
  for (int row = 0; row < grid_.rows; ++row) {
    for (std::ptrdiff_t p = grid_.at(row), end = p + grid_.columns; p < end; ++p)
      area += static_cast<double>(grid_.node_area[p] * grid_.mobile[p]);
  }
  return area * static_cast<double>(constants_.areal_mass) * options_.gravity.norm();
}

template <class T>
void SolverImplicit<T>::place(int slot, const Vec3& position) noexcept {
  const std::ptrdiff_t p = at(slot);
  grid_.x.x[p] = part<T>(position, 0);
  grid_.x.y[p] = part<T>(position, 1);
  grid_.x.z[p] = part<T>(position, 2);
}

template <class T>
void SolverImplicit<T>::attach(std::span<const Attachment> attachments,
                               std::span<const AttachmentGroup> groups) noexcept {
  group_count_ = 0;
  std::size_t used = 0;
  for (const AttachmentGroup& group : groups) {
    if (group_count_ == groups_.size() || used + group.count > attachments_.size() ||
        used + group.count > attachments.size())
      break;
    std::copy_n(attachments.begin() + static_cast<std::ptrdiff_t>(used), group.count,
                attachments_.begin() + static_cast<std::ptrdiff_t>(used));
    used += group.count;
    holds_[group_count_] = {};
    groups_[group_count_++] = group;
  }
}

template <class T>
Vec3 SolverImplicit<T>::position(int slot) const noexcept {
  return vector_at(grid_.x, at(slot));
}

template <class T>
Vec3 SolverImplicit<T>::velocity(int slot) const noexcept {
  return vector_at(grid_.v, at(slot));
}

template <class T>
Vec3 SolverImplicit<T>::force_on_fixed(int slot) const noexcept {
  const std::ptrdiff_t p = at(slot);
  const double mass = static_cast<double>(grid_.node_area[p]) * static_cast<double>(constants_.areal_mass);
  return vector_at(grid_.force, p) + mass * load_ * options_.gravity;
}

template <class T>
std::size_t SolverImplicit<T>::bytes() const noexcept {
  return storage_->bytes();
}

template <class T>
void SolverImplicit<T>::restore(const ClothState& state) {
  const ImplicitGrid<T>& g = grid_;
  const auto take = [&](T* const* to, const LawTableView<T>& law, const std::vector<PlayState>& from,
                        std::size_t slot, std::ptrdiff_t p) {
    for (int j = 0; j < law.plays; ++j)
      to[j][p] = static_cast<T>(from[slot].position[static_cast<std::size_t>(j)]);
  };
  for (int row = 0; row < g.rows; ++row) {
    for (int column = 0; column < g.columns; ++column) {
      const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                     static_cast<std::size_t>(column);
      const std::ptrdiff_t p = g.at(row) + column;
      put(g.x, p, state.positions[i]);
      put(g.v, p, state.velocities[i]);
      take(g.memory_weft_bending, constants_.weft_bending, state.weft_bending, i, p);
      take(g.memory_warp_bending, constants_.warp_bending, state.warp_bending, i, p);
      take(g.memory_shear, constants_.shear, state.shear, i, p);
      take(g.memory_weft_tension, constants_.weft_tension, state.weft_tension, i, p);
      take(g.memory_warp_tension, constants_.warp_tension, state.warp_tension, i, p);
    }
  }
  rows(kernels_->keep);
  fall_ = {};
  if (state.carried.size() == 3) fall_ = {true, state.carried[0], state.carried[1], state.carried[2]};
  time_ = state.time;
  // The strains of the edges, for their viscosity: the memory does not move, for it fits the positions
  // already.
  begin_step(1.0);
  evaluate(Evaluation::kForce);
  for (int row = 0; row < g.rows; ++row) {
    const std::ptrdiff_t p = g.at(row);
    std::copy(g.strain[3] + p, g.strain[3] + p + g.stride, g.weft_strain_n + p);
    std::copy(g.strain[4] + p, g.strain[4] + p + g.stride, g.warp_strain_n + p);
  }
}

template <class T>
void SolverImplicit<T>::save(ClothState& state) const {
  const ImplicitGrid<T>& g = grid_;
  const auto count = static_cast<std::size_t>(g.rows) * static_cast<std::size_t>(columns_);
  state.positions.resize(count);
  state.velocities.resize(count);
  for (auto* memory :
       {&state.weft_bending, &state.warp_bending, &state.shear, &state.weft_tension, &state.warp_tension})
    memory->resize(count);
  const auto give = [&](T* const* from, const LawTableView<T>& law, std::vector<PlayState>& to,
                        std::size_t slot, std::ptrdiff_t p) {
    for (int j = 0; j < law.plays; ++j)
      to[slot].position[static_cast<std::size_t>(j)] = static_cast<double>(from[j][p]);
  };
  for (int row = 0; row < g.rows; ++row) {
    for (int column = 0; column < g.columns; ++column) {
      const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                     static_cast<std::size_t>(column);
      const std::ptrdiff_t p = g.at(row) + column;
      state.positions[i] = vector_at(g.x, p);
      state.velocities[i] = vector_at(g.v, p);
      give(g.memory_weft_bending, constants_.weft_bending, state.weft_bending, i, p);
      give(g.memory_warp_bending, constants_.warp_bending, state.warp_bending, i, p);
      give(g.memory_shear, constants_.shear, state.shear, i, p);
      give(g.memory_weft_tension, constants_.weft_tension, state.weft_tension, i, p);
      give(g.memory_warp_tension, constants_.warp_tension, state.warp_tension, i, p);
    }
  }
  state.carried.clear();
  if (fall_.known) state.carried = {fall_.cloth, fall_.kinetic, fall_.weight_power};
  state.time = time_;
}

template class SolverImplicit<float>;
template class SolverImplicit<double>;

}  // namespace fuai
