// Vectors of three components in lanes, and the play law in lanes; included once per instruction set.
// SPDX-License-Identifier: Apache-2.0
#if defined(FUAI_IMPLICIT_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FUAI_IMPLICIT_LANES_INL_H_
#undef FUAI_IMPLICIT_LANES_INL_H_
#else
#define FUAI_IMPLICIT_LANES_INL_H_
#endif

#include <cstddef>

#include "fuai/solver/implicit_grid.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fuai {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class T>
using Tag = hn::ScalableTag<T>;
template <class T>
using Lane = hn::Vec<Tag<T>>;

template <class T>
HWY_INLINE int lanes_of() {
  return static_cast<int>(hn::Lanes(Tag<T>()));
}
template <class T>
HWY_INLINE Lane<T> set(T value) {
  return hn::Set(Tag<T>(), value);
}
template <class T>
HWY_INLINE Lane<T> load(const T* from) {
  return hn::LoadU(Tag<T>(), from);
}
template <class T>
HWY_INLINE void store(Lane<T> value, T* to) {
  hn::StoreU(value, Tag<T>(), to);
}

/// A vector of R^3 in every lane.
template <class T>
struct Lane3 {
  Lane<T> x, y, z;
};

template <class T>
HWY_INLINE Lane3<T> load3(const Field3<T>& field, std::ptrdiff_t at) {
  return {load(field.x + at), load(field.y + at), load(field.z + at)};
}
template <class T>
HWY_INLINE void store3(const Lane3<T>& value, const Field3<T>& field, std::ptrdiff_t at) {
  store(value.x, field.x + at);
  store(value.y, field.y + at);
  store(value.z, field.z + at);
}
template <class T>
HWY_INLINE Lane3<T> zero3() {
  const Lane<T> zero = hn::Zero(Tag<T>());
  return {zero, zero, zero};
}
template <class T>
HWY_INLINE Lane3<T> add(const Lane3<T>& a, const Lane3<T>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class T>
HWY_INLINE Lane3<T> sub(const Lane3<T>& a, const Lane3<T>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class T, class V>
HWY_INLINE Lane3<T> scale(V s, const Lane3<T>& a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
/// s a + b
template <class T, class V>
HWY_INLINE Lane3<T> mul_add(V s, const Lane3<T>& a, const Lane3<T>& b) {
  return {hn::MulAdd(s, a.x, b.x), hn::MulAdd(s, a.y, b.y), hn::MulAdd(s, a.z, b.z)};
}
/// b - s a
template <class T, class V>
HWY_INLINE Lane3<T> neg_mul_add(V s, const Lane3<T>& a, const Lane3<T>& b) {
  return {hn::NegMulAdd(s, a.x, b.x), hn::NegMulAdd(s, a.y, b.y), hn::NegMulAdd(s, a.z, b.z)};
}
template <class T>
HWY_INLINE auto dot(const Lane3<T>& a, const Lane3<T>& b) {
  return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
template <class T>
HWY_INLINE Lane3<T> cross(const Lane3<T>& a, const Lane3<T>& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

/// Squared lengths below this count as this, so that a collapsed element gives no force instead of NaN [m2].
template <class T>
inline constexpr T kLeastSquare = T(1e-18);

/// 1 / sqrt(square), finite for a collapsed element.
template <class T>
HWY_INLINE Lane<T> inverse_length(Lane<T> square) {
  return hn::Div(set(T(1)), hn::Sqrt(hn::Max(square, set(kLeastSquare<T>))));
}

/// Stress and tangent of a play law.
template <class T>
struct LaneResponse {
  Lane<T> stress, tangent;
};

/// PlayLaw::evaluate in lanes. @param memory one array a play element  @param at number of the first lane
template <class T>
HWY_INLINE LaneResponse<T> evaluate_law(const LawTableView<T>& law, Lane<T> strain, T* const* memory,
                                        std::ptrdiff_t at) {
  const Tag<T> d;
  const hn::RebindToSigned<Tag<T>> di;
  const Lane<T> zero = hn::Zero(d);
  // Friction first: its loop needs no table.
  Lane<T> S = zero, stick = zero;
  for (int j = 0; j < law.plays; ++j) {
    const Lane<T> s = hn::Mul(hn::Sub(strain, load(memory[j] + at)), set(law.inverse_radius[j]));
    const Lane<T> held = hn::Min(hn::Max(s, set(T(-1))), set(T(1)));
    const Lane<T> w = set(law.weight[j]);
    S = hn::MulAdd(w, held, S);
    stick = hn::Add(stick, hn::IfThenElseZero(hn::Eq(s, held), hn::Mul(w, set(law.inverse_radius[j]))));
  }
  // Where the strain lies on the table: u, the piece's number and the strain beyond its start.
  const Lane<T> inner =
      hn::Min(hn::Max(hn::Mul(hn::Sub(strain, set(law.low)), set(law.inverse_step)), zero), set(law.count));
  const Lane<T> above = hn::Max(hn::Mul(hn::Sub(strain, set(law.high)), set(law.inverse_step_high)), zero);
  const Lane<T> below = hn::Max(hn::Mul(hn::Sub(set(law.low), strain), set(law.inverse_step_low)), zero);
  const Lane<T> u = hn::Sub(hn::Add(inner, above), below);
  const Lane<T> piece = hn::Min(hn::Max(hn::Floor(u), set(law.first_index)), set(law.last_index));
  const auto is_above = hn::Ge(piece, set(law.count));
  const auto is_below = hn::Lt(piece, zero);
  const Lane<T> step = hn::IfThenElse(is_above, set(law.step_high),
                                      hn::IfThenElse(is_below, set(law.step_low), set(law.step)));
  const Lane<T> beyond = hn::Mul(hn::Sub(u, piece), step);
  const auto index = hn::ShiftLeft<2>(hn::ConvertTo(di, piece));
  const Lane<T> F = hn::GatherIndex(d, law.pieces, index);
  const Lane<T> dF = hn::GatherIndex(d, law.pieces + 1, index);
  const Lane<T> Y = hn::GatherIndex(d, law.pieces + 2, index);
  const Lane<T> dY = hn::GatherIndex(d, law.pieces + 3, index);
  const Lane<T> strength = hn::MulAdd(dY, beyond, Y);
  return {hn::MulAdd(strength, S, hn::MulAdd(dF, beyond, F)),
          hn::MulAdd(strength, stick, hn::MulAdd(dY, S, dF))};
}

/// Sum of the products of two vectors over the lanes, added to a running sum in lanes.
template <class T>
HWY_INLINE Lane<T> add_dot(const Lane3<T>& a, const Lane3<T>& b, Lane<T> sum) {
  return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::MulAdd(a.x, b.x, sum)));
}
template <class T>
HWY_INLINE double sum_of_lanes(Lane<T> value) {
  return static_cast<double>(hn::GetLane(hn::SumOfLanes(Tag<T>(), value)));
}

}  // namespace HWY_NAMESPACE
}  // namespace fuai
HWY_AFTER_NAMESPACE();
#endif  // include guard of the instruction set
