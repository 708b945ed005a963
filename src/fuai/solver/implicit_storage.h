// Memory of the implicit solver: one aligned block, cut into the arrays of ImplicitGrid.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/solver/cloth_material.h"
#include "fuai/solver/implicit_grid.h"

namespace fuai {

/// Owns the tables and arrays that a grid points into.
template <class T>
class ImplicitStorage {
 public:
  /// Lays out and zeroes all arrays, and fills the constant ones. Thread class: set-up.
  ImplicitStorage(const ClothModel& model, const ClothMaterial& material);

  const ImplicitGrid<T>& grid() const noexcept { return grid_; }
  const ImplicitConstants<T>& constants() const noexcept { return constants_; }
  std::size_t bytes() const noexcept { return size_ * sizeof(T); }
  int padded_rows() const noexcept { return padded_rows_; }

 private:
  struct Free {
    void operator()(T* block) const noexcept;
  };
  T* take(std::size_t numbers);
  void lay_out(bool poisson);
  void fill_constants(const ClothModel& model, const ClothMaterial& material);
  void fill_arrays(const ClothModel& model);

  std::unique_ptr<T[], Free> block_;
  std::size_t size_ = 0, used_ = 0;
  std::vector<double> partial_;
  LawTable<T> laws_[5];
  ImplicitGrid<T> grid_;
  ImplicitConstants<T> constants_;
  int padded_rows_ = 0;
};

extern template class ImplicitStorage<float>;
extern template class ImplicitStorage<double>;

}  // namespace fuai
