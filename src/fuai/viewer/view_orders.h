// What goes between the two sides of the viewer's session.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "How it works".
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "fuai/viewer/view_history.h"
#include "fuai/viewer/view_session.h"
#include "fuai/viewer/view_stage.h"

namespace fuai::view_orders {

/// How many of each may wait.
inline constexpr std::size_t kMostOrders = 4096, kMostNotes = std::size_t{1} << 14;

/// From the screen to the cloth.
struct Order {
  enum class Kind : std::uint8_t { kCommand, kPlay, kSteps, kSeek, kBack };
  Kind kind = Kind::kCommand;
  ViewCommand command;
  std::uint64_t build = 0;  ///< kCommand: the newest that the screen had asked for
  std::int64_t number = 0;  ///< kPlay: 0 or 1, kSteps and kBack: how many, kSeek: tick
};

/// From the cloth to the screen.
struct Note {
  bool is_rewind = false;
  ViewEvent event;  ///< a rewind has a tick only
};

/// Cloths on their way in, and the old ones on their way out, for the screen's thread to free.
struct Delivery {
  std::unique_ptr<ViewStage> stage;
  std::unique_ptr<ViewHistory> history;  ///< null: the old one has the right size
  std::uint64_t build = 0;
  bool keep_shape = false;
  std::shared_ptr<const ViewScript> script;  ///< null: none
  Delivery* next = nullptr;
};

inline void free_all(Delivery* delivery) noexcept {
  while (delivery != nullptr) delete std::exchange(delivery, delivery->next);
}

}  // namespace fuai::view_orders
