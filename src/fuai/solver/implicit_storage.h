// Memory of the implicit solver: one aligned block, cut into the arrays of ImplicitGrid.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/solver/cloth_material.h"
#include "fuai/solver/implicit_grid.h"

namespace fuai {

/// Numbers that start at a whole vector.
template <class T>
struct FreeVectorBlock {
  void operator()(T* block) const noexcept { ::operator delete[](block, std::align_val_t(kVectorBytes)); }
};
template <class T>
using VectorBlock = std::unique_ptr<T[], FreeVectorBlock<T>>;
/// Zeroed. Thread class: set-up.
template <class T>
VectorBlock<T> make_vector_block(std::size_t numbers) {
  auto* const block = static_cast<T*>(::operator new[](numbers * sizeof(T), std::align_val_t(kVectorBytes)));
  std::fill_n(block, numbers, T(0));
  return VectorBlock<T>(block);
}

/// Owns the tables and arrays that a grid points into.
template <class T>
class ImplicitStorage {
 public:
  /// Lays out and zeroes all arrays, and fills the constant ones. Thread class: set-up.
  /// @param lanes numbers a vector of the kernels
  ImplicitStorage(const ClothModel& model, const ClothMaterial& material, int lanes);

  const ImplicitGrid<T>& grid() const noexcept { return grid_; }
  const ImplicitConstants<T>& constants() const noexcept { return constants_; }
  std::size_t bytes() const noexcept { return size_ * sizeof(T); }

 private:
  T* take(std::size_t numbers);
  void lay_out(const ClothMaterial& material);
  void fill_constants(const ClothModel& model, const ClothMaterial& material);
  void fill_arrays(const ClothModel& model);

  VectorBlock<T> block_;
  std::size_t size_ = 0, used_ = 0;
  std::vector<double> partial_;
  LawTable<T> laws_[5];
  ImplicitGrid<T> grid_;
  ImplicitConstants<T> constants_;
};

extern template class ImplicitStorage<float>;
extern template class ImplicitStorage<double>;

}  // namespace fuai
