// The exact solves along the yarns, one yarn a lane; included once per instruction set.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/implicit-step.md, "Line solves".
//
// Block Thomas on symmetric 3 x 3 blocks, with E_k = D_k - C_{k-1} E_{k-1}^-1 C_{k-1}:
//   forward   w_k = E_k^-1 (f_k + C_{k-1} w_{k-1})        backward   z_k = w_k + E_k^-1 C_k z_{k+1}
#if defined(FUAI_IMPLICIT_LINES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FUAI_IMPLICIT_LINES_INL_H
#undef FUAI_IMPLICIT_LINES_INL_H
#else
#define FUAI_IMPLICIT_LINES_INL_H
#endif

#include <type_traits>

#include "fuai/solver/implicit_linear-inl.h"

// Products of rows, columns and lanes: a lattice has at most 4096 slots a side.
// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result)
HWY_BEFORE_NAMESPACE();
namespace fuai {
namespace HWY_NAMESPACE {

template <class T>
HWY_INLINE Lane3<T> apply(const Block<T>& b, const Lane3<T>& a) {
  return {hn::MulAdd(b.xz, a.z, hn::MulAdd(b.xy, a.y, hn::Mul(b.xx, a.x))),
          hn::MulAdd(b.yz, a.z, hn::MulAdd(b.yy, a.y, hn::Mul(b.xy, a.x))),
          hn::MulAdd(b.zz, a.z, hn::MulAdd(b.yz, a.y, hn::Mul(b.xz, a.x)))};
}
/// b a + c
template <class T>
HWY_INLINE Lane3<T> apply_add(const Block<T>& b, const Lane3<T>& a, const Lane3<T>& c) {
  return {hn::MulAdd(b.xz, a.z, hn::MulAdd(b.xy, a.y, hn::MulAdd(b.xx, a.x, c.x))),
          hn::MulAdd(b.yz, a.z, hn::MulAdd(b.yy, a.y, hn::MulAdd(b.xy, a.x, c.y))),
          hn::MulAdd(b.zz, a.z, hn::MulAdd(b.yz, a.y, hn::MulAdd(b.xz, a.x, c.z)))};
}

/// Inverse through L D L^T, whose pivots stay positive in single precision where the determinant would
/// cancel.
template <class T>
HWY_INLINE Block<T> invert(const Block<T>& b) {
  const Lane<T> least = hn::Mul(set(T(1e-6)), hn::Add(b.xx, hn::Add(b.yy, b.zz)));
  const Lane<T> i1 = inverse<T>(hn::Max(b.xx, least));
  const Lane<T> l21 = hn::Mul(b.xy, i1), l31 = hn::Mul(b.xz, i1);
  const Lane<T> i2 = inverse<T>(hn::Max(hn::NegMulAdd(l21, b.xy, b.yy), least));
  const Lane<T> m32 = hn::NegMulAdd(l21, b.xz, b.yz);
  const Lane<T> l32 = hn::Mul(m32, i2);
  const Lane<T> d3 = hn::NegMulAdd(l32, m32, hn::NegMulAdd(l31, b.xz, b.zz));
  const Lane<T> i3 = inverse<T>(hn::Max(d3, least));
  // Rows of L^-1: (1, 0, 0), (-l21, 1, 0), (m31, -l32, 1)
  const Lane<T> m31 = hn::MulSub(l21, l32, l31);
  Block<T> r;
  r.zz = i3;
  r.yz = hn::Neg(hn::Mul(i3, l32));
  r.xz = hn::Mul(i3, m31);
  r.yy = hn::NegMulAdd(l32, r.yz, i2);
  r.xy = hn::NegMulAdd(l32, r.xz, hn::Neg(hn::Mul(i2, l21)));
  r.xx = hn::MulAdd(m31, r.xz, hn::MulAdd(hn::Mul(i2, l21), l21, i1));
  return r;
}

/// d - c e c for symmetric blocks.
template <class T>
HWY_INLINE Block<T> subtract_sandwich(const Block<T>& d, const Block<T>& c, const Block<T>& e) {
  // Columns of e c, then the upper half of c (e c).
  const Lane3<T> x = apply(e, Lane3<T>{c.xx, c.xy, c.xz}), y = apply(e, Lane3<T>{c.xy, c.yy, c.yz}),
                 z = apply(e, Lane3<T>{c.xz, c.yz, c.zz});
  const Lane3<T> cx = {c.xx, c.xy, c.xz}, cy = {c.xy, c.yy, c.yz}, cz = {c.xz, c.yz, c.zz};
  return {hn::Sub(d.xx, dot(cx, x)), hn::Sub(d.xy, dot(cx, y)), hn::Sub(d.xz, dot(cx, z)),
          hn::Sub(d.yy, dot(cy, y)), hn::Sub(d.yz, dot(cy, z)), hn::Sub(d.zz, dot(cz, z))};
}

/// Vectors of lines that are worked on side by side: their chains of dependent products overlap, and rows are
/// read in the order they are stored.
inline constexpr int kBeside = 4;

/// Calls with 4, then 2, then 1 vectors of lines from `begin` to `end`.
template <class Work>
HWY_INLINE void in_groups(int begin, int end, const Work& work) {
  int i = begin;
  for (; i + kBeside <= end; i += kBeside) work(i, std::integral_constant<int, kBeside>());
  for (; i + 2 <= end; i += 2) work(i, std::integral_constant<int, 2>());
  for (; i < end; ++i) work(i, std::integral_constant<int, 1>());
}

/// Factors `count` nodes of kCount vectors of lines, the first at `start`, the next node `pitch` numbers on.
template <int kCount, class T>
HWY_INLINE void factor_lines(T* const* inverse, T* const* link, std::ptrdiff_t start, std::ptrdiff_t pitch,
                             int count) {
  const int lanes = lanes_of<T>();
  Block<T> e[kCount];
  for (int v = 0; v < kCount; ++v) {
    e[v] = invert(load_block(inverse, start + v * lanes));
    store_block(e[v], inverse, start + v * lanes);
  }
  for (int i = 1; i < count; ++i) {
    for (int v = 0; v < kCount; ++v) {
      const std::ptrdiff_t p = start + i * pitch + v * lanes;
      e[v] = invert(subtract_sandwich(load_block(inverse, p), load_block(link, p - pitch), e[v]));
      store_block(e[v], inverse, p);
    }
  }
}

template <class T>
void factor_warp_vectors(const ImplicitGrid<T>& g, int begin, int end) {
  in_groups(begin, end, [&](int i, auto count) HWY_ATTR {
    factor_lines<decltype(count)::value>(g.warp_inverse, g.warp_link, g.at(0) + i * lanes_of<T>(), g.stride,
                                         g.rows);
  });
}
template <class T>
void factor_weft_vectors(const ImplicitGrid<T>& g, int begin, int end) {
  in_groups(begin, end, [&](int i, auto count) HWY_ATTR {
    factor_lines<decltype(count)::value>(g.weft_inverse_t, g.weft_link_t, g.at_t(0) + i * lanes_of<T>(),
                                         g.stride_t, g.columns);
  });
}

/// Solves kCount vectors of lines: `from` and `to` may be the same field.
template <int kCount, class T>
HWY_INLINE void solve_lines(T* const* inverse, T* const* link, const Field3<T>& from, const Field3<T>& to,
                            std::ptrdiff_t start, std::ptrdiff_t pitch, int count) {
  const int lanes = lanes_of<T>();
  Lane3<T> w[kCount];
  for (int v = 0; v < kCount; ++v) {
    w[v] = apply(load_block(inverse, start + v * lanes), load3(from, start + v * lanes));
    store3(w[v], to, start + v * lanes);
  }
  for (int i = 1; i < count; ++i) {
    for (int v = 0; v < kCount; ++v) {
      const std::ptrdiff_t p = start + i * pitch + v * lanes;
      w[v] = apply(load_block(inverse, p), apply_add(load_block(link, p - pitch), w[v], load3(from, p)));
      store3(w[v], to, p);
    }
  }
  for (int i = count - 2; i >= 0; --i) {
    for (int v = 0; v < kCount; ++v) {
      const std::ptrdiff_t p = start + i * pitch + v * lanes;
      w[v] = apply_add(load_block(inverse, p), apply(load_block(link, p), w[v]), load3(to, p));
      store3(w[v], to, p);
    }
  }
}

template <class T>
void solve_warp_vectors(const ImplicitGrid<T>& g, int begin, int end) {
  in_groups(begin, end, [&](int i, auto count) HWY_ATTR {
    solve_lines<decltype(count)::value>(g.warp_inverse, g.warp_link, g.force, g.q,
                                        g.at(0) + i * lanes_of<T>(), g.stride, g.rows);
  });
}

template <class T>
void solve_weft_vectors(const ImplicitGrid<T>& g, int begin, int end) {
  const int lanes = lanes_of<T>();
  const Field3<T>& from = g.force;
  const Field3<T>& to = g.line_t;
  for (int c = 0; c < g.columns; c += lanes) {
    for (int r0 = begin * lanes; r0 < end * lanes; r0 += lanes) {
      const std::ptrdiff_t p = g.at(r0) + c, t = g.at_t(c) + r0;
      store_transposed(from.x + p, g.stride, to.x + t, g.stride_t);
      store_transposed(from.y + p, g.stride, to.y + t, g.stride_t);
      store_transposed(from.z + p, g.stride, to.z + t, g.stride_t);
    }
  }
  in_groups(begin, end, [&](int i, auto count) HWY_ATTR {
    solve_lines<decltype(count)::value>(g.weft_inverse_t, g.weft_link_t, to, to, g.at_t(0) + i * lanes,
                                        g.stride_t, g.columns);
  });
}

template <class T>
void average_vectors(const ImplicitGrid<T>& g, int begin, int end) {
  const int lanes = lanes_of<T>();
  HWY_ALIGN T tile[3][kTile<T> * kTile<T>];
  for (int i = begin; i < end; ++i) {
    const int r0 = i * lanes;
    Lane<T> sums[kTile<T>];
    for (int j = 0; j < lanes; ++j) sums[j] = hn::Zero(Tag<T>());
    for (int c = 0; c < g.width; c += lanes) {
      const std::ptrdiff_t t = g.at_t(c) + r0;
      store_transposed(g.line_t.x + t, g.stride_t, tile[0], lanes);
      store_transposed(g.line_t.y + t, g.stride_t, tile[1], lanes);
      store_transposed(g.line_t.z + t, g.stride_t, tile[2], lanes);
      for (int j = 0; j < lanes; ++j) {
        const std::ptrdiff_t p = g.at(r0 + j) + c;
        const Lane3<T> weft = {load(tile[0] + j * lanes), load(tile[1] + j * lanes),
                               load(tile[2] + j * lanes)};
        const Lane3<T> z = scale(set(T(0.5)), add(weft, load3(g.q, p)));
        store3(z, g.q, p);
        sums[j] = add_dot<T>(z, load3(g.force, p), sums[j]);
      }
    }
    for (int j = 0; j < lanes; ++j) g.partial[r0 + j] = sum_of_lanes<T>(sums[j]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fuai
HWY_AFTER_NAMESPACE();
// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
#endif  // include guard of the instruction set
