// Vectors of three components in lanes, and the play law in lanes; included once per instruction set.
// SPDX-License-Identifier: Apache-2.0
#if defined(FUAI_IMPLICIT_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FUAI_IMPLICIT_LANES_INL_H
#undef FUAI_IMPLICIT_LANES_INL_H
#else
#define FUAI_IMPLICIT_LANES_INL_H
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>
#include "fuai/solver/implicit_grid.h"

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
  return hn::Load(Tag<T>(), from);
}
template <class T>
HWY_INLINE void store(Lane<T> value, T* to) {
  hn::Store(value, Tag<T>(), to);
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
template <class T>
HWY_INLINE Lane3<T> negative(const Lane3<T>& a) {
  return {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)};
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

/// Moves lanes by one, round the end: `up` gives lane i what lane i - 1 held.
template <class T>
class Turn {
 public:
  HWY_INLINE Turn() {
    HWY_ALIGN Index up[kMost], down[kMost];
    const int lanes = lanes_of<T>();
    for (int i = 0; i < lanes; ++i) {
      up[i] = static_cast<Index>((i + lanes - 1) % lanes);
      down[i] = static_cast<Index>((i + 1) % lanes);
    }
    up_ = hn::SetTableIndices(Tag<T>(), up);
    down_ = hn::SetTableIndices(Tag<T>(), down);
  }
  HWY_INLINE Lane<T> up(Lane<T> a) const { return hn::TableLookupLanes(a, up_); }
  HWY_INLINE Lane<T> down(Lane<T> a) const { return hn::TableLookupLanes(a, down_); }
  HWY_INLINE Lane3<T> up(const Lane3<T>& a) const { return {up(a.x), up(a.y), up(a.z)}; }
  HWY_INLINE Lane3<T> down(const Lane3<T>& a) const { return {down(a.x), down(a.y), down(a.z)}; }

 private:
  using Index = hn::TFromD<hn::RebindToSigned<Tag<T>>>;
  static constexpr int kMost = static_cast<int>(kVectorBytes / sizeof(T));
  decltype(hn::SetTableIndices(Tag<T>(), static_cast<const Index*>(nullptr))) up_, down_;
};

/// A vector of a row, and the vectors of the nodes before and after along the weft.
template <class T>
struct Place {
  const Turn<T>& turn;
  std::ptrdiff_t row, p;  ///< numbers of the row's first vector and of this one
  std::ptrdiff_t end;     ///< of the row
  int lanes;

  HWY_INLINE Place(const ImplicitGrid<T>& g, const Turn<T>& t, int r, int vector)
      : turn(t),
        row(g.at(r)),
        p(row + static_cast<std::ptrdiff_t>(vector) * g.lanes),
        end(row + g.stride),
        lanes(g.lanes) {}
  HWY_INLINE Lane<T> west(const T* field, std::ptrdiff_t rows_up = 0) const {
    return p == row ? turn.up(load(field + end - lanes + rows_up)) : load(field + p - lanes + rows_up);
  }
  HWY_INLINE Lane<T> east(const T* field, std::ptrdiff_t rows_up = 0) const {
    return p + lanes == end ? turn.down(load(field + row + rows_up)) : load(field + p + lanes + rows_up);
  }
  HWY_INLINE Lane3<T> west3(const Field3<T>& f, std::ptrdiff_t rows_up = 0) const {
    return {west(f.x, rows_up), west(f.y, rows_up), west(f.z, rows_up)};
  }
  HWY_INLINE Lane3<T> east3(const Field3<T>& f, std::ptrdiff_t rows_up = 0) const {
    return {east(f.x, rows_up), east(f.y, rows_up), east(f.z, rows_up)};
  }
};

/// 1 where the nodes may move, else 0.
template <class T>
HWY_INLINE Lane<T> mobile(const ImplicitGrid<T>& g, std::ptrdiff_t p) {
  return hn::IfThenElseZero(hn::Gt(load(g.node_area + p), hn::Zero(Tag<T>())), set(T(1)));
}

/// 1 / sqrt(x) of a positive x: in float the processor's estimate and one Newton step, 1e-7 relative.
template <class T>
HWY_INLINE Lane<T> inverse_root(Lane<T> x) {
  if constexpr (sizeof(T) == 4) {
    const Lane<T> y = hn::ApproximateReciprocalSqrt(x);
    const Lane<T> half = hn::Mul(hn::Mul(set(T(0.5)), x), y);
    return hn::Mul(y, hn::NegMulAdd(half, y, set(T(1.5))));
  } else {
    return hn::Div(set(T(1)), hn::Sqrt(x));
  }
}
/// 1 / x, the same way.
template <class T>
HWY_INLINE Lane<T> inverse(Lane<T> x) {
  if constexpr (sizeof(T) == 4) {
    const Lane<T> y = hn::ApproximateReciprocal(x);
    return hn::Mul(y, hn::NegMulAdd(x, y, set(T(2))));
  } else {
    return hn::Div(set(T(1)), x);
  }
}
/// sqrt(x), 0 for what is not positive.
template <class T>
HWY_INLINE Lane<T> root(Lane<T> x) {
  const Lane<T> held = hn::Max(x, set(T(1e-30)));
  return hn::Mul(hn::Max(x, hn::Zero(Tag<T>())), inverse_root<T>(held));
}

/// The four numbers of a piece.
template <class T>
struct LanePiece {
  Lane<T> F, dF, Y, dY;
};
/// In float two numbers a look-up: half the accesses.
template <class T>
HWY_INLINE LanePiece<T> gather_piece(const T* pieces, hn::Vec<hn::RebindToSigned<Tag<T>>> index) {
  const Tag<T> d;
#if HWY_TARGET != HWY_SCALAR
  if constexpr (sizeof(T) == 4) {
    const hn::Repartition<std::uint64_t, Tag<T>> d2;
    const hn::RebindToSigned<decltype(d2)> di2;
    const auto low = hn::ShiftLeft<1>(hn::PromoteTo(di2, hn::LowerHalf(index)));
    const auto high =
        hn::ShiftLeft<1>(hn::PromoteTo(di2, hn::UpperHalf(hn::Half<hn::RebindToSigned<Tag<T>>>(), index)));
    const auto* pairs = reinterpret_cast<const std::uint64_t*>(pieces);
    const auto F_low = hn::BitCast(d, hn::GatherIndex(d2, pairs, low));
    const auto F_high = hn::BitCast(d, hn::GatherIndex(d2, pairs, high));
    const auto Y_low = hn::BitCast(d, hn::GatherIndex(d2, pairs + 1, low));
    const auto Y_high = hn::BitCast(d, hn::GatherIndex(d2, pairs + 1, high));
    return {hn::ConcatEven(d, F_high, F_low), hn::ConcatOdd(d, F_high, F_low),
            hn::ConcatEven(d, Y_high, Y_low), hn::ConcatOdd(d, Y_high, Y_low)};
  }
#endif
  const auto at = hn::ShiftLeft<2>(index);
  return {hn::GatherIndex(d, pieces, at), hn::GatherIndex(d, pieces + 1, at),
          hn::GatherIndex(d, pieces + 2, at), hn::GatherIndex(d, pieces + 3, at)};
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
  const auto outside = hn::Or(hn::Lt(strain, set(law.low)), hn::Gt(strain, set(law.high)));
  if (law.straight && hn::AllFalse(d, outside)) {
    return {hn::MulAdd(set(law.strength), S, hn::MulAdd(set(law.slope), strain, set(law.offset))),
            hn::MulAdd(set(law.strength), stick, set(law.slope))};
  }
  // Where the strain lies on the table: u, the piece's number and the strain beyond its start.
  const Lane<T> inner =
      hn::Min(hn::Max(hn::Mul(hn::Sub(strain, set(law.low)), set(law.inverse_step)), zero), set(law.count));
  const Lane<T> above = hn::Max(hn::Mul(hn::Sub(strain, set(law.high)), set(law.inverse_step_high)), zero);
  const Lane<T> below = hn::Max(hn::Mul(hn::Sub(set(law.low), strain), set(law.inverse_step_low)), zero);
  const Lane<T> u = hn::Sub(hn::Add(inner, above), below);
  const Lane<T> number = hn::Min(hn::Max(hn::Floor(u), set(law.first_index)), set(law.last_index));
  const auto is_above = hn::Ge(number, set(law.count));
  const auto is_below = hn::Lt(number, zero);
  const Lane<T> step = hn::IfThenElse(is_above, set(law.step_high),
                                      hn::IfThenElse(is_below, set(law.step_low), set(law.step)));
  const Lane<T> beyond = hn::Mul(hn::Sub(u, number), step);
  const LanePiece<T> piece = gather_piece<T>(law.pieces, hn::ConvertTo(di, number));
  const Lane<T> strength = hn::MulAdd(piece.dY, beyond, piece.Y);
  return {hn::MulAdd(strength, S, hn::MulAdd(piece.dF, beyond, piece.F)),
          hn::MulAdd(strength, stick, hn::MulAdd(piece.dY, S, piece.dF))};
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
