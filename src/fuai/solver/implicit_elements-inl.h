// Elements of the cloth in lanes: gradients, strains and linearisation; included once per instruction set.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/engine.md (energies and symbols), docs/theory/implicit-step.md (linearisation).
#if defined(FUAI_IMPLICIT_ELEMENTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FUAI_IMPLICIT_ELEMENTS_INL_H
#undef FUAI_IMPLICIT_ELEMENTS_INL_H
#else
#define FUAI_IMPLICIT_ELEMENTS_INL_H
#endif

#include "fuai/solver/implicit_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fuai {
namespace HWY_NAMESPACE {

/// The five nodes of a cross and the element they belong to.
template <class T>
struct Cross {
  Lane3<T> weft_next, weft_back, warp_next, warp_back;  ///< edge vectors along the yarns, growing index
};

/// Secants are taken to at least this strain [-]: below it friction at zero strain would make them endless.
/// Ten times more lets the cupro's slack edges hunt again, see docs/theory/implicit-step.md.
template <class T>
inline constexpr T kLeastSecantStrain = T(2e-4);

/// Tension of the edge `e`: gradient on its far node; strain; linearisation.
template <class T>
struct Tension {
  Lane3<T> gradient, axis;
  Lane<T> strain, side;
};
template <class T>
HWY_INLINE Tension<T> tension(const ImplicitConstants<T>& k, const LawTableView<T>& law, T* const* memory,
                              std::ptrdiff_t at, const Lane3<T>& e, Lane<T> area, Lane<T> rate,
                              Lane<T> strain_n) {
  const Lane<T> square = hn::Max(dot(e, e), set(T(1e-6) * k.h * k.h));
  const Lane<T> per_metre = inverse_root<T>(square);
  const Lane<T> length = hn::Mul(square, per_metre);
  const Lane3<T> u = scale(per_metre, e);
  Tension<T> t;
  t.strain = hn::MulSub(length, set(k.inverse_h), set(T(1)));
  const LaneResponse<T> r = evaluate_law(law, t.strain, memory, at);
  const Lane<T> stress = hn::MulAdd(rate, hn::Sub(t.strain, strain_n), r.stress);
  const Lane<T> per_length = hn::Mul(area, set(k.inverse_h));
  t.gradient = scale(hn::Mul(per_length, stress), u);
  // Along the yarn the tangent, across it the tension over the length; both not negative.
  t.side = hn::Max(hn::Mul(hn::Mul(per_length, stress), per_metre), hn::Zero(Tag<T>()));
  // Where the law softens (slack, a measured toe) its tangent promises less stiffness than the edge shows a
  // moment later, and the step would hunt to and fro; the secant to zero strain bounds it.
  const Lane<T> secant =
      hn::Mul(hn::Abs(r.stress), inverse<T>(hn::Max(hn::Abs(t.strain), set(kLeastSecantStrain<T>))));
  const Lane<T> along =
      hn::Mul(hn::Mul(per_length, set(k.inverse_h)), hn::Add(hn::Max(r.tangent, secant), rate));
  t.axis = scale(root<T>(hn::Sub(along, t.side)), u);
  return t;
}

/// One direction of bending at a node: how the curvature depends on D and T.
template <class T>
struct Curvature {
  Lane3<T> D, chord;
  Lane<T> inverse_chord, t, kappa, slope;  ///< slope = d kappa / d t
};
template <class T>
HWY_INLINE Curvature<T> curvature(const ImplicitConstants<T>& k, const Lane3<T>& D, const Lane3<T>& chord,
                                  const Lane3<T>& n, Lane<T> curve) {
  Curvature<T> c;
  c.D = D;
  c.chord = chord;
  c.inverse_chord = inverse_root<T>(hn::Max(dot(chord, chord), set(T(4e-4) * k.h * k.h)));
  c.t = hn::Mul(dot(n, D), c.inverse_chord);
  const Lane<T> t2 = hn::Mul(c.t, c.t);
  const Lane<T> below = inverse<T>(hn::MulAdd(set(T(9)), t2, set(T(15))));
  c.kappa = hn::Mul(curve, hn::Mul(hn::Mul(c.t, hn::MulAdd(set(T(4)), t2, set(T(15)))), below));
  const Lane<T> top = hn::MulAdd(hn::MulAdd(set(T(36)), t2, set(T(45))), t2, set(T(225)));
  c.slope = hn::Mul(curve, hn::Mul(top, hn::Mul(below, below)));
  return c;
}

/// 1 where the area is positive, else 0.
template <class T>
HWY_INLINE Lane<T> has_cloth(Lane<T> area) {
  return hn::IfThenElseZero(hn::Gt(area, hn::Zero(Tag<T>())), set(T(1)));
}

/// Bending of a row at one block of columns: gradients into U and L, strains, linearisation.
template <class T>
struct BendBlock {
  Lane3<T> normal;
  Lane3<T> U1, L1, U2, L2;
  Lane<T> kappa1, kappa2, stiff1, stiff2, cross, fold1, fold2;
};
template <class T>
HWY_INLINE BendBlock<T> bend(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, const Place<T>& at,
                             const Cross<T>& edges) {
  const Lane<T> zero = hn::Zero(Tag<T>());
  // A neighbour is one that a yarn edge with cloth leads to; the last slot of a row has none of the next row.
  const std::ptrdiff_t p = at.p;
  const Lane<T> e_next = has_cloth<T>(load(g.weft_edge + p)), e_back = has_cloth<T>(at.west(g.weft_edge));
  const Lane<T> n_next = has_cloth<T>(load(g.warp_edge + p));
  const Lane<T> n_back = has_cloth<T>(load(g.warp_edge + p - g.stride));
  const Lane3<T> a1 = scale(e_next, edges.weft_next), b1 = scale(e_back, edges.weft_back);
  const Lane3<T> a2 = scale(n_next, edges.warp_next), b2 = scale(n_back, edges.warp_back);
  const Lane3<T> T1 = add(a1, b1), T2 = add(a2, b2);
  const Lane3<T> N = cross(T1, T2);
  const Lane<T> inverse_N = inverse_root<T>(hn::Max(dot(N, N), set(T(1e-6) * k.h * k.h * k.h * k.h)));
  const Lane3<T> n = scale(inverse_N, N);
  const Curvature<T> c1 = curvature(k, sub(a1, b1), T1, n, load(g.weft_curve + p));
  const Curvature<T> c2 = curvature(k, sub(a2, b2), T2, n, load(g.warp_curve + p));
  const LaneResponse<T> r1 = evaluate_law(k.weft_bending, c1.kappa, g.memory_weft_bending, p);
  const LaneResponse<T> r2 = evaluate_law(k.warp_bending, c2.kappa, g.memory_warp_bending, p);
  const Lane<T> A1 = load(g.weft_bend + p), A2 = load(g.warp_bend + p);
  Lane<T> M1 = hn::Mul(A1, r1.stress), M2 = hn::Mul(A2, r2.stress);
  Lane<T> K1 = hn::Mul(A1, hn::Max(r1.tangent, zero)), K2 = hn::Mul(A2, hn::Max(r2.tangent, zero));
  Lane<T> K12 = zero;
  if (k.poisson_bending != T(0)) {
    // Both curvatures known: coupled. Only one (a free edge): the other relaxes, which softens this one.
    K12 = hn::Mul(hn::Min(A1, A2), set(k.poisson_bending));
    const Lane<T> soft1 = hn::IfThenElseZero(hn::Eq(A2, zero), hn::Mul(A1, set(k.free_edge_weft)));
    const Lane<T> soft2 = hn::IfThenElseZero(hn::Eq(A1, zero), hn::Mul(A2, set(k.free_edge_warp)));
    M1 = hn::NegMulAdd(soft1, c1.kappa, hn::MulAdd(K12, c2.kappa, M1));
    M2 = hn::NegMulAdd(soft2, c2.kappa, hn::MulAdd(K12, c1.kappa, M2));
    K1 = hn::Max(hn::Sub(K1, soft1), zero);
    K2 = hn::Max(hn::Sub(K2, soft2), zero);
  }
  const Lane<T> m1 = hn::Mul(M1, c1.slope), m2 = hn::Mul(M2, c2.slope);
  const Lane<T> w1 = hn::Mul(m1, c1.inverse_chord), w2 = hn::Mul(m2, c2.inverse_chord);
  // dn = (1 - n n^T) dN / |N|
  const Lane3<T> lever = add(scale(w1, c1.D), scale(w2, c2.D));
  const Lane3<T> q = scale(inverse_N, neg_mul_add(dot(n, lever), n, lever));
  const Lane3<T> P1 = scale(w1, n), P2 = scale(w2, n);
  const Lane<T> s1 = hn::Mul(hn::Mul(w1, c1.t), c1.inverse_chord);
  const Lane<T> s2 = hn::Mul(hn::Mul(w2, c2.t), c2.inverse_chord);
  const Lane3<T> Q1 = neg_mul_add(s1, T1, cross(T2, q)), Q2 = neg_mul_add(s2, T2, cross(q, T1));
  BendBlock<T> block;
  block.normal = n;
  block.U1 = scale(e_next, add(P1, Q1));
  block.L1 = scale(e_back, sub(P1, Q1));
  block.U2 = scale(n_next, add(P2, Q2));
  block.L2 = scale(n_back, sub(P2, Q2));
  block.kappa1 = c1.kappa;
  block.kappa2 = c2.kappa;
  const Lane<T> f1 = hn::Mul(c1.slope, c1.inverse_chord), f2 = hn::Mul(c2.slope, c2.inverse_chord);
  block.stiff1 = hn::Mul(K1, hn::Mul(f1, f1));
  block.stiff2 = hn::Mul(K2, hn::Mul(f2, f2));
  const Lane<T> most = set(k.most_fold);
  // What is left out below (change of the chord, tilt of the normal) is what resists in a tight fold.
  const auto fold = [&](Lane<T> stiff, const Curvature<T>& c) HWY_ATTR {
    const Lane<T> bent = hn::Mul(dot(c.D, c.D), hn::Mul(c.inverse_chord, c.inverse_chord));
    const Lane<T> tight = hn::Max(hn::Sub(bent, set(T(0.25))), zero);
    return hn::Min(hn::Mul(hn::Add(stiff, stiff), tight), most);
  };
  block.fold1 = fold(block.stiff1, c1);
  block.fold2 = fold(block.stiff2, c2);
  block.stiff1 = hn::Min(block.stiff1, most);
  block.stiff2 = hn::Min(block.stiff2, most);
  block.cross = zero;
  if (k.poisson_bending != T(0)) {
    // Keep the 2 x 2 block positive semidefinite whatever the tangents are.
    const Lane<T> both = hn::Sqrt(hn::Mul(block.stiff1, block.stiff2));
    block.cross = hn::Min(hn::Max(hn::Mul(K12, hn::Mul(f1, f2)), hn::Neg(both)), both);
  }
  return block;
}

/// Shear and twist of the cells of one block.
template <class T>
struct CellBlock {
  Lane3<T> P, M, D, plus, minus;
  Lane<T> gamma;
};
template <class T>
HWY_INLINE CellBlock<T> cell(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k, const Place<T>& at) {
  const std::ptrdiff_t p = at.p;
  const Lane3<T> x00 = load3(g.x, p), x10 = at.east3(g.x);
  const Lane3<T> x01 = load3(g.x, p + g.stride), x11 = at.east3(g.x, g.stride);
  const Lane3<T> plus = sub(x11, x00), minus = sub(x10, x01);
  const Lane<T> half = set(T(0.5) * k.inverse_h);
  const Lane3<T> a = scale(half, add(plus, minus)), b = scale(half, sub(plus, minus));
  const Lane<T> floor = set(T(1e-6));
  const Lane<T> one = set(T(1));
  const Lane<T> inverse_a = inverse_root<T>(hn::Max(dot(a, a), floor));
  const Lane<T> inverse_b = inverse_root<T>(hn::Max(dot(b, b), floor));
  const Lane3<T> ua = scale(inverse_a, a), ub = scale(inverse_b, b);
  const Lane<T> s = dot(ua, ub), s2 = hn::Mul(s, s);
  // gamma = s + s^3/6 + 3 s^5/40 + 5 s^7/112 and its slope
  const Lane<T> series = hn::MulAdd(hn::MulAdd(set(T(5.0 / 112)), s2, set(T(3.0 / 40))), s2, set(T(1.0 / 6)));
  const Lane<T> slope_series = hn::MulAdd(hn::MulAdd(set(T(5.0 / 16)), s2, set(T(3.0 / 8))), s2, set(T(0.5)));
  CellBlock<T> block;
  block.gamma = hn::MulAdd(hn::Mul(s, s2), series, s);
  const Lane<T> slope = hn::MulAdd(s2, slope_series, one);
  const LaneResponse<T> r = evaluate_law(k.shear, block.gamma, g.memory_shear, p);
  const Lane<T> area = load(g.cell_area + p);
  const Lane3<T> ga = scale(hn::Mul(slope, inverse_a), neg_mul_add(s, ua, ub));
  const Lane3<T> gb = scale(hn::Mul(slope, inverse_b), neg_mul_add(s, ub, ua));
  const Lane3<T> gp = scale(half, add(ga, gb)), gm = scale(half, sub(ga, gb));
  const Lane<T> weight = hn::Mul(area, r.stress);
  block.P = scale(weight, gp);
  block.M = scale(weight, gm);
  block.D = scale(hn::Mul(load(g.twist_area + p), set(k.twist)), sub(add(x11, x00), add(x10, x01)));
  const Lane<T> weight_root = root<T>(hn::Mul(area, r.tangent));
  block.plus = scale(weight_root, gp);
  block.minus = scale(weight_root, gm);
  return block;
}

/// Inertia, weight and air of a block; writes the ground stiffness when linearising.
template <bool kLinearise, class T>
HWY_INLINE Lane3<T> outer_force(const ImplicitGrid<T>& g, const ImplicitConstants<T>& k,
                                const ImplicitStepConstants<T>& s, std::ptrdiff_t p, const Lane3<T>& x,
                                const Lane3<T>& n) {
  const Lane<T> zero = hn::Zero(Tag<T>());
  const Lane3<T> xn = load3(g.xn, p), v = load3(g.v, p);
  const Lane3<T> w = mul_add(set(s.past_dt), load3(g.a, p), v);
  const Lane3<T> push = {hn::Add(w.x, set(s.gravity_dt[0])), hn::Add(w.y, set(s.gravity_dt[1])),
                         hn::Add(w.z, set(s.gravity_dt[2]))};
  const Lane3<T> moved = sub(x, xn);
  const Lane<T> area = load(g.node_area + p);
  const Lane<T> inertia = hn::Mul(hn::Max(area, zero), set(k.areal_mass * s.inertia));
  Lane3<T> force = scale(inertia, sub(scale(set(s.velocity_gain), push), moved));
  if (g.air == nullptr) {
    if constexpr (kLinearise) store(inertia, g.ground + p);
    return force;
  }
  const Lane3<T> slip = {hn::Sub(moved.x, set(s.wind_dt[0])), hn::Sub(moved.y, set(s.wind_dt[1])),
                         hn::Sub(moved.z, set(s.wind_dt[2]))};
  const Lane3<T> against = {hn::NegMulAdd(set(s.wind_dt[0]), set(s.inverse_dt), v.x),
                            hn::NegMulAdd(set(s.wind_dt[1]), set(s.inverse_dt), v.y),
                            hn::NegMulAdd(set(s.wind_dt[2]), set(s.inverse_dt), v.z)};
  const Lane<T> rate = hn::Mul(hn::Abs(area), set(s.inverse_dt));
  const Lane<T> speed_n = dot(n, against);
  const Lane<T> speed_t2 = hn::Max(hn::NegMulAdd(speed_n, speed_n, dot(against, against)), zero);
  const Lane<T> tangential = hn::Mul(hn::Mul(rate, set(k.air_tangential)), root<T>(speed_t2));
  const Lane<T> across = hn::Mul(hn::Mul(rate, set(k.air_normal)), hn::Abs(speed_n));
  const Lane<T> extra = hn::Max(hn::Sub(across, tangential), zero);
  force = neg_mul_add(tangential, slip, force);
  force = neg_mul_add(hn::Mul(extra, dot(n, slip)), n, force);
  if constexpr (kLinearise) {
    store(hn::Add(inertia, tangential), g.ground + p);
    store(extra, g.air + p);
  }
  return force;
}

}  // namespace HWY_NAMESPACE
}  // namespace fuai
HWY_AFTER_NAMESPACE();
#endif  // include guard of the instruction set
