// A small table with cloths and somebody who handles them, for the tests of the viewer's session.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fuai/io/fabric_library.h"
#include "fuai/viewer/view_session.h"

namespace fuai_test {

using namespace fuai;

using Kind = ViewCommand::Kind;

inline ViewSetup small_setup(const std::string& scene = "hanging_sheet", std::size_t fabrics = 1) {
  ViewSetup setup;
  setup.scene = scene;
  setup.size.size = 9;
  setup.size.spacing = 0.01;
  const std::vector<std::string> ids = bundled_fabric_ids();
  for (std::size_t i = 0; i < fabrics; ++i) {
    ViewFabric fabric;
    fabric.source = ids[i % ids.size()];
    fabric.measured = load_fabric(fabric.source);
    setup.fabrics.push_back(fabric);
  }
  return setup;
}

inline std::shared_ptr<ViewCloths> cloths_of(const ViewSetup& setup) {
  return std::make_shared<ViewCloths>(setup);
}

inline ViewCommand grab(int hand, const Vec2& material, const Vec3& position) {
  ViewCommand command;
  command.kind = Kind::kGrab;
  command.hand = static_cast<std::uint8_t>(hand);
  command.material = material;
  command.position = position;
  return command;
}

inline ViewCommand move(int hand, const Vec3& position, int ticks = kMoveTicks) {
  ViewCommand command;
  command.kind = Kind::kMove;
  command.hand = static_cast<std::uint8_t>(hand);
  command.position = position;
  command.ticks = static_cast<std::uint16_t>(ticks);
  return command;
}

inline ViewCommand plain(Kind kind, int hand = 0, bool flag = false) {
  ViewCommand command;
  command.kind = kind;
  command.hand = static_cast<std::uint8_t>(hand);
  command.flag = flag;
  return command;
}

/// A session with a clock that stands for the wall: each round takes a millisecond.
struct Table {
  explicit Table(const ViewSetup& setup, Team* team = nullptr) : session(cloths_of(setup), team) {}

  bool round() { return session.tick(wall_us += 1000.0); }
  /// Plays until so many ticks are done in all.
  void play_to(std::int64_t tick) {
    session.play(true);
    while (session.ticks() < tick) round();
    session.play(false);
    round();
    REQUIRE(session.ticks() == tick);
    hashes[tick] = session.state_hash();
  }
  void seek(std::int64_t tick) {
    session.seek(tick);
    for (int i = 0; i < 400; ++i) round();
    session.fetch();
    REQUIRE(session.snapshot().tick == tick);
  }
  /// Something of everything: two hands, one of them lets go, motion of the scene, a reset of nothing.
  void handle(std::int64_t from, std::int64_t to) {
    for (std::int64_t t = from; t < to; t += 10) {
      const double way = 0.0005 * static_cast<double>(t - from);
      if (t == from) session.send(grab(0, {0.04, 0.02}, {0.04, -0.06, 0.0}));
      if (t == from + 50) session.send(grab(3, {0.02, 0.02}, {0.02, -0.06, 0.01}));
      session.send(move(0, Vec3(0.04, -0.06, way)));
      if (t == from + 100) session.send(plain(Kind::kRelease, 0));
      if (t == from + 150) session.send(grab(0, {0.01, 0.01}, {0.01, -0.07, 0.0}));
      // At 500, where the state is kept, a hold between two others is free: the scene's hand took the first.
      if (t == from + 450) session.send(plain(Kind::kRelease, 3));
      if (t == from + 550) session.send(grab(3, {0.03, 0.03}, {0.03, -0.05, 0.0}));
      if (t == from + 120) session.send(plain(Kind::kMotion, 0, true));
      play_to(std::min(t + 10, to));
    }
  }

  ViewSession session;
  std::map<std::int64_t, std::uint64_t> hashes;  // wherever it was played to
  double wall_us = 0.0;
};

/// What an event stream amounts to after rewinds.
inline void gather(ViewSession& session, std::vector<ViewEvent>& events) {
  std::int64_t rewound = -1;
  const std::vector<ViewEvent> more = session.take_events(rewound);
  if (rewound >= 0) std::erase_if(events, [&](const ViewEvent& e) { return e.tick >= rewound; });
  events.insert(events.end(), more.begin(), more.end());
}

}  // namespace fuai_test
