// Lays out and fills the arrays of the implicit solver.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/implicit_storage.h"

#include <algorithm>

namespace fuai {
namespace {

int round_up(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

}  // namespace

template <class T>
T* ImplicitStorage<T>::take(std::size_t numbers) {
  T* start = block_ ? block_.get() + used_ : nullptr;
  // Arrays start at odd multiples of a cache line from one another, or the same number of each would fall
  // into the same few sets of the cache.
  const std::size_t line = kVectorBytes / sizeof(T), lines = (numbers + line - 1) / line;
  used_ += (lines % 2 == 0 ? lines + 1 : lines) * line;
  return start;
}

template <class T>
void ImplicitStorage<T>::lay_out(const ClothMaterial& material) {
  ImplicitGrid<T>& g = grid_;
  const int padded_rows = round_up(g.rows, g.lanes);
  const auto field =
      static_cast<std::size_t>(g.stride) * static_cast<std::size_t>(padded_rows + 2 * kPadRows);
  used_ = 0;
  const auto one = [&](T*& to) { to = take(field); };
  const auto three = [&](Field3<T>& to) {
    to.x = take(field);
    to.y = take(field);
    to.z = take(field);
  };
  for (T** to : {&g.node_area, &g.cell_area, &g.weft_edge, &g.warp_edge, &g.weft_bend, &g.warp_bend,
                 &g.weft_curve, &g.warp_curve, &g.weft_strain_n, &g.warp_strain_n})
    one(*to);
  g.twist_area = g.cell_area;  // without twist any area will do: it is multiplied by zero
  if (constants_.twist != T(0)) one(g.twist_area);
  for (Field3<T>* to : {&g.x, &g.v, &g.a, &g.xn, &g.force, &g.d, &g.p, &g.q}) three(*to);
  const auto memory = [&](T** to, const LawTableView<T>& law) {
    for (int j = 0; j < law.plays; ++j) to[j] = take(field);
  };
  memory(g.memory_weft_bending, constants_.weft_bending);
  memory(g.memory_warp_bending, constants_.warp_bending);
  memory(g.memory_shear, constants_.shear);
  memory(g.memory_weft_tension, constants_.weft_tension);
  memory(g.memory_warp_tension, constants_.warp_tension);
  for (T** to : {&g.ground, &g.weft_side, &g.warp_side, &g.weft_stiff, &g.warp_stiff}) one(*to);
  if (material.poisson_bending != 0.0) one(g.cross_stiff);
  if (constants_.air_normal != T(0) || constants_.air_tangential != T(0)) one(g.air);
  for (Field3<T>* to : {&g.weft_axis, &g.warp_axis, &g.normal, &g.shear_plus, &g.shear_minus}) three(*to);
  const auto lines = static_cast<std::size_t>(g.stride) * static_cast<std::size_t>(kLineFields);
  g.warp_lines = take(lines * static_cast<std::size_t>(g.rows));
  g.weft_lines = take(lines * static_cast<std::size_t>(padded_rows));
  // Nobody reads the rows of d before the first and after the last.
  const std::ptrdiff_t outside[2] = {g.at(-1), g.at(g.rows)};
  for (int half = 0; half < 2 && block_ != nullptr; ++half)
    g.meeting[half] = {g.d.x + outside[half], g.d.y + outside[half], g.d.z + outside[half]};
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
  // Flat cloth is far below it, also where a clamp is near.
  const double bending =
      std::max(material.weft_bending.stick_tangent(0.0), material.warp_bending.stick_tangent(0.0));
  const double toe = std::max(tension_toe(material.weft_tension), tension_toe(material.warp_tension));
  k.most_fold = static_cast<T>(std::max(toe, 1000.0 * bending / (h * h)));
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
      const std::ptrdiff_t p = g.index(column, row);
      const bool mobile = model.live[i] != 0 && model.fixed[i] == 0;
      g.node_area[p] = static_cast<T>(mobile ? model.node_area[i] : -model.node_area[i]);
      g.cell_area[p] = static_cast<T>(model.cell_area[i]);
      if (g.twist_area != g.cell_area) g.twist_area[p] = static_cast<T>(model.twist_area[i]);
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
ImplicitStorage<T>::ImplicitStorage(const ClothModel& model, const ClothMaterial& material, int lanes) {
  grid_.columns = model.columns;
  grid_.rows = model.rows;
  grid_.lanes = lanes;
  grid_.vectors = (model.columns + lanes - 1) / lanes;
  grid_.stride = grid_.vectors * lanes;
  fill_constants(model, material);
  lay_out(material);  // counts
  size_ = used_;
  block_ = make_vector_block<T>(size_);
  lay_out(material);  // takes
  const auto sums = static_cast<std::size_t>(std::max(round_up(model.rows, lanes), 2 * grid_.vectors));
  partial_.assign(3 * sums, 0.0);
  grid_.partial = partial_.data();
  grid_.partial_kinetic = grid_.partial + sums;
  grid_.partial_weight = grid_.partial_kinetic + sums;
  fill_arrays(model);
}

template class ImplicitStorage<float>;
template class ImplicitStorage<double>;

}  // namespace fuai
