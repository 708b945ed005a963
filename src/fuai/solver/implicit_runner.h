// Runs the kernels of the implicit solver over all rows, alone or shared out to a team.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/implicit-step.md, "Two threads".
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>

#include "fuai/core/team.h"
#include "fuai/solver/implicit_kernels.h"
#include "fuai/solver/implicit_storage.h"

namespace fuai {

/// Shares kernels out and adds up their partial sums, always in the same order, whoever did them.
template <class T>
class ImplicitRunner {
 public:
  /// Thread class: set-up.
  ImplicitRunner(const ImplicitKernels<T>& kernels, const ImplicitGrid<T>& grid)
      : kernels_(&kernels), grid_(&grid) {
    set_team(nullptr);
  }
  /// Null: one thread. The team must outlive the calls. Thread class: set-up.
  void set_team(Team* team) {
    team_ = team != nullptr && team->size() > 1 ? team : nullptr;
    const auto line = kVectorBytes / sizeof(T);
    const auto numbers = static_cast<std::size_t>(kernels_->scratch_size(*grid_));
    scratch_size_ = (numbers + line - 1) / line * line;
    scratch_ = make_vector_block<T>(scratch_size_ * static_cast<std::size_t>(members()));
  }

  /// A kernel over rows; the sum of its rows. Thread class: real-time.
  template <class Kernel, class... Arguments>
  double rows(Kernel kernel, const Arguments&... arguments) noexcept {
    share(grid_->rows, [&](int, Share s) { kernel(*grid_, arguments..., s.begin, s.end); });
    return sum(grid_->rows);
  }
  /// A kernel over vectors of rows. Thread class: real-time.
  template <class Kernel, class... Arguments>
  void row_vectors(Kernel kernel, const Arguments&... arguments) noexcept {
    share(grid_->row_vectors(), [&](int, Share s) { kernel(*grid_, arguments..., s.begin, s.end); });
  }
  /// A kernel over vectors of columns; the sum of its vectors. Thread class: real-time.
  template <class Kernel, class... Arguments>
  double columns(Kernel kernel, const Arguments&... arguments) noexcept {
    share(grid_->vectors, [&](int, Share s) { kernel(*grid_, arguments..., s.begin, s.end); });
    return sum(grid_->vectors);
  }
  /// A kernel over both halves of the warp lines, `first` the one that a caller alone begins with; the sum of
  /// their vectors of columns. A half stays with the same member, and with it the rows. Thread class:
  /// real-time.
  template <class Kernel, class... Arguments>
  double halves(int first, Kernel kernel, const Arguments&... arguments) noexcept {
    run_together(team_, [&](int member) {
      const int count = members();
      for (int half : {first, 1 - first}) {
        if (count > 1 && member % 2 != half) continue;
        const Share s = share_of(grid_->vectors, member / 2, count > 1 ? (count + 1 - half) / 2 : 1);
        kernel(*grid_, arguments..., half, s.begin, s.end);
      }
    });
    return sum(2 * grid_->vectors);
  }
  /// The weft lines; the sum of the rows. Thread class: real-time.
  double solve_weft() noexcept {
    share(grid_->row_vectors(), [&](int member, Share s) {
      kernels_->solve_weft(*grid_, scratch_.get() + scratch_size_ * static_cast<std::size_t>(member), s.begin,
                           s.end);
    });
    return sum(grid_->rows);
  }

 private:
  int members() const noexcept { return team_ != nullptr ? team_->size() : 1; }
  template <class Work>
  void share(int count, const Work& work) noexcept {
    run_together(team_, [&](int member) { work(member, share_of(count, member, members())); });
  }
  double sum(int count) const noexcept {
    double sum = 0.0;
    for (int i = 0; i < count; ++i) sum += grid_->partial[i];
    return sum;
  }

  const ImplicitKernels<T>* kernels_;
  const ImplicitGrid<T>* grid_;
  Team* team_ = nullptr;
  VectorBlock<T> scratch_;  // one set a member
  std::size_t scratch_size_ = 0;
};

}  // namespace fuai
