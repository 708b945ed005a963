// The linearised step in lanes: the product with a vector, and the blocks that the line solves need; included
// once per instruction set.
// SPDX-License-Identifier: Apache-2.0
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

/// What the elements of a row add to A p, in the order of the evaluation; finishes the row before: nodes that
/// are not mobile are left out, its sum of p.q is taken.
template <class T>
HWY_NOINLINE void product_row(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, const Turn<T>& turn,
                              const RowPart part) {
  const std::ptrdiff_t S = g.stride;
  RowSums<T> own(g, turn, part.own ? &g.q : nullptr, part.row);
  RowSums<T> above(g, turn, part.above ? &g.q : nullptr, part.row + 1);
  Lane<T> sum = hn::Zero(Tag<T>());
  for (int v = 0; v < g.vectors; ++v) {
    const Place<T> at(g, turn, part.row, v);
    const std::ptrdiff_t p = at.p;
    const Lane3<T> x = load3(g.p, p), east = at.east3(g.p), north = load3(g.p, p + S);
    const Lane3<T> south = load3(g.p, p - S), e1 = sub(east, x), e2 = sub(north, x), n = load3(g.normal, p);
    const Lane<T> s1 = dot(n, sub(e1, sub(x, at.west3(g.p)))), s2 = dot(n, sub(e2, sub(x, south)));
    Lane<T> y1 = hn::Mul(load(g.weft_stiff + p), s1), y2 = hn::Mul(load(g.warp_stiff + p), s2);
    if (g.cross_stiff != nullptr) {
      const Lane<T> cross_stiff = load(g.cross_stiff + p);
      y1 = hn::MulAdd(cross_stiff, s2, y1);
      y2 = hn::MulAdd(cross_stiff, s1, y2);
    }
    if (part.below) {
      const Lane3<T> q = scale(mobile(g, p - S), mul_add(y2, n, load3(g.q, p - S)));
      store3(q, g.q, p - S);
      sum = add_dot<T>(q, south, sum);
    }
    const Lane3<T> u1 = load3(g.weft_axis, p), u2 = load3(g.warp_axis, p);
    const Lane3<T> t1 = mul_add(dot(u1, e1), u1, scale(load(g.weft_side + p), e1));
    const Lane3<T> t2 = mul_add(dot(u2, e2), u2, scale(load(g.warp_side + p), e2));
    const Lane3<T> x11 = at.east3(g.p, S), plus = load3(g.shear_plus, p), minus = load3(g.shear_minus, p);
    const Lane<T> gamma = add_dot<T>(minus, sub(east, north), dot(plus, sub(x11, x)));
    const Lane3<T> P = scale(gamma, plus), M = scale(gamma, minus);
    const Lane3<T> D =
        scale(hn::Mul(load(g.twist_area + p), set(k.twist)), sub(add(x11, x), add(east, north)));
    const Lane<T> both = hn::Add(y1, y2), inward = hn::NegMulAdd(set(T(2)), both, hn::Zero(Tag<T>()));
    Lane3<T> here = sub(mul_add(inward, n, sub(D, P)), add(t1, t2));
    if (part.own) {
      here = add(here, load3(g.q, p));  // of the row before
      here = mul_add(load(g.ground + p), x, here);
      if (g.air != nullptr) here = mul_add(hn::Mul(load(g.air + p), dot(n, x)), n, here);
    }
    own.add_vector(p, scale(y1, n), here, mul_add(y1, n, add(t1, sub(M, D))));
    above.add_vector(p + S, zero3<T>(), mul_add(y2, n, sub(t2, add(M, D))), add(P, D));
  }
  own.finish();
  above.finish();
  if (part.below) g.partial[part.row - 1] = sum_of_lanes<T>(sum);
}

/// The last row of all has no row after it to finish it.
template <class T>
HWY_INLINE void finish_product(const ImplicitGrid<T>& g, int row) {
  Lane<T> sum = hn::Zero(Tag<T>());
  for (std::ptrdiff_t p = g.at(row); p < g.at(row + 1); p += g.lanes) {
    const Lane3<T> q = scale(mobile(g, p), load3(g.q, p));
    store3(q, g.q, p);
    sum = add_dot<T>(q, load3(g.p, p), sum);
  }
  g.partial[row] = sum_of_lanes<T>(sum);
}

template <class T>
void multiply_rows(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, int begin, int end) {
  const Turn<T> turn;
  if (begin == end) return;
  if (begin == 0) {
    for (std::ptrdiff_t p = g.at(0); p < g.at(1); p += g.lanes) store3(zero3<T>(), g.q, p);
  }
  for (int row = begin > 0 ? begin - 1 : 0; row <= end && row < g.rows; ++row)
    product_row(g, k, turn, row_part(row, begin, end));
  if (end == g.rows) finish_product(g, end - 1);
}

/// A symmetric 3 x 3 block in every lane: xx, xy, xz, yy, yz, zz.
template <class T>
struct Block {
  Lane<T> xx, xy, xz, yy, yz, zz;
};
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
HWY_INLINE Block<T> diagonal(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, const Place<T>& at) {
  const std::ptrdiff_t S = g.stride, p = at.p;
  const Lane<T> side = hn::Add(hn::Add(load(g.weft_side + p), at.west(g.weft_side)),
                               hn::Add(load(g.warp_side + p), load(g.warp_side + p - S)));
  const Lane<T> cells = hn::Add(hn::Add(load(g.twist_area + p), at.west(g.twist_area)),
                                hn::Add(load(g.twist_area + p - S), at.west(g.twist_area, -S)));
  Block<T> b =
      add_isotropic(hn::MulAdd(set(k.twist), cells, hn::Add(side, load(g.ground + p))), zero_block<T>());
  b = add_outer(load3(g.weft_axis, p), b);
  b = add_outer(at.west3(g.weft_axis), b);
  b = add_outer(load3(g.warp_axis, p), b);
  b = add_outer(load3(g.warp_axis, p - S), b);
  // The middle of a triple moves D by -2, an end by 1.
  Lane<T> middle = hn::Add(load(g.weft_stiff + p), load(g.warp_stiff + p));
  if (g.cross_stiff != nullptr) middle = hn::MulAdd(set(T(2)), load(g.cross_stiff + p), middle);
  middle = hn::Mul(set(T(4)), middle);
  if (g.air != nullptr) middle = hn::Add(middle, load(g.air + p));
  b = add_outer(middle, load3(g.normal, p), b);
  b = add_outer(load3(g.shear_plus, p), b);
  b = add_outer(at.west3(g.shear_minus), b);
  b = add_outer(load3(g.shear_minus, p - S), b);
  return add_outer(at.west3(g.shear_plus, -S), b);
}

/// What the triples along one yarn put on both their ends, `share` times.
template <class T>
HWY_INLINE Block<T> add_ends(Lane<T> before, const Lane3<T>& n_before, Lane<T> after, const Lane3<T>& n_after,
                             T share, const Block<T>& b) {
  return add_outer(hn::Mul(set(share), before), n_before, add_outer(hn::Mul(set(share), after), n_after, b));
}

/// Coupling of a node to the next one of its yarn, taken positive. @param next stiffness and normal there
template <class T>
HWY_INLINE Block<T> link(const Lane3<T>& axis, Lane<T> side, Lane<T> stiff, const Lane3<T>& n,
                         Lane<T> next_stiff, const Lane3<T>& next_n, Lane<T> both_mobile) {
  const Lane<T> two = set(T(2));
  Block<T> b = add_outer(axis, add_isotropic(side, zero_block<T>()));
  b = add_outer(hn::Mul(two, stiff), n, b);
  b = add_outer(hn::Mul(two, next_stiff), next_n, b);
  return scale_block(both_mobile, b);
}

/// Nodes that are not mobile get the unit block.
template <class T>
HWY_INLINE Block<T> only_mobile(Lane<T> mobile, const Block<T>& b) {
  return add_isotropic(hn::Sub(set(T(1)), mobile), scale_block(mobile, b));
}

/// The blocks of a vector of nodes for both line solves.
template <class T>
struct LineBlocks {
  Block<T> weft, warp, weft_link, warp_link;
};
/// A triple couples its two ends, which a tridiagonal line leaves out; put on both ends instead (twice, in
/// the line of its own direction), the line stays positive definite.
template <class T>
HWY_INLINE LineBlocks<T> line_blocks(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k,
                                     const Place<T>& at, bool links) {
  const std::ptrdiff_t S = g.stride, p = at.p;
  const Lane<T> moves = mobile(g, p), east_area = at.east(g.node_area);
  const Block<T> shared = diagonal(g, k, at);
  const Lane3<T> n = load3(g.normal, p), n_west = at.west3(g.normal), n_east = at.east3(g.normal);
  const Lane3<T> n_south = load3(g.normal, p - S), n_north = load3(g.normal, p + S);
  const Lane<T> k_west = at.west(g.weft_stiff), k_east = at.east(g.weft_stiff);
  const Lane<T> k_south = load(g.warp_stiff + p - S), k_north = load(g.warp_stiff + p + S);
  const T own = links ? T(2) : T(1);
  LineBlocks<T> b;
  b.weft = add_ends<T>(k_west, n_west, k_east, n_east, own,
                       add_ends<T>(k_south, n_south, k_north, n_north, T(1), shared));
  b.warp = add_ends<T>(k_west, n_west, k_east, n_east, T(1),
                       add_ends<T>(k_south, n_south, k_north, n_north, own, shared));
  b.weft = only_mobile<T>(moves, b.weft);
  b.warp = only_mobile<T>(moves, b.warp);
  b.weft_link = b.warp_link = zero_block<T>();
  if (!links) return b;
  const Lane<T> east_moves = hn::IfThenElseZero(hn::Gt(east_area, hn::Zero(Tag<T>())), moves);
  b.weft_link = link(load3(g.weft_axis, p), load(g.weft_side + p), load(g.weft_stiff + p), n, k_east, n_east,
                     east_moves);
  b.warp_link = link(load3(g.warp_axis, p), load(g.warp_side + p), load(g.warp_stiff + p), n, k_north,
                     n_north, hn::Mul(moves, mobile(g, p + S)));
  return b;
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

/// The fields of a block of the line storage.
template <class T>
HWY_INLINE Block<T> load_line(const T* at) {
  const int N = lanes_of<T>();
  return {load(at), load(at + N), load(at + 2 * N), load(at + 3 * N), load(at + 4 * N), load(at + 5 * N)};
}
template <class T>
HWY_INLINE void store_line(const Block<T>& b, T* at, std::ptrdiff_t pitch) {
  store(b.xx, at);
  store(b.xy, at + pitch);
  store(b.xz, at + 2 * pitch);
  store(b.yy, at + 3 * pitch);
  store(b.yz, at + 4 * pitch);
  store(b.zz, at + 5 * pitch);
}

template <class T>
void assemble_vectors(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, bool links, int begin,
                      int end) {
  const int lanes = g.lanes;
  const Turn<T> turn;
  HWY_ALIGN T tile[kLineFields][kTile<T> * kTile<T>];
  constexpr std::ptrdiff_t kTileSize = kTile<T> * kTile<T>;
  for (int rows = begin; rows < end; ++rows) {
    for (int v = 0; v < g.vectors; ++v) {
      for (int i = 0; i < lanes; ++i) {
        const int row = rows * lanes + i;
        T* const line = tile[0] + i * kTile<T>;
        if (row >= g.rows) {
          store_line(add_isotropic(set(T(1)), zero_block<T>()), line, kTileSize);
          store_line(zero_block<T>(), line + 6 * kTileSize, kTileSize);
          continue;
        }
        const LineBlocks<T> b = line_blocks(g, k, Place<T>(g, turn, row, v), links);
        store_line(b.warp, g.warp_lines + g.warp_line(v, row), lanes);
        store_line(b.warp_link, g.warp_lines + g.warp_line(v, row) + 6 * lanes, lanes);
        store_line(b.weft, line, kTileSize);
        store_line(b.weft_link, line + 6 * kTileSize, kTileSize);
      }
      // The columns of a vector lie g.vectors apart.
      T* const to = g.weft_lines + g.weft_line(rows, v);
      for (int f = 0; f < kLineFields; ++f)
        store_transposed<T>(tile[f], kTile<T>, to + f * lanes, g.weft_line(0, g.vectors));
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fuai
HWY_AFTER_NAMESPACE();
// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
#endif  // include guard of the instruction set
