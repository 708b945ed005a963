// The hands of the user: which there are, which stay, where each holds the cloths.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "fuai/viewer/view_session.h"

namespace fuai {

/// One hand.
struct UserHand {
  bool active = false;
  bool pinned = false;           ///< put there by a double click
  std::size_t cloth = 0;         ///< it was picked on this one
  Vec2 material = Vec2::Zero();  ///< [m]
  Vec3 start = Vec3::Zero();     ///< where it gripped [m]
  Vec3 target = Vec3::Zero();    ///< where it is [m]
  std::int64_t since = 0;        ///< tick of the session when it gripped
  bool seen = false;             ///< a snapshot has shown it
};

/// A fingertip, and a pin [m].
inline constexpr double kFingertipRadius = 0.009, kPinRadius = 0.004;

/// All hands. Thread class: the window's.
class HandBook {
 public:
  /// Grips all cloths at a point of the material. @return number of the hand; -1: none is left
  int grab(ViewSession& session, std::size_t cloth, const Vec2& material, const Vec3& point, bool pin);
  void move(ViewSession& session, int hand, const Vec3& target);
  void release(ViewSession& session, int hand);
  void release_all(ViewSession& session);
  /// All of them, without telling the session.
  void forget() { *this = {}; }
  /// Forgets hands that the session no longer has: after a reset, another scene, a way back in time.
  void follow(const ViewSnapshot& snapshot);

  const UserHand& hand(std::size_t i) const { return hands_[i]; }
  /// The one that gripped or moved last and still holds; -1: none.
  int last() const noexcept { return last_; }

 private:
  std::array<UserHand, kMostViewHands> hands_;
  int last_ = -1;
};

}  // namespace fuai
