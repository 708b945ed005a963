// The linearised step in lanes: the product with a vector, and the blocks that the line solves need; included
// once per instruction set. SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/implicit-step.md.
#if defined(FUAI_IMPLICIT_LINEAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FUAI_IMPLICIT_LINEAR_INL_H
#undef FUAI_IMPLICIT_LINEAR_INL_H
#else
#define FUAI_IMPLICIT_LINEAR_INL_H
#endif

#include "fuai/solver/implicit_evaluate-inl.h"

// Products of rows, columns and lanes: a lattice has at most 4096 slots a side.
// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result)
HWY_BEFORE_NAMESPACE();
namespace fuai {
namespace HWY_NAMESPACE {

/// Elements of one row of A p; the same ring and the same fields as the evaluation.
template <class T>
HWY_NOINLINE void product_row(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, ScratchRow<T> out,
                              int row, bool own) {
  const std::ptrdiff_t S = g.stride;
  const int lanes = lanes_of<T>();
  for (int c = 0; c < g.width; c += lanes) {
    const std::ptrdiff_t p = g.at(row) + c;
    const Lane3<T> x = load3(g.p, p), east = load3(g.p, p + 1), north = load3(g.p, p + S);
    const Lane3<T> e1 = sub(east, x), e2 = sub(north, x);
    const Lane3<T> n = load3(g.normal, p);
    const Lane<T> s1 = dot(n, sub(e1, sub(x, load3(g.p, p - 1))));
    const Lane<T> s2 = dot(n, sub(e2, sub(x, load3(g.p, p - S))));
    Lane<T> y1 = hn::Mul(load(g.weft_stiff + p), s1), y2 = hn::Mul(load(g.warp_stiff + p), s2);
    if (g.cross_stiff != nullptr) {
      const Lane<T> cross_stiff = load(g.cross_stiff + p);
      y1 = hn::MulAdd(cross_stiff, s2, y1);
      y2 = hn::MulAdd(cross_stiff, s1, y2);
    }
    const Lane3<T> L1 = scale(y1, n), L2 = scale(y2, n);
    const Lane3<T> u1 = load3(g.weft_axis, p), u2 = load3(g.warp_axis, p);
    store3(mul_add(dot(u1, e1), u1, mul_add(load(g.weft_side + p), e1, L1)), out.field(kU1), c);
    store3(L1, out.field(kL1), c);
    store3(mul_add(dot(u2, e2), u2, mul_add(load(g.warp_side + p), e2, L2)), out.field(kU2), c);
    store3(L2, out.field(kL2), c);
    const Lane3<T> x11 = load3(g.p, p + S + 1);
    const Lane3<T> plus = load3(g.shear_plus, p), minus = load3(g.shear_minus, p);
    const Lane<T> gamma = add_dot<T>(minus, sub(east, north), dot(plus, sub(x11, x)));
    store3(scale(gamma, plus), out.field(kP), c);
    store3(scale(gamma, minus), out.field(kM), c);
    store3(scale(hn::Mul(load(g.twist_area + p), set(k.twist)), sub(add(x11, x), add(east, north))),
           out.field(kD), c);
    if (!own) continue;
    const Lane3<T> ground = scale(load(g.ground + p), x);
    store3(mul_add(hn::Mul(load(g.air + p), dot(n, x)), n, ground), g.q, p);
  }
}

template <class T>
void multiply_rows(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, T* scratch, int begin, int end) {
  const int lanes = lanes_of<T>();
  for (int row = begin - 1; row <= end; ++row) {
    product_row(g, k, scratch_row(g, scratch, row), row, row >= begin && row < end);
    const int done = row - 1;
    if (done < begin) continue;
    const ScratchRow<T> below = scratch_row(g, scratch, done - 1), here = scratch_row(g, scratch, done),
                        above = scratch_row(g, scratch, row);
    Lane<T> sum = hn::Zero(Tag<T>());
    for (int c = 0; c < g.width; c += lanes) {
      const std::ptrdiff_t p = g.at(done) + c;
      const Lane3<T> q = scale(load(g.mobile + p), add(load3(g.q, p), collect(below, here, above, c)));
      store3(q, g.q, p);
      sum = add_dot<T>(q, load3(g.p, p), sum);
    }
    g.partial[done] = sum_of_lanes<T>(sum);
  }
}

/// A symmetric 3 x 3 block in every lane: xx, xy, xz, yy, yz, zz.
template <class T>
struct Block {
  Lane<T> xx, xy, xz, yy, yz, zz;
};
template <class T>
HWY_INLINE Block<T> load_block(T* const* field, std::ptrdiff_t at) {
  return {load(field[0] + at), load(field[1] + at), load(field[2] + at),
          load(field[3] + at), load(field[4] + at), load(field[5] + at)};
}
template <class T>
HWY_INLINE void store_block(const Block<T>& b, T* const* field, std::ptrdiff_t at) {
  store(b.xx, field[0] + at);
  store(b.xy, field[1] + at);
  store(b.xz, field[2] + at);
  store(b.yy, field[3] + at);
  store(b.yz, field[4] + at);
  store(b.zz, field[5] + at);
}
/// b + s a a^T
template <class T, class V>
HWY_INLINE Block<T> add_outer(V s, const Lane3<T>& a, const Block<T>& b) {
  const Lane3<T> w = scale(s, a);
  return {hn::MulAdd(w.x, a.x, b.xx), hn::MulAdd(w.x, a.y, b.xy), hn::MulAdd(w.x, a.z, b.xz),
          hn::MulAdd(w.y, a.y, b.yy), hn::MulAdd(w.y, a.z, b.yz), hn::MulAdd(w.z, a.z, b.zz)};
}
/// b + a a^T
template <class T>
HWY_INLINE Block<T> add_outer(const Lane3<T>& a, const Block<T>& b) {
  return {hn::MulAdd(a.x, a.x, b.xx), hn::MulAdd(a.x, a.y, b.xy), hn::MulAdd(a.x, a.z, b.xz),
          hn::MulAdd(a.y, a.y, b.yy), hn::MulAdd(a.y, a.z, b.yz), hn::MulAdd(a.z, a.z, b.zz)};
}
template <class T, class V>
HWY_INLINE Block<T> add_isotropic(V s, const Block<T>& b) {
  return {hn::Add(b.xx, s), b.xy, b.xz, hn::Add(b.yy, s), b.yz, hn::Add(b.zz, s)};
}
template <class T, class V>
HWY_INLINE Block<T> scale_block(V s, const Block<T>& b) {
  return {hn::Mul(s, b.xx), hn::Mul(s, b.xy), hn::Mul(s, b.xz),
          hn::Mul(s, b.yy), hn::Mul(s, b.yz), hn::Mul(s, b.zz)};
}
template <class T>
HWY_INLINE Block<T> zero_block() {
  const Lane<T> zero = hn::Zero(Tag<T>());
  return {zero, zero, zero, zero, zero, zero};
}

/// The diagonal block of A at a node, without what only one of the line solves adds.
template <class T>
HWY_INLINE Block<T> diagonal(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, std::ptrdiff_t p) {
  const std::ptrdiff_t S = g.stride;
  const Lane<T> side = hn::Add(hn::Add(load(g.weft_side + p), load(g.weft_side + p - 1)),
                               hn::Add(load(g.warp_side + p), load(g.warp_side + p - S)));
  const Lane<T> cells = hn::Add(hn::Add(load(g.twist_area + p), load(g.twist_area + p - 1)),
                                hn::Add(load(g.twist_area + p - S), load(g.twist_area + p - S - 1)));
  Block<T> b =
      add_isotropic(hn::MulAdd(set(k.twist), cells, hn::Add(side, load(g.ground + p))), zero_block<T>());
  b = add_outer(load3(g.weft_axis, p), b);
  b = add_outer(load3(g.weft_axis, p - 1), b);
  b = add_outer(load3(g.warp_axis, p), b);
  b = add_outer(load3(g.warp_axis, p - S), b);
  // The middle of a triple moves D by -2, an end by 1.
  Lane<T> middle = hn::Add(load(g.weft_stiff + p), load(g.warp_stiff + p));
  if (g.cross_stiff != nullptr) middle = hn::MulAdd(set(T(2)), load(g.cross_stiff + p), middle);
  b = add_outer(hn::MulAdd(set(T(4)), middle, load(g.air + p)), load3(g.normal, p), b);
  b = add_outer(load(g.weft_stiff + p - 1), load3(g.normal, p - 1), b);
  b = add_outer(load(g.weft_stiff + p + 1), load3(g.normal, p + 1), b);
  b = add_outer(load(g.warp_stiff + p - S), load3(g.normal, p - S), b);
  b = add_outer(load(g.warp_stiff + p + S), load3(g.normal, p + S), b);
  b = add_outer(load3(g.shear_plus, p), b);
  b = add_outer(load3(g.shear_minus, p - 1), b);
  b = add_outer(load3(g.shear_minus, p - S), b);
  return add_outer(load3(g.shear_plus, p - S - 1), b);
}

/// What the line solve of one direction adds to the diagonal: a triple couples its two ends, which a
/// tridiagonal line leaves out; put on both ends instead, the line stays positive definite.
template <class T>
HWY_INLINE Block<T> add_ends(const ImplicitGrid<T>& g, const T* stiff, std::ptrdiff_t p, std::ptrdiff_t next,
                             const Block<T>& b) {
  return add_outer(load(stiff + p - next), load3(g.normal, p - next),
                   add_outer(load(stiff + p + next), load3(g.normal, p + next), b));
}

/// Coupling of a node to the next one of its yarn, taken positive.
template <class T>
HWY_INLINE Block<T> link(const ImplicitGrid<T>& g, const Field3<T>& axis, const T* side, const T* stiff,
                         std::ptrdiff_t p, std::ptrdiff_t next) {
  const Lane<T> two = set(T(2));
  Block<T> b = add_outer(load3(axis, p), add_isotropic(load(side + p), zero_block<T>()));
  b = add_outer(hn::Mul(two, load(stiff + p)), load3(g.normal, p), b);
  b = add_outer(hn::Mul(two, load(stiff + p + next)), load3(g.normal, p + next), b);
  return scale_block(hn::Mul(load(g.mobile + p), load(g.mobile + p + next)), b);
}

/// Nodes that are not mobile get the unit block.
template <class T>
HWY_INLINE Block<T> only_mobile(Lane<T> mobile, const Block<T>& b) {
  return add_isotropic(hn::Sub(set(T(1)), mobile), scale_block(mobile, b));
}

#if HWY_TARGET == HWY_SCALAR
template <class T>
HWY_INLINE void store_transposed(const T* tile, std::ptrdiff_t, T* to, std::ptrdiff_t) {
  *to = *tile;
}
#else
/// Transposes kInBlock rows within every block of 16 bytes.
template <class T, int kInBlock>
HWY_INLINE void turn_in_blocks(const T* rows, std::ptrdiff_t pitch, Lane<T>* out) {
  const Tag<T> d;
  if constexpr (kInBlock == 1) {
    out[0] = load(rows);
  } else if constexpr (kInBlock == 2) {
    const Lane<T> a = load(rows), b = load(rows + pitch);
    out[0] = hn::InterleaveLower(d, a, b);
    out[1] = hn::InterleaveUpper(d, a, b);
  } else {
    const hn::Repartition<std::uint64_t, Tag<T>> d2;
    const Lane<T> r0 = load(rows), r1 = load(rows + pitch), r2 = load(rows + 2 * pitch),
                  r3 = load(rows + 3 * pitch);
    const auto a = hn::BitCast(d2, hn::InterleaveLower(d, r0, r1));  // r0.0 r1.0 r0.1 r1.1
    const auto b = hn::BitCast(d2, hn::InterleaveUpper(d, r0, r1));
    const auto c = hn::BitCast(d2, hn::InterleaveLower(d, r2, r3));
    const auto e = hn::BitCast(d2, hn::InterleaveUpper(d, r2, r3));
    out[0] = hn::BitCast(d, hn::InterleaveLower(d2, a, c));
    out[1] = hn::BitCast(d, hn::InterleaveUpper(d2, a, c));
    out[2] = hn::BitCast(d, hn::InterleaveLower(d2, b, e));
    out[3] = hn::BitCast(d, hn::InterleaveUpper(d2, b, e));
  }
}

/// Transposes kBlocks vectors, `kInBlock` apart, taken as rows of blocks of 16 bytes.
template <class T, int kInBlock, int kBlocks>
HWY_INLINE void turn_blocks(const Lane<T>* v, Lane<T>* out) {
  if constexpr (kBlocks == 1) {
    out[0] = v[0];
  } else {
    const Tag<T> d;
    const auto even = [](Lane<T> a, Lane<T> b) HWY_ATTR {
      return hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a);  // a0 b0 a2 b2
    };
    const auto odd = [](Lane<T> a, Lane<T> b) HWY_ATTR {
      return hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a));  // a1 b1 a3 b3
    };
    const Lane<T> e0 = even(v[0], v[kInBlock]), o0 = odd(v[0], v[kInBlock]);
    if constexpr (kBlocks == 2) {
      out[0] = e0;
      out[1] = o0;
    } else {
      const Lane<T> e1 = even(v[2 * kInBlock], v[3 * kInBlock]), o1 = odd(v[2 * kInBlock], v[3 * kInBlock]);
      out[0] = hn::ConcatLowerLower(d, e1, e0);
      out[1] = hn::ConcatLowerLower(d, o1, o0);
      out[2] = hn::ConcatUpperUpper(d, e1, e0);
      out[3] = hn::ConcatUpperUpper(d, o1, o0);
    }
  }
}

/// Writes a tile of lanes x lanes numbers, stored with `pitch` numbers a row, transposed: within 16 bytes by
/// interleaving, between them by moving whole blocks of 16 bytes.
template <class T>
HWY_INLINE void store_transposed(const T* tile, std::ptrdiff_t pitch, T* to, std::ptrdiff_t to_pitch) {
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag<T>()));
  constexpr int kInBlock =
      kLanes < static_cast<int>(16 / sizeof(T)) ? kLanes : static_cast<int>(16 / sizeof(T));
  constexpr int kBlocks = kLanes / kInBlock;
  // v[g * kInBlock + j]: block b holds column kInBlock b + j of the rows of group g.
  Lane<T> v[kLanes];
  for (int g = 0; g < kBlocks; ++g)
    turn_in_blocks<T, kInBlock>(tile + g * kInBlock * pitch, pitch, v + g * kInBlock);
  for (int j = 0; j < kInBlock; ++j) {
    Lane<T> columns[kBlocks];
    turn_blocks<T, kInBlock, kBlocks>(v + j, columns);
    for (int b = 0; b < kBlocks; ++b) store(columns[b], to + (kInBlock * b + j) * to_pitch);
  }
}
#endif  // one lane or more

/// Widest vector in numbers: the pitch of a tile.
template <class T>
inline constexpr int kTile = static_cast<int>(kVectorBytes / sizeof(T));

template <class T>
void assemble_vectors(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, bool links, int begin,
                      int end) {
  const int lanes = lanes_of<T>();
  HWY_ALIGN T tile[12][kTile<T> * kTile<T>];
  for (int r0 = begin * lanes; r0 < end * lanes; r0 += lanes) {
    for (int c = 0; c < g.width; c += lanes) {
      for (int i = 0; i < lanes; ++i) {
        const std::ptrdiff_t p = g.at(r0 + i) + c;
        const Lane<T> mobile = load(g.mobile + p);
        const Block<T> shared = diagonal(g, k, p);
        Block<T> weft = shared, warp = shared, weft_link = zero_block<T>(), warp_link = zero_block<T>();
        if (links) {
          weft = add_ends(g, g.weft_stiff, p, 1, shared);
          warp = add_ends(g, g.warp_stiff, p, g.stride, shared);
          weft_link = link(g, g.weft_axis, g.weft_side, g.weft_stiff, p, 1);
          warp_link = link(g, g.warp_axis, g.warp_side, g.warp_stiff, p, g.stride);
        }
        store_block(only_mobile<T>(mobile, warp), g.warp_inverse, p);
        store_block(warp_link, g.warp_link, p);
        T* rows[12];
        for (int f = 0; f < 12; ++f) rows[f] = tile[f] + i * kTile<T>;
        store_block(only_mobile<T>(mobile, weft), rows, 0);
        store_block(weft_link, rows + 6, 0);
      }
      for (int f = 0; f < 6; ++f) {
        store_transposed(tile[f], kTile<T>, g.weft_inverse_t[f] + g.at_t(c) + r0, g.stride_t);
        store_transposed(tile[f + 6], kTile<T>, g.weft_link_t[f] + g.at_t(c) + r0, g.stride_t);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fuai
HWY_AFTER_NAMESPACE();
// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
#endif  // include guard of the instruction set
