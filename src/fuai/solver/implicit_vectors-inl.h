// Sums and updates of whole fields in lanes; included once per instruction set.
// SPDX-License-Identifier: Apache-2.0
#if defined(FUAI_IMPLICIT_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FUAI_IMPLICIT_VECTORS_INL_H
#undef FUAI_IMPLICIT_VECTORS_INL_H
#else
#define FUAI_IMPLICIT_VECTORS_INL_H
#endif

#include "fuai/solver/implicit_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fuai {
namespace HWY_NAMESPACE {

/// Calls for every vector of the rows.
template <class T, class Work>
HWY_INLINE void each(const ImplicitGrid<T>& g, int begin, int end, const Work& work) {
  for (std::ptrdiff_t p = g.at(begin), last = g.at(end); p < last; p += lanes_of<T>()) work(p);
}

/// The same with a sum a row: work(p, sum) returns the sum with what the vector adds.
template <class T, class Work>
HWY_INLINE void sum_each(const ImplicitGrid<T>& g, int begin, int end, const Work& work) {
  for (int row = begin; row < end; ++row) {
    Lane<T> sum = hn::Zero(Tag<T>());
    each(g, row, row + 1, [&](std::ptrdiff_t p) HWY_ATTR { sum = work(p, sum); });
    g.partial[row] = sum_of_lanes<T>(sum);
  }
}

template <class T>
void advance_rows(const ImplicitGrid<T>& g, T alpha, int begin, int end) {
  each(g, begin, end,
       [&](std::ptrdiff_t p) HWY_ATTR { store3(mul_add(set(alpha), load3(g.p, p), load3(g.d, p)), g.d, p); });
}

template <class T>
void direct_rows(const ImplicitGrid<T>& g, T alpha, T beta, int begin, int end) {
  each(g, begin, end, [&](std::ptrdiff_t p) HWY_ATTR {
    const Lane3<T> before = load3(g.p, p);
    store3(mul_add(set(alpha), before, load3(g.d, p)), g.d, p);
    store3(mul_add(set(beta), before, load3(g.q, p)), g.p, p);
  });
}

template <class T>
void begin_solve_rows(const ImplicitGrid<T>& g, int begin, int end) {
  sum_each(g, begin, end, [&](std::ptrdiff_t p, Lane<T> sum) HWY_ATTR {
    const Lane3<T> r = scale(mobile(g, p), load3(g.force, p));
    store3(r, g.force, p);
    store3(zero3<T>(), g.d, p);
    store3(zero3<T>(), g.p, p);
    return add_dot<T>(r, r, sum);
  });
}

template <class T>
void replace_rows(const ImplicitGrid<T>& g, T s, int begin, int end) {
  each(g, begin, end, [&](std::ptrdiff_t p) HWY_ATTR {
    const auto moves = hn::Gt(load(g.node_area + p), hn::Zero(Tag<T>()));
    const Lane3<T> x = load3(g.x, p), y = mul_add(set(s), load3(g.v, p), load3(g.xn, p));
    store3(Lane3<T>{hn::IfThenElse(moves, y.x, x.x), hn::IfThenElse(moves, y.y, x.y),
                    hn::IfThenElse(moves, y.z, x.z)},
           g.x, p);
  });
}

template <class T>
void keep_rows(const ImplicitGrid<T>& g, int begin, int end) {
  each(g, begin, end, [&](std::ptrdiff_t p) HWY_ATTR { store3(load3(g.x, p), g.xn, p); });
}

template <class T>
void scale_d_rows(const ImplicitGrid<T>& g, T s, int begin, int end) {
  each(g, begin, end, [&](std::ptrdiff_t p) HWY_ATTR { store3(scale(set(s), load3(g.d, p)), g.d, p); });
}

template <class T>
void stop_rows(const ImplicitGrid<T>& g, int begin, int end) {
  each(g, begin, end, [&](std::ptrdiff_t p) HWY_ATTR {
    store3(zero3<T>(), g.v, p);
    store3(zero3<T>(), g.a, p);
  });
}

template <class T>
void move_rows(const ImplicitGrid<T>& g, T s, int begin, int end) {
  each(g, begin, end,
       [&](std::ptrdiff_t p) HWY_ATTR { store3(mul_add(set(s), load3(g.d, p), load3(g.x, p)), g.x, p); });
}

template <class T>
HWY_INLINE void work_rows(const ImplicitGrid<T>& g, const Field3<T>& along, int begin, int end) {
  sum_each(g, begin, end, [&](std::ptrdiff_t p, Lane<T> sum) HWY_ATTR {
    return add_dot<T>(scale(mobile(g, p), load3(g.force, p)), load3(along, p), sum);
  });
}
template <class T>
void work_d_rows(const ImplicitGrid<T>& g, int begin, int end) {
  work_rows(g, g.d, begin, end);
}
template <class T>
void work_v_rows(const ImplicitGrid<T>& g, int begin, int end) {
  work_rows(g, g.v, begin, end);
}
template <class T>
void square_rows(const ImplicitGrid<T>& g, int begin, int end) {
  work_rows(g, g.force, begin, end);
}

template <class T>
void length_d_rows(const ImplicitGrid<T>& g, int begin, int end) {
  sum_each(g, begin, end, [&](std::ptrdiff_t p, Lane<T> sum) HWY_ATTR {
    const Lane3<T> d = load3(g.d, p);
    return add_dot<T>(d, d, sum);
  });
}

template <class T>
void finish_rows(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, const ImplicitStepConstants<T>& s,
                 int begin, int end) {
  const Lane<T> zero = hn::Zero(Tag<T>());
  const Lane3<T> gravity_dt = {set(s.gravity_dt[0]), set(s.gravity_dt[1]), set(s.gravity_dt[2])};
  for (int row = begin; row < end; ++row) {
    Lane<T> inner = zero, kinetic = zero, weight = zero;
    each(g, row, row + 1, [&](std::ptrdiff_t p) HWY_ATTR {
      const Lane3<T> x = load3(g.x, p), moved = sub(x, load3(g.xn, p));
      const Lane3<T> v0 = load3(g.v, p), a0 = load3(g.a, p), w = mul_add(set(s.past_dt), a0, v0);
      // What is held goes as it is moved: it has no acceleration of its own to remember.
      const Lane<T> free = mobile(g, p);
      const Lane<T> rate = hn::IfThenElse(hn::Gt(free, zero), set(s.inverse_reach), set(s.inverse_dt));
      const Lane<T> past = hn::Mul(free, set(s.past));
      const Lane3<T> v = sub(scale(rate, moved), scale(past, v0));
      const Lane3<T> a = scale(free, sub(scale(rate, sub(v, v0)), scale(past, a0)));
      const Lane<T> mass = hn::Mul(hn::Max(load(g.node_area + p), zero), set(k.areal_mass));
      // The force without inertia and weight: what the cloth itself does.
      const Lane3<T> push = sub(scale(set(s.velocity_gain), add(w, gravity_dt)), moved);
      const Lane3<T> force =
          neg_mul_add(hn::Mul(mass, set(s.inertia)), push, scale(mobile(g, p), load3(g.force, p)));
      inner = add_dot<T>(force, v, inner);
      kinetic = add_dot<T>(scale(mass, v), mul_add(set(s.past_dt), a, v), kinetic);
      weight = add_dot<T>(scale(mass, v), gravity_dt, weight);
      store3(v, g.v, p);
      store3(a, g.a, p);
      store3(x, g.xn, p);
    });
    g.partial[row] = sum_of_lanes<T>(inner);
    g.partial_kinetic[row] = sum_of_lanes<T>(kinetic);
    g.partial_weight[row] = sum_of_lanes<T>(weight);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fuai
HWY_AFTER_NAMESPACE();
#endif  // include guard of the instruction set
