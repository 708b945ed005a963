// The exact solves along the yarns, one yarn a lane; included once per instruction set.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/implicit-step.md, "Line solves".
//
// Block Thomas on symmetric 3 x 3 blocks, with E_k = D_k - C_{k-1} E_{k-1}^-1 C_{k-1}:
//   forward   w_k = E_k^-1 (f_k + C_{k-1} w_{k-1})        backward   z_k = w_k + E_k^-1 C_k z_{k+1}
// Warp lines are gone through from both ends at once and meet in the middle row, so that each of two threads
// keeps to its half of the rows.
#if defined(FUAI_IMPLICIT_LINES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FUAI_IMPLICIT_LINES_INL_H
#undef FUAI_IMPLICIT_LINES_INL_H
#else
#define FUAI_IMPLICIT_LINES_INL_H
#endif

#include <algorithm>
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

/// Nodes of lines one after the other: `first`, `first + step`, ...
struct Sweep {
  int first, count, step;
};
/// Where the halves of the warp lines meet.
template <class T>
HWY_INLINE int meeting_row(const ImplicitGrid<T>& g) {
  return g.rows / 2;
}
/// The rows of half 0 or 1 of the warp lines, from the end of the cloth to the row before the meeting.
template <class T>
HWY_INLINE Sweep half_sweep(const ImplicitGrid<T>& g, int half) {
  const int meeting = meeting_row(g);
  return half == 0 ? Sweep{0, meeting, 1} : Sweep{g.rows - 1, g.rows - 1 - meeting, -1};
}

/// Factors the nodes of kCount vectors of lines; `pitch` numbers from one vector of lines to the next.
template <int kCount, class T>
HWY_INLINE void factor_lines(T* lines, std::ptrdiff_t pitch, const Sweep& sweep) {
  const int lanes = lanes_of<T>();
  Block<T> e[kCount];
  for (int v = 0; v < kCount; ++v) e[v] = zero_block<T>();
  for (int i = 0; i < sweep.count; ++i) {
    T* const node = lines + (sweep.first + i * sweep.step) * (kLineFields * lanes);
    for (int v = 0; v < kCount; ++v) {
      T* const at = node + v * pitch;
      const Block<T> d = load_line(at);
      e[v] = invert(i == 0 ? d : subtract_sandwich(d, load_line(at - sweep.step * 6 * lanes), e[v]));
      store_line(e[v], at, lanes);
    }
  }
}

template <class T>
void factor_warp_half(const ImplicitGrid<T>& g, int half, int begin, int end) {
  in_groups(begin, end, [&](int i, auto count) HWY_ATTR {
    factor_lines<decltype(count)::value>(g.warp_lines + g.warp_line(i, 0), g.warp_line(1, 0),
                                         half_sweep(g, half));
  });
}
/// The meeting row, eliminated from both sides.
template <class T>
void factor_meeting_vectors(const ImplicitGrid<T>& g, int begin, int end) {
  const int lanes = lanes_of<T>(), meeting = meeting_row(g);
  for (int v = begin; v < end; ++v) {
    T* const at = g.warp_lines + g.warp_line(v, meeting);
    Block<T> d = load_line(at);
    for (int side : {-1, 1}) {
      if (half_sweep(g, side < 0 ? 0 : 1).count == 0) continue;
      d = subtract_sandwich(d, load_line(at + side * 6 * lanes), load_line(at + side * kLineFields * lanes));
    }
    store_line(invert(d), at, lanes);
  }
}
template <class T>
void factor_weft_vectors(const ImplicitGrid<T>& g, int begin, int end) {
  in_groups(begin, end, [&](int i, auto count) HWY_ATTR {
    factor_lines<decltype(count)::value>(g.weft_lines + g.weft_line(i, 0), g.weft_line(1, 0),
                                         Sweep{0, g.columns, 1});
  });
}

/// Goes through half of kCount vectors of warp lines to the meeting row; force -= alpha q on the way.
template <int kCount, bool kAdvance, class T>
HWY_INLINE void warp_lines_in(const ImplicitGrid<T>& g, T alpha, int half, int first) {
  const int lanes = lanes_of<T>();
  const Sweep sweep = half_sweep(g, half);
  const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(first) * lanes;
  const T* const lines = g.warp_lines + g.warp_line(first, 0);
  const std::ptrdiff_t pitch = g.warp_line(1, 0), outer_link = -sweep.step * 6 * lanes;
  Lane3<T> w[kCount];
  Lane<T> sum[kCount];
  for (int v = 0; v < kCount; ++v) {
    w[v] = zero3<T>();
    sum[v] = hn::Zero(Tag<T>());
  }
  const auto right_side = [&](int v, std::ptrdiff_t p) HWY_ATTR {
    Lane3<T> f = load3(g.force, p);
    if constexpr (kAdvance) {
      f = neg_mul_add(set(alpha), load3(g.q, p), f);
      store3(f, g.force, p);
      sum[v] = add_dot<T>(f, f, sum[v]);
    }
    return f;
  };
  for (int i = 0; i < sweep.count; ++i) {
    const int row = sweep.first + i * sweep.step;
    const T* const node = lines + row * (kLineFields * lanes);
    for (int v = 0; v < kCount; ++v) {
      const std::ptrdiff_t p = g.at(row) + column + v * lanes;
      const T* const at = node + v * pitch;
      const Lane3<T> f = right_side(v, p);
      w[v] = apply(load_line(at), i == 0 ? f : apply_add(load_line(at + outer_link), w[v], f));
      store3(w[v], g.q, p);
    }
  }
  const int meeting = meeting_row(g);
  for (int v = 0; v < kCount; ++v) {
    const T* const at = lines + meeting * (kLineFields * lanes) + v * pitch;
    const Lane3<T> f = half == 0 ? zero3<T>() : right_side(v, g.at(meeting) + column + v * lanes);
    store3(sweep.count == 0 ? f : apply_add(load_line(at + outer_link), w[v], f), g.meeting[half],
           column + v * lanes);
    g.partial[half * g.vectors + first + v] = kAdvance ? sum_of_lanes<T>(sum[v]) : 0.0;
  }
}

template <class T>
void solve_warp_in(const ImplicitGrid<T>& g, T alpha, int half, int begin, int end) {
  in_groups(begin, end, [&](int i, auto count) HWY_ATTR {
    if (alpha != T(0)) {
      warp_lines_in<decltype(count)::value, true>(g, alpha, half, i);
    } else {
      warp_lines_in<decltype(count)::value, false>(g, alpha, half, i);
    }
  });
}

/// From the meeting row, which both halves solve for, back to the end of the cloth.
template <int kCount, class T>
HWY_INLINE void warp_lines_out(const ImplicitGrid<T>& g, int half, int first) {
  const int lanes = lanes_of<T>(), meeting = meeting_row(g);
  const Sweep sweep = half_sweep(g, half);
  const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(first) * lanes;
  const T* const lines = g.warp_lines + g.warp_line(first, 0);
  const std::ptrdiff_t pitch = g.warp_line(1, 0), inner_link = sweep.step * 6 * lanes;
  Lane3<T> z[kCount];
  for (int v = 0; v < kCount; ++v) {
    const std::ptrdiff_t c = column + v * lanes;
    z[v] = apply(load_line(lines + meeting * (kLineFields * lanes) + v * pitch),
                 add(load3(g.meeting[0], c), load3(g.meeting[1], c)));
    if (half == 1) store3(z[v], g.q, g.at(meeting) + c);
  }
  for (int i = sweep.count - 1; i >= 0; --i) {
    const int row = sweep.first + i * sweep.step;
    const T* const node = lines + row * (kLineFields * lanes);
    for (int v = 0; v < kCount; ++v) {
      const std::ptrdiff_t p = g.at(row) + column + v * lanes;
      const T* const at = node + v * pitch;
      z[v] = apply_add(load_line(at), apply(load_line(at + inner_link), z[v]), load3(g.q, p));
      store3(z[v], g.q, p);
    }
  }
}

template <class T>
void solve_warp_out(const ImplicitGrid<T>& g, int half, int begin, int end) {
  in_groups(begin, end,
            [&](int i, auto count) HWY_ATTR { warp_lines_out<decltype(count)::value>(g, half, i); });
}

/// Vectors of weft lines beside one another: two keep the turned columns within the nearest cache.
inline constexpr int kWeftBeside = 2;

/// Numbers of scratch of the weft lines: the turned force and solution.
template <class T>
HWY_INLINE std::ptrdiff_t weft_scratch(const ImplicitGrid<T>& g) {
  return 3 * static_cast<std::ptrdiff_t>(g.stride) * g.lanes;
}

/// Turns `force` of a vector of rows into columns: three vectors a column, one after the other.
template <class T>
HWY_INLINE void turn_in(const ImplicitGrid<T>& g, int row, T* to) {
  const int lanes = g.lanes;
  for (int v = 0; v < g.vectors; ++v) {
    const std::ptrdiff_t p = g.at(row) + v * lanes;
    T* const first = to + v * 3 * lanes;
    const std::ptrdiff_t pitch = static_cast<std::ptrdiff_t>(g.vectors) * 3 * lanes;
    store_transposed<T>(g.force.x + p, g.stride, first, pitch);
    store_transposed<T>(g.force.y + p, g.stride, first + lanes, pitch);
    store_transposed<T>(g.force.z + p, g.stride, first + 2 * lanes, pitch);
  }
}

template <class T>
HWY_INLINE Lane3<T> load_turned(const T* at) {
  const int N = lanes_of<T>();
  return {load(at), load(at + N), load(at + 2 * N)};
}
template <class T>
HWY_INLINE void store_turned(const Lane3<T>& a, T* at) {
  const int N = lanes_of<T>();
  store(a.x, at);
  store(a.y, at + N);
  store(a.z, at + 2 * N);
}

template <int kCount, class T>
HWY_INLINE void solve_weft_lines(const ImplicitGrid<T>& g, int first, T* turned) {
  const int lanes = lanes_of<T>();
  const T* const lines = g.weft_lines + g.weft_line(first, 0);
  const std::ptrdiff_t pitch = g.weft_line(1, 0), next = weft_scratch(g);
  Lane3<T> w[kCount];
  for (int v = 0; v < kCount; ++v) w[v] = zero3<T>();
  for (int c = 0; c < g.columns; ++c) {
    for (int v = 0; v < kCount; ++v) {
      const T* const at = lines + c * (kLineFields * lanes) + v * pitch;
      T* const to = turned + v * next + c * 3 * lanes;
      const Lane3<T> f = load_turned(to);
      w[v] = apply(load_line(at), c == 0 ? f : apply_add(load_line(at - 6 * lanes), w[v], f));
      store_turned(w[v], to);
    }
  }
  for (int c = g.columns - 2; c >= 0; --c) {
    for (int v = 0; v < kCount; ++v) {
      const T* const at = lines + c * (kLineFields * lanes) + v * pitch;
      T* const to = turned + v * next + c * 3 * lanes;
      w[v] = apply_add(load_line(at), apply(load_line(at + 6 * lanes), w[v]), load_turned<T>(to));
      store_turned(w[v], to);
    }
  }
}

/// q = (q + turned) / 2 in a vector of rows, and their sums of force.q.
template <class T>
HWY_INLINE void turn_back(const ImplicitGrid<T>& g, int row, const T* turned) {
  const int lanes = g.lanes;
  HWY_ALIGN T tile[3][kTile<T> * kTile<T>];
  Lane<T> sums[kTile<T>];
  for (int j = 0; j < lanes; ++j) sums[j] = hn::Zero(Tag<T>());
  const int kept = std::min(lanes, g.rows - row);
  for (int v = 0; v < g.vectors; ++v) {
    const T* const first = turned + v * 3 * lanes;
    const std::ptrdiff_t pitch = static_cast<std::ptrdiff_t>(g.vectors) * 3 * lanes;
    for (int f = 0; f < 3; ++f) store_transposed<T>(first + f * lanes, pitch, tile[f], lanes);
    for (int j = 0; j < kept; ++j) {
      const std::ptrdiff_t p = g.at(row + j) + v * lanes;
      const Lane3<T> weft = {load(tile[0] + j * lanes), load(tile[1] + j * lanes), load(tile[2] + j * lanes)};
      const Lane3<T> z = scale(set(T(0.5)), add(weft, load3(g.q, p)));
      store3(z, g.q, p);
      sums[j] = add_dot<T>(z, load3(g.force, p), sums[j]);
    }
  }
  for (int j = 0; j < kept; ++j) g.partial[row + j] = sum_of_lanes<T>(sums[j]);
}

template <class T>
void solve_weft_vectors(const ImplicitGrid<T>& g, T* scratch, int begin, int end) {
  const auto work = [&](int i, auto count) HWY_ATTR {
    constexpr int kCount = decltype(count)::value;
    for (int v = 0; v < kCount; ++v) turn_in(g, (i + v) * g.lanes, scratch + v * weft_scratch(g));
    solve_weft_lines<kCount>(g, i, scratch);
    for (int v = 0; v < kCount; ++v) turn_back<T>(g, (i + v) * g.lanes, scratch + v * weft_scratch(g));
  };
  int i = begin;
  for (; i + kWeftBeside <= end; i += kWeftBeside) work(i, std::integral_constant<int, kWeftBeside>());
  for (; i < end; ++i) work(i, std::integral_constant<int, 1>());
}

}  // namespace HWY_NAMESPACE
}  // namespace fuai
HWY_AFTER_NAMESPACE();
// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
#endif  // include guard of the instruction set
