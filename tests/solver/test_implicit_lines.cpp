// The solves along the yarns are exact, for any number of rows and columns, and whoever does the halves.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fuai/core/types.h"
#include "fuai/solver/implicit_kernels.h"
#include "fuai/solver/implicit_storage.h"
#include "support/small_cloth.h"

using namespace fuai;
using namespace fuai_test;

namespace {

using Mat3 = Eigen::Matrix3d;
constexpr double kH = 0.01, kDt = 1e-3;

/// The blocks of a sheet in a wavy shape, with random right sides; one node is fixed.
class Lines {
 public:
  Lines(int columns, int rows) : model_(sheet_model(columns, rows, kH, 0.15)), material_(uneven_material()) {
    model_.fixed[static_cast<Index>(model_.slot_count() / 2)] = 1;
    step_.dt = kDt;
    step_.inverse_dt = 1.0 / kDt;
    step_.inertia = 1.0 / (kDt * kDt);
    ClothState state = flat_state(model_);
    jitter(state.positions, 0.05 * kH, random_);
    for (int slot = 0; slot < model_.slot_count(); ++slot) {
      Vec3& x = state.positions[static_cast<Index>(slot)];
      x.z() += 0.02 * std::sin(40.0 * x.x() + 25.0 * x.y());
      put(g_.x, g_.slot_index(slot), x);
    }
    k_.evaluate(g_, storage_.constants(), step_, Evaluation::kLinearise, 0, rows);
    k_.assemble(g_, storage_.constants(), true, 0, g_.row_vectors());
    warp_.assign(g_.warp_lines, g_.warp_lines + g_.warp_line(g_.vectors, 0));
    weft_.assign(g_.weft_lines, g_.weft_lines + g_.weft_line(g_.row_vectors(), 0));
    std::uniform_real_distribution<double> force(-1.0, 1.0);
    for (int slot = 0; slot < model_.slot_count(); ++slot)
      put(g_.force, g_.slot_index(slot), {force(random_), force(random_), force(random_)});
  }

  /// Largest part of the right side that the solution of all warp lines leaves.
  double warp_residual() {
    for (int half : {0, 1}) k_.factor_warp(g_, half, 0, g_.vectors);
    k_.factor_meeting(g_, 0, g_.vectors);
    for (int half : {1, 0}) k_.solve_warp_in(g_, 0.0, half, 0, g_.vectors);
    for (int half : {0, 1}) k_.solve_warp_out(g_, half, 0, g_.vectors);
    return residual(1.0, model_.columns, [&](int column, int row) { return warp_at(column, row); });
  }
  /// The same of the weft lines; their kernel adds to q and halves.
  double weft_residual() {
    for (int slot = 0; slot < model_.slot_count(); ++slot) put(g_.q, g_.slot_index(slot), Vec3::Zero());
    k_.factor_weft(g_, 0, g_.row_vectors());
    auto scratch = make_vector_block<double>(static_cast<std::size_t>(k_.scratch_size(g_)));
    k_.solve_weft(g_, scratch.get(), 0, g_.row_vectors());
    return residual(2.0, 1, [&](int column, int row) { return weft_at(column, row); });
  }

 private:
  const double* warp_at(int column, int row) const {
    return &warp_[static_cast<Index>(g_.warp_line(column % g_.vectors, row) + column / g_.vectors)];
  }
  const double* weft_at(int column, int row) const {
    return &weft_[static_cast<Index>(g_.weft_line(row / g_.lanes, column) + row % g_.lanes)];
  }
  /// The diagonal (0) or the coupling (1) of a node.
  Mat3 block(const double* node, int which) const {
    const auto number = [&](int field) { return node[(6 * which + field) * g_.lanes]; };
    Mat3 b;
    b << number(0), number(1), number(2), number(1), number(3), number(4), number(2), number(4), number(5);
    return b;
  }
  /// @param stride from a slot to the next one of its line
  template <class At>
  double residual(double factor, int stride, const At& at) const {
    double most = 0.0;
    for (int slot = 0; slot < model_.slot_count(); ++slot) {
      const int column = slot % model_.columns, row = slot / model_.columns;
      const bool warp = stride != 1;
      const bool first = warp ? row == 0 : column == 0;
      const bool last = warp ? row + 1 == model_.rows : column + 1 == model_.columns;
      const auto solution = [&](int s) -> Vec3 { return factor * vector_at(g_.q, g_.slot_index(s)); };
      Vec3 left = vector_at(g_.force, g_.slot_index(slot)) - block(at(column, row), 0) * solution(slot);
      if (!first)
        left += block(at(column - (warp ? 0 : 1), row - (warp ? 1 : 0)), 1) * solution(slot - stride);
      if (!last) left += block(at(column, row), 1) * solution(slot + stride);
      most = std::max(most, left.norm());
    }
    return most;
  }

  const ImplicitKernels<double>& k_ = implicit_kernels<double>();
  std::mt19937 random_{11};
  ClothModel model_;
  ClothMaterial material_;
  ImplicitStorage<double> storage_{model_, material_, k_.lanes};
  const ImplicitGrid<double>& g_ = storage_.grid();
  ImplicitStepConstants<double> step_;
  std::vector<double> warp_{}, weft_{};
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("lines are solved exactly") {
    // Couplings reach some 1e4 times the inertia: rounding of 1e-16 comes back as 1e-12 of the right side.
    for (int rows : {2, 3, 4, 5, 17, 40}) {
      CAPTURE(rows);
      CHECK(Lines(9, rows).warp_residual() < 1e-10);
      CHECK(Lines(rows, 9).weft_residual() < 1e-10);
    }
  }
}
