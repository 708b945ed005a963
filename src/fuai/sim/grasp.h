// A fingertip on the cloth: a patch of fixed physical size, tied to the hand by springs.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/grasp.md.
//
//   weight of a slot   w_i = cloth of the slot under the patch / cloth under the patch, so that the hold does
//   not
//                      depend on the lattice
//   spring of a slot   w_i K (X + R o_i - x_i), o_i where the slot lay in the patch when it was gripped
//   kPoint             the hand gives X; R follows the patch (best fit), so that no moment is put on the
//   cloth kPinch             the hand gives X and R, and feels the moment
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "fuai/cloth/cloth_model.h"
#include "fuai/core/types.h"

namespace fuai {

/// What the hand prescribes.
enum class GraspKind {
  kPoint,  ///< a position: three degrees of freedom
  kPinch,  ///< a position and an orientation: six
};

/// Where and how to grip.
struct GraspSpec {
  Vec2 centre = Vec2::Zero();  ///< of the patch, material coordinates [m]
  double radius = 0.009;       ///< of the patch [m], a fingertip's 8 to 10 mm; 0: the nearest slot alone
  GraspKind kind = GraspKind::kPoint;
  double stiffness = 2000.0;  ///< K, of all springs together [N/m]
  double most_force = 12.0;   ///< beyond it the springs weaken: the cloth slips behind the hand [N]
};

/// Most slots under one patch; a patch that would hold more takes the ones nearest its centre.
inline constexpr std::size_t kMostPatchSlots = 256;

/// One hold. Real-time throughout: no allocation.
class Grasp {
 public:
  /// Grips what lies under the patch where it is now; the hand is at `hand`. @param positions callable: slot
  /// -> position [m]. @return false when there is no cloth. Thread class: real-time.
  template <class Positions>
  bool take(const ClothModel& model, const GraspSpec& spec, const Vec3& hand,
            const Positions& positions) noexcept;

  /// Moves the hand. @param rotation since the grip; kPoint does not use it. Thread class: real-time.
  void move(const Vec3& hand, const Mat3& rotation) noexcept;
  /// kPoint: turns the patch frame after the cloth. Thread class: real-time.
  template <class Positions>
  void follow(const Positions& positions) noexcept;

  const GraspSpec& spec() const noexcept { return spec_; }
  std::size_t size() const noexcept { return count_; }
  int slot(std::size_t i) const noexcept { return slots_[i]; }
  double weight(std::size_t i) const noexcept { return weights_[i]; }
  std::span<const int> slots() const noexcept { return {slots_.data(), count_}; }
  std::span<const double> weights() const noexcept { return {weights_.data(), count_}; }  ///< sum to 1
  Vec3 target(std::size_t i) const noexcept { return centre_ + rotation_ * offsets_[i]; }
  /// Where the patch is to be [m].
  const Vec3& centre() const noexcept { return centre_; }

 private:
  bool choose(const ClothModel& model) noexcept;

  GraspSpec spec_;
  std::size_t count_ = 0;
  std::array<int, kMostPatchSlots> slots_{};
  std::array<double, kMostPatchSlots> weights_{};
  std::array<Vec3, kMostPatchSlots> offsets_{};
  Vec3 centre_ = Vec3::Zero(), to_hand_ = Vec3::Zero();
  Mat3 rotation_ = Mat3::Identity();
};

/// Share of a square of side h about the origin that a disc covers, by 16 x 16 samples.
/// @param centre of the disc against the square's [m]. Thread class: real-time.
double covered_share(const Vec2& centre, double radius, double h) noexcept;

/// Rotation that carries `from` best onto `to` in the weighted least-squares sense, from M = sum w to from^T;
/// `otherwise` when M does not tell. Thread class: real-time.
Mat3 best_rotation(const Mat3& M, const Mat3& otherwise) noexcept;

template <class Positions>
bool Grasp::take(const ClothModel& model, const GraspSpec& spec, const Vec3& hand,
                 const Positions& positions) noexcept {
  spec_ = spec;
  if (!choose(model)) return false;
  centre_ = Vec3::Zero();
  for (std::size_t i = 0; i < count_; ++i) centre_ += weights_[i] * positions(slots_[i]);
  for (std::size_t i = 0; i < count_; ++i) offsets_[i] = positions(slots_[i]) - centre_;
  to_hand_ = hand - centre_;
  rotation_ = Mat3::Identity();
  return true;
}

template <class Positions>
void Grasp::follow(const Positions& positions) noexcept {
  if (spec_.kind != GraspKind::kPoint || count_ < 3) return;
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < count_; ++i) mean += weights_[i] * positions(slots_[i]);
  Mat3 M = Mat3::Zero();
  for (std::size_t i = 0; i < count_; ++i)
    M += weights_[i] * (positions(slots_[i]) - mean) * offsets_[i].transpose();
  rotation_ = best_rotation(M, rotation_);
}

}  // namespace fuai
