// Grips, moves, lets go.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/hand_book.h"

namespace fuai {

int HandBook::grab(ViewSession& session, std::size_t cloth, const Vec2& material, const Vec3& point,
                   bool pin) {
  for (std::size_t i = 0; i < kDeviceHand; ++i) {
    if (hands_[i].active) continue;
    ViewCommand command;
    command.kind = ViewCommand::Kind::kGrab;
    command.hand = static_cast<std::uint8_t>(i);
    command.material = material;
    command.position = point;
    command.radius = pin ? kPinRadius : kFingertipRadius;
    if (!session.send(command)) return -1;
    hands_[i] = {true, pin, cloth, material, point, point, session.ticks()};
    return last_ = static_cast<int>(i);
  }
  return -1;
}

void HandBook::move(ViewSession& session, int hand, const Vec3& target) {
  UserHand& h = hands_[static_cast<std::size_t>(hand)];
  if (!h.active || h.target == target) return;
  ViewCommand command;
  command.hand = static_cast<std::uint8_t>(hand);
  command.position = target;
  if (session.send(command)) h.target = target;
  last_ = hand;
}

void HandBook::release(ViewSession& session, int hand) {
  UserHand& h = hands_[static_cast<std::size_t>(hand)];
  if (!h.active) return;
  ViewCommand command;
  command.kind = ViewCommand::Kind::kRelease;
  command.hand = static_cast<std::uint8_t>(hand);
  if (!session.send(command)) return;
  h.active = false;
  if (last_ == hand) last_ = -1;
  for (std::size_t i = 0; i < kMostViewHands && last_ < 0; ++i)
    if (hands_[i].active && !hands_[i].pinned) last_ = static_cast<int>(i);
}

void HandBook::release_all(ViewSession& session) {
  for (std::size_t i = 0; i < kMostViewHands; ++i) release(session, static_cast<int>(i));
}

void HandBook::follow(const ViewSnapshot& snapshot) {
  if (snapshot.cloths.empty()) return;
  for (std::size_t i = 0; i < kMostViewHands; ++i) {
    UserHand& h = hands_[i];
    bool holds = false;
    for (const ClothView& cloth : snapshot.cloths) holds = holds || cloth.hands[i].holds;
    if (holds) h.seen = true;
    // The round that is under way may end in a snapshot without it; the next one has done the command. A
    // snapshot from before is a way back in time only where one has shown the hand; else it is merely old.
    if (h.active && !holds && (snapshot.tick > h.since + 1 || (h.seen && snapshot.tick < h.since))) {
      h.active = false;
      if (last_ == static_cast<int>(i)) last_ = -1;
    }
    if (!h.active && holds && snapshot.tick < h.since) {  // back in time to where it still held
      h.active = true;
      h.target = snapshot.cloths.front().targets[i];
      h.since = snapshot.tick;
    }
  }
}

}  // namespace fuai
