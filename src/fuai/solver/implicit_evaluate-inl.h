// Forces, strains and linearisation of the implicit step, row by row; included once per instruction set.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md (energies and symbols), docs/theory/implicit-step.md (linearisation).
//
// Rows are gone through from the first to the last, vectors from west to east. What the elements of a row put
// on their own nodes and on the next row is summed in registers that move along with the vector; on the row
// before it is added in memory. Every sum has the same order however the rows are shared out: the elements of
// the rows just outside a share are computed too, and only what falls into the share is kept.
#if defined(FUAI_IMPLICIT_EVALUATE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FUAI_IMPLICIT_EVALUATE_INL_H
#undef FUAI_IMPLICIT_EVALUATE_INL_H
#else
#define FUAI_IMPLICIT_EVALUATE_INL_H
#endif

#include "fuai/solver/implicit_elements-inl.h"
#include "fuai/solver/implicit_kernels.h"

// Products of rows, columns and lanes: a lattice has at most 4096 slots a side.
// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result)
HWY_BEFORE_NAMESPACE();
namespace fuai {
namespace HWY_NAMESPACE {

/// Sums of one row of nodes while its vectors are gone through: what elements put on their own node (`here`),
/// on those before and after along the weft.
template <class T>
class RowSums {
 public:
  /// @param out null: the sums of this row are not wanted
  HWY_INLINE RowSums(const ImplicitGrid<T>& g, const Turn<T>& turn, const Field3<T>* out, int row)
      : turn_(turn), out_(out), row_(g.at(row)), end_(row_ + g.stride), lanes_(g.lanes) {
    before_ = after_ = first_west_ = zero3<T>();
  }
  /// Vector by vector. @param west,here,east what this vector's elements add
  HWY_INLINE void add_vector(std::ptrdiff_t p, const Lane3<T>& west, const Lane3<T>& here,
                             const Lane3<T>& east) {
    if (p == row_) {
      first_west_ = turn_.down(west);
    } else {
      put(add(before_, west), p - lanes_);
    }
    before_ = add(here, after_);
    after_ = east;
  }
  /// What is left at the end of the row: the last vector, and what goes round to the first.
  HWY_INLINE void finish() const {
    put(add(before_, first_west_), end_ - lanes_);
    if (out_ != nullptr) put(add(load3(*out_, row_), turn_.up(after_)), row_);
  }

 private:
  HWY_INLINE void put(const Lane3<T>& sum, std::ptrdiff_t p) const {
    if (out_ != nullptr) store3(sum, *out_, p);
  }
  const Turn<T>& turn_;
  const Field3<T>* out_;
  std::ptrdiff_t row_, end_;
  int lanes_;
  Lane3<T> before_, after_, first_west_;
};

/// Where what the elements of a row put on nodes is wanted, and whether what belongs to the row itself is.
struct RowPart {
  int row;
  bool below, own, above;
};
/// The parts of row `row` that fall into the share [begin, end).
inline RowPart row_part(int row, int begin, int end) {
  return {row, row > begin, row >= begin && row < end, row + 1 < end};
}

/// Tension of the yarn edges of a row; the first that the row and the one after it get.
template <bool kLinearise, class T>
HWY_NOINLINE void tension_row(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k,
                              const ImplicitStepConstants<T>& s, const Turn<T>& turn, const RowPart part) {
  const std::ptrdiff_t S = g.stride;
  RowSums<T> own(g, turn, part.own ? &g.force : nullptr, part.row);
  for (int v = 0; v < g.vectors; ++v) {
    const Place<T> at(g, turn, part.row, v);
    const std::ptrdiff_t p = at.p;
    const Lane3<T> x = load3(g.x, p);
    const Tension<T> warp =
        tension(k, k.warp_tension, g.memory_warp_tension, p, sub(load3(g.x, p + S), x), load(g.warp_edge + p),
                set(k.viscosity_warp * s.inverse_dt), load(g.warp_strain_n + p));
    if (part.above) store3(negative(warp.gradient), g.force, p + S);
    if (!part.own) continue;
    const Tension<T> weft =
        tension(k, k.weft_tension, g.memory_weft_tension, p, sub(at.east3(g.x), x), load(g.weft_edge + p),
                set(k.viscosity_weft * s.inverse_dt), load(g.weft_strain_n + p));
    own.add_vector(p, zero3<T>(), add(load3(g.force, p), add(weft.gradient, warp.gradient)),
                   negative(weft.gradient));
    store(weft.strain, g.strain[3] + p);
    store(warp.strain, g.strain[4] + p);
    if constexpr (!kLinearise) continue;
    store3(weft.axis, g.weft_axis, p);
    store3(warp.axis, g.warp_axis, p);
    store(weft.side, g.weft_side + p);
    store(warp.side, g.warp_side + p);
  }
  if (part.own) own.finish();
}

/// Bending of the yarns, inertia, weight and air of a row.
template <bool kLinearise, class T>
HWY_NOINLINE void bend_row(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k,
                           const ImplicitStepConstants<T>& s, const Turn<T>& turn, const RowPart part) {
  const std::ptrdiff_t S = g.stride;
  RowSums<T> own(g, turn, part.own ? &g.force : nullptr, part.row);
  // Folds stiffen the edges on both their sides.
  Lane<T> side = hn::Zero(Tag<T>()), first_fold = side;
  const bool keep = part.own && kLinearise;
  for (int v = 0; v < g.vectors; ++v) {
    const Place<T> at(g, turn, part.row, v);
    const std::ptrdiff_t p = at.p;
    const Lane3<T> x = load3(g.x, p);
    const Cross<T> edges = {sub(at.east3(g.x), x), sub(x, at.west3(g.x)), sub(load3(g.x, p + S), x),
                            sub(x, load3(g.x, p - S))};
    const BendBlock<T> bends = bend(g, k, at, edges);
    if (part.above) store3(sub(load3(g.force, p + S), bends.U2), g.force, p + S);
    if (part.below) {
      store3(sub(load3(g.force, p - S), bends.L2), g.force, p - S);
      if (kLinearise) store(hn::Add(load(g.warp_side + p - S), bends.fold2), g.warp_side + p - S);
    }
    if (!part.own) continue;
    const Lane3<T> inner = add(add(bends.U1, bends.L1), add(bends.U2, bends.L2));
    const Lane3<T> outer = outer_force<kLinearise>(g, k, s, p, x, bends.normal);
    own.add_vector(p, negative(bends.L1), add(load3(g.force, p), add(inner, outer)), negative(bends.U1));
    store(bends.kappa1, g.strain[0] + p);
    store(bends.kappa2, g.strain[1] + p);
    if (!keep) continue;
    store3(bends.normal, g.normal, p);
    store(bends.stiff1, g.weft_stiff + p);
    store(bends.stiff2, g.warp_stiff + p);
    if (g.cross_stiff != nullptr) store(bends.cross, g.cross_stiff + p);
    store(hn::Add(load(g.warp_side + p), bends.fold2), g.warp_side + p);
    if (v == 0) {
      first_fold = turn.down(bends.fold1);
    } else {
      store(hn::Add(side, bends.fold1), g.weft_side + p - g.lanes);
    }
    side = hn::Add(load(g.weft_side + p), bends.fold1);
  }
  if (part.own) own.finish();
  if (keep) store(hn::Add(side, first_fold), g.weft_side + g.at(part.row) + S - g.lanes);
}

/// Shear and twist of the cells of a row.
template <bool kLinearise, class T>
HWY_NOINLINE void cell_row(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, const Turn<T>& turn,
                           const RowPart part) {
  RowSums<T> own(g, turn, part.own ? &g.force : nullptr, part.row);
  RowSums<T> above(g, turn, part.above ? &g.force : nullptr, part.row + 1);
  for (int v = 0; v < g.vectors; ++v) {
    const Place<T> at(g, turn, part.row, v);
    const std::ptrdiff_t p = at.p;
    const CellBlock<T> shear = cell(g, k, at);
    Lane3<T> here = sub(shear.P, shear.D), north = add(shear.M, shear.D);
    if (part.own) {
      here = add(here, load3(g.force, p));
      store(shear.gamma, g.strain[2] + p);
      if (kLinearise) {
        store3(shear.plus, g.shear_plus, p);
        store3(shear.minus, g.shear_minus, p);
      }
    }
    if (part.above) north = add(north, load3(g.force, p + g.stride));
    own.add_vector(p, zero3<T>(), here, sub(shear.D, shear.M));
    above.add_vector(p + g.stride, zero3<T>(), north, negative(add(shear.P, shear.D)));
  }
  own.finish();
  above.finish();
}

/// @tparam kLinearise whether the linearisation is left behind; what only it needs is not computed otherwise
template <bool kLinearise, class T>
void evaluate_share(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k,
                    const ImplicitStepConstants<T>& s, int begin, int end) {
  const Turn<T> turn;
  if (begin == end) return;
  if (begin == 0) {
    for (std::ptrdiff_t p = g.at(0); p < g.at(1); p += g.lanes) store3(zero3<T>(), g.force, p);
  }
  for (int row = begin > 0 ? begin - 1 : 0; row <= end && row < g.rows; ++row) {
    const RowPart part = row_part(row, begin, end);
    if (row < end) tension_row<kLinearise>(g, k, s, turn, part);
    bend_row<kLinearise>(g, k, s, turn, part);
    if (row < end) cell_row<kLinearise>(g, k, turn, part);
  }
}

template <class T>
void evaluate_rows(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, const ImplicitStepConstants<T>& s,
                   Evaluation what, int begin, int end) {
  if (what == Evaluation::kLinearise) {
    evaluate_share<true>(g, k, s, begin, end);
  } else {
    evaluate_share<false>(g, k, s, begin, end);
  }
}

/// Moves the memory of one law to the strain.
template <class T>
HWY_INLINE void commit_law(const LawTableView<T>& law, Lane<T> strain, T* const* memory, std::ptrdiff_t p) {
  for (int j = 0; j < law.plays; ++j) {
    const Lane<T> radius = set(law.radius[j]);
    store(hn::Min(hn::Max(load(memory[j] + p), hn::Sub(strain, radius)), hn::Add(strain, radius)),
          memory[j] + p);
  }
}

template <class T>
void commit_rows(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, int begin, int end) {
  for (std::ptrdiff_t p = g.at(begin); p < g.at(end); p += g.lanes) {
    commit_law(k.weft_bending, load(g.strain[0] + p), g.memory_weft_bending, p);
    commit_law(k.warp_bending, load(g.strain[1] + p), g.memory_warp_bending, p);
    commit_law(k.shear, load(g.strain[2] + p), g.memory_shear, p);
    commit_law(k.weft_tension, load(g.strain[3] + p), g.memory_weft_tension, p);
    commit_law(k.warp_tension, load(g.strain[4] + p), g.memory_warp_tension, p);
    store(load(g.strain[3] + p), g.weft_strain_n + p);
    store(load(g.strain[4] + p), g.warp_strain_n + p);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fuai
HWY_AFTER_NAMESPACE();
// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
#endif  // include guard of the instruction set
