// Lays out and fills the arrays of the implicit solver.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/implicit_storage.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace fuai {
namespace {

int round_up(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

}  // namespace

template <class T>
void ImplicitStorage<T>::Free::operator()(T* block) const noexcept {
  ::operator delete[](block, std::align_val_t(kVectorBytes));
}

template <class T>
T* ImplicitStorage<T>::take(std::size_t numbers) {
  T* start = block_ ? block_.get() + used_ : nullptr;
  // Arrays start at odd multiples of a cache line from one another, or the same number of each would fall
  // into the same few sets of the cache.
  const std::size_t line = kVectorBytes / sizeof(T), lines = (numbers + line - 1) / line;
  used_ += (lines % 2 == 0 ? lines + 5 : lines + 4) * line;
  return start;
}

template <class T>
void ImplicitStorage<T>::lay_out(bool poisson) {
  ImplicitGrid<T>& g = grid_;
  const auto vector = static_cast<int>(kVectorBytes / sizeof(T));
  g.width = round_up(g.columns, vector);
  g.stride = g.width;
  padded_rows_ = round_up(g.rows, vector);
  g.stride_t = padded_rows_;
  const auto field =
      static_cast<std::size_t>(g.stride) * static_cast<std::size_t>(padded_rows_ + 2 * kPadRows);
  const auto turned =
      static_cast<std::size_t>(g.stride_t) * static_cast<std::size_t>(g.stride + 2 * kPadRows);
  used_ = 0;
  take(static_cast<std::size_t>(vector));  // so that the number before the first can be read
  const auto one = [&](T*& to) { to = take(field); };
  const auto three = [&](Field3<T>& to) {
    to.x = take(field);
    to.y = take(field);
    to.z = take(field);
  };
  for (T** to :
       {&g.mobile, &g.node_area, &g.cell_area, &g.twist_area, &g.weft_edge, &g.warp_edge, &g.weft_bend,
        &g.warp_bend, &g.weft_curve, &g.warp_curve, &g.weft_strain_n, &g.warp_strain_n})
    one(*to);
  for (Field3<T>* to : {&g.x, &g.v, &g.xn, &g.force, &g.d, &g.p, &g.q}) three(*to);
  const auto memory = [&](T** to, const LawTableView<T>& law) {
    for (int j = 0; j < law.plays; ++j) to[j] = take(field);
  };
  memory(g.memory_weft_bending, constants_.weft_bending);
  memory(g.memory_warp_bending, constants_.warp_bending);
  memory(g.memory_shear, constants_.shear);
  memory(g.memory_weft_tension, constants_.weft_tension);
  memory(g.memory_warp_tension, constants_.warp_tension);
  for (T** to : {&g.ground, &g.air, &g.weft_side, &g.warp_side, &g.weft_stiff, &g.warp_stiff}) one(*to);
  if (poisson) one(g.cross_stiff);
  for (Field3<T>* to : {&g.weft_axis, &g.warp_axis, &g.normal, &g.shear_plus, &g.shear_minus}) three(*to);
  for (int f = 0; f < 6; ++f) {
    g.warp_inverse[f] = take(field);
    g.warp_link[f] = take(field);
    g.weft_inverse_t[f] = take(turned);
    g.weft_link_t[f] = take(turned);
  }
  g.line_t = {take(turned), take(turned), take(turned)};
  take(static_cast<std::size_t>(vector));
  // Strains live between the evaluation and the commit, directions between two commits.
  T* const shared[5] = {g.p.x, g.p.y, g.p.z, g.q.x, g.q.y};
  std::copy(std::begin(shared), std::end(shared), std::begin(g.strain));
}

template <class T>
void ImplicitStorage<T>::fill_constants(const ClothModel& model, const ClothMaterial& material) {
  const PlayLaw* laws[5] = {&material.weft_bending, &material.warp_bending, &material.shear,
                            &material.weft_tension, &material.warp_tension};
  for (int i = 0; i < 5; ++i) laws_[i] = LawTable<T>(*laws[i]);
  ImplicitConstants<T>& k = constants_;
  LawTableView<T>* views[5] = {&k.weft_bending, &k.warp_bending, &k.shear, &k.weft_tension, &k.warp_tension};
  for (int i = 0; i < 5; ++i) *views[i] = laws_[i].view();
  const double h = model.spacing;
  k.h = static_cast<T>(h);
  k.inverse_h = static_cast<T>(1.0 / h);
  k.twist = static_cast<T>(4.0 * material.twist_stiffness / (h * h * h * h));
  k.poisson_bending = static_cast<T>(material.poisson_bending);
  k.free_edge_weft = static_cast<T>(free_edge_softening(material, material.warp_bending));
  k.free_edge_warp = static_cast<T>(free_edge_softening(material, material.weft_bending));
  k.viscosity_weft = static_cast<T>(tension_viscosity(material.weft_tension, material.viscosity_time));
  k.viscosity_warp = static_cast<T>(tension_viscosity(material.warp_tension, material.viscosity_time));
  k.areal_mass = static_cast<T>(model.areal_mass);
  k.mass_drag = static_cast<T>(material.mass_drag);
  k.air_normal = static_cast<T>(0.5 * material.air_density * material.air_normal);
  k.air_tangential = static_cast<T>(0.5 * material.air_density * material.air_tangential);
}

template <class T>
void ImplicitStorage<T>::fill_arrays(const ClothModel& model) {
  const ImplicitGrid<T>& g = grid_;
  for (int row = 0; row < g.rows; ++row) {
    for (int column = 0; column < g.columns; ++column) {
      const auto i = static_cast<std::size_t>(model.slot(column, row));
      const std::ptrdiff_t p = g.at(row) + column;
      const bool live = model.live[i] != 0;
      g.mobile[p] = live && model.fixed[i] == 0 ? T(1) : T(0);
      g.node_area[p] = static_cast<T>(model.node_area[i]);
      g.cell_area[p] = static_cast<T>(model.cell_area[i]);
      g.twist_area[p] = static_cast<T>(model.twist_area[i]);
      g.weft_edge[p] = static_cast<T>(model.weft_edge_area[i]);
      g.warp_edge[p] = static_cast<T>(model.warp_edge_area[i]);
      g.weft_bend[p] = static_cast<T>(model.weft_bend_area[i]);
      g.warp_bend[p] = static_cast<T>(model.warp_bend_area[i]);
      g.weft_curve[p] = static_cast<T>(2.0 / model.weft_bend_length[i]);
      g.warp_curve[p] = static_cast<T>(2.0 / model.warp_bend_length[i]);
    }
  }
}

template <class T>
ImplicitStorage<T>::ImplicitStorage(const ClothModel& model, const ClothMaterial& material) {
  grid_.columns = model.columns;
  grid_.rows = model.rows;
  fill_constants(model, material);
  const bool poisson = material.poisson_bending != 0.0;
  lay_out(poisson);  // counts
  size_ = used_;
  block_.reset(static_cast<T*>(::operator new[](size_ * sizeof(T), std::align_val_t(kVectorBytes))));
  std::memset(static_cast<void*>(block_.get()), 0, size_ * sizeof(T));
  lay_out(poisson);  // takes
  const auto rows = static_cast<std::size_t>(padded_rows_);
  partial_.assign(3 * rows, 0.0);
  grid_.partial = partial_.data();
  grid_.partial_kinetic = grid_.partial + rows;
  grid_.partial_weight = grid_.partial_kinetic + rows;
  fill_arrays(model);
}

template class ImplicitStorage<float>;
template class ImplicitStorage<double>;

}  // namespace fuai
