// Springs that tie nodes of the implicit solver to points: hands and clamps that give way.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/grasp.md.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fuai/core/types.h"
#include "fuai/solver/implicit_grid.h"

namespace fuai {

/// A node tied to a point by a spring that is solved for with the cloth.
struct Attachment {
  int slot = 0;
  double stiffness = 0.0;      ///< [N/m]
  Vec3 target = Vec3::Zero();  ///< [m]
};

/// Memory to be set aside for attachments.
struct AttachmentRoom {
  std::size_t attachments = 0, groups = 0;
};

/// Consecutive attachments that share a hold: their forces together never exceed `most_force`.
struct AttachmentGroup {
  std::size_t count = 0;       ///< attachments that belong to it
  double most_force = 0.0;     ///< [N]; beyond it the springs weaken together
  Vec3 origin = Vec3::Zero();  ///< point that the moment is taken about [m]
};

/// What a group put on the cloth in the last step.
struct HoldForce {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 moment = Vec3::Zero();  ///< about the group's origin [N m]
  double share = 1.0;          ///< of the spring stiffness that was left after saturation
};

/// The groups of attachments of a step.
template <class T>
class ImplicitHolds {
 public:
  /// Thread class: set-up.
  explicit ImplicitHolds(const AttachmentRoom& room);
  /// Takes over groups while there is room. Thread class: real-time.
  void attach(std::span<const Attachment> attachments, std::span<const AttachmentGroup> groups) noexcept;
  /// Adds their forces where the cloth is to `force`, and their stiffness to `ground` on request.
  /// Thread class: real-time.
  void add(const ImplicitGrid<T>& grid, bool linearise) noexcept;
  /// Power on the cloth where it is and as it moves now [W]. Thread class: real-time.
  double power(const ImplicitGrid<T>& grid) const noexcept;
  /// Of the last add(). Thread class: real-time.
  const HoldForce& force(std::size_t group) const noexcept { return holds_[group]; }

 private:
  std::span<const Attachment> springs(std::size_t first, std::size_t group) const noexcept {
    return {attachments_.data() + first, groups_[group].count};
  }
  std::vector<Attachment> attachments_;
  std::vector<AttachmentGroup> groups_;
  std::vector<HoldForce> holds_;
  std::size_t count_ = 0;
};

extern template class ImplicitHolds<float>;
extern template class ImplicitHolds<double>;

}  // namespace fuai
