// Forces of the springs that tie nodes to points.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/implicit_holds.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace fuai {
namespace {

/// The springs of a group weaken together when their sum would exceed what the hold can bear.
template <class T>
HoldForce hold_now(const ImplicitGrid<T>& grid, const AttachmentGroup& group,
                   std::span<const Attachment> springs) noexcept {
  HoldForce hold;
  for (const Attachment& a : springs) {
    const Vec3 x = vector_at(grid.x, grid.slot_index(a.slot)), force = a.stiffness * (a.target - x);
    hold.force += force;
    hold.moment += (x - group.origin).cross(force);
  }
  const double size = hold.force.norm();
  hold.share = size > group.most_force ? group.most_force / size : 1.0;
  hold.force *= hold.share;
  hold.moment *= hold.share;
  return hold;
}

}  // namespace

template <class T>
ImplicitHolds<T>::ImplicitHolds(const AttachmentRoom& room)
    : attachments_(room.attachments), groups_(room.groups), holds_(room.groups) {}

template <class T>
void ImplicitHolds<T>::attach(std::span<const Attachment> attachments,
                              std::span<const AttachmentGroup> groups) noexcept {
  count_ = 0;
  std::size_t used = 0;
  for (const AttachmentGroup& group : groups) {
    const std::size_t next = used + group.count;
    if (count_ == groups_.size() || next > attachments_.size() || next > attachments.size()) break;
    const auto first = static_cast<std::ptrdiff_t>(used);
    std::copy_n(attachments.begin() + first, group.count, attachments_.begin() + first);
    used = next;
    holds_[count_] = {};
    groups_[count_++] = group;
  }
}

template <class T>
void ImplicitHolds<T>::add(const ImplicitGrid<T>& grid, bool linearise) noexcept {
  std::size_t first = 0;
  for (std::size_t g = 0; g < count_; first += groups_[g].count, ++g) {
    holds_[g] = hold_now(grid, groups_[g], springs(first, g));
    for (const Attachment& a : springs(first, g)) {
      const std::ptrdiff_t p = grid.slot_index(a.slot);
      if (!grid.mobile(p)) continue;
      const double k = holds_[g].share * a.stiffness;
      put(grid.force, p, vector_at(grid.force, p) + k * (a.target - vector_at(grid.x, p)));
      if (linearise) grid.ground[p] += static_cast<T>(k);
    }
  }
}

template <class T>
double ImplicitHolds<T>::power(const ImplicitGrid<T>& grid) const noexcept {
  double power = 0.0;
  std::size_t first = 0;
  for (std::size_t g = 0; g < count_; first += groups_[g].count, ++g) {
    const double share = hold_now(grid, groups_[g], springs(first, g)).share;
    for (const Attachment& a : springs(first, g)) {
      const std::ptrdiff_t p = grid.slot_index(a.slot);
      if (!grid.mobile(p)) continue;
      power += share * a.stiffness * (a.target - vector_at(grid.x, p)).dot(vector_at(grid.v, p));
    }
  }
  return power;
}

template class ImplicitHolds<float>;
template class ImplicitHolds<double>;

}  // namespace fuai
