// What the user has on the table, with undo and redo.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fuai/viewer/view_setup.h"

namespace fuai {

/// A setup and its past. Thread class: any.
class ViewDocument {
 public:
  explicit ViewDocument(ViewSetup setup) : states_{std::move(setup)} {}

  const ViewSetup& setup() const noexcept { return states_[now_]; }
  /// A new state after this one; what could be redone is forgotten, and the oldest after kMostStates.
  void change(ViewSetup setup);
  /// The same, but of several changes with the same mark in a row undo goes back to before the first: a
  /// slider that is dragged is one change. @param mark not 0
  void change(ViewSetup setup, std::uint64_t mark);
  /// Ends a row of changes with one mark.
  void end_row() noexcept { mark_ = 0; }
  bool can_undo() const noexcept { return now_ > 0; }
  bool can_redo() const noexcept { return now_ + 1 < states_.size(); }
  void undo() noexcept;
  void redo() noexcept;
  /// Changes with every change, undo and redo.
  std::uint64_t version() const noexcept { return version_; }

  static constexpr std::size_t kMostStates = 200;

 private:
  std::vector<ViewSetup> states_;
  std::size_t now_ = 0;
  std::uint64_t mark_ = 0, version_ = 0;
};

}  // namespace fuai
