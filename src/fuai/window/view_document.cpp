// Undo and redo by keeping setups.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/view_document.h"

#include <utility>

namespace fuai {

void ViewDocument::change(ViewSetup setup) {
  states_.resize(now_ + 1);
  states_.push_back(std::move(setup));
  if (states_.size() > kMostStates) states_.erase(states_.begin());
  now_ = states_.size() - 1;
  mark_ = 0;
  ++version_;
}

void ViewDocument::change(ViewSetup setup, std::uint64_t mark) {
  if (mark == mark_ && now_ > 0) {
    states_.resize(now_ + 1);
    states_[now_] = std::move(setup);
    ++version_;
    return;
  }
  change(std::move(setup));
  mark_ = mark;
}

void ViewDocument::undo() noexcept {
  if (!can_undo()) return;
  --now_;
  mark_ = 0;
  ++version_;
}

void ViewDocument::redo() noexcept {
  if (!can_redo()) return;
  ++now_;
  mark_ = 0;
  ++version_;
}

}  // namespace fuai
