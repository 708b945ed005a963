// Measures edges, cells and triples, and differentiates the measures.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/cloth_measures.h"

#include <Eigen/Geometry>

namespace fuai {
namespace {

/// An element counts as collapsed below this fraction of its natural size: far under any fold of real cloth,
/// far over what rounding of coordinates of a metre leaves of a spacing of a millimetre (2e-13).
constexpr double kCollapsed = 1e-9;

/// Low and high neighbour of a slot along weft (0) or warp (1); the slot itself where no yarn edge with cloth
/// leads to one.
std::array<std::size_t, 2> neighbours(const ClothModel& model, std::size_t slot, int direction) noexcept {
  const auto columns = static_cast<std::size_t>(model.columns), rows = static_cast<std::size_t>(model.rows);
  const std::size_t stride = direction == 0 ? 1 : columns;
  const std::size_t place = direction == 0 ? slot % columns : slot / columns;
  const std::size_t count = direction == 0 ? columns : rows;
  const std::vector<double>& edges = direction == 0 ? model.weft_edge_area : model.warp_edge_area;
  const bool low = place > 0 && edges[slot - stride] > 0.0;
  const bool high = place + 1 < count && edges[slot] > 0.0;
  return {low ? slot - stride : slot, high ? slot + stride : slot};
}

/// phi(t) = t (15 + 4 t2) / (15 + 9 t2) and its derivative (225 + 45 t2 + 36 t4) / (15 + 9 t2)2.
std::array<double, 2> half_angle(double t) noexcept {
  const double t2 = t * t, below = 15.0 + 9.0 * t2;
  return {t * (15.0 + 4.0 * t2) / below, (225.0 + t2 * (45.0 + 36.0 * t2)) / (below * below)};
}

/// The arc sine to the seventh power and its derivative.
std::array<double, 2> shear_angle(double s) noexcept {
  const double s2 = s * s;
  return {s * (1.0 + s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0 + s2 * 5.0 / 112.0))),
          1.0 + s2 * (1.0 / 2.0 + s2 * (3.0 / 8.0 + s2 * 5.0 / 16.0))};
}

}  // namespace

EdgeMeasure measure_edge(const Vec3& x0, const Vec3& x1, double spacing) noexcept {
  EdgeMeasure edge;
  const Vec3 d = x1 - x0;
  const double length = d.norm();
  if (!(length > kCollapsed * spacing)) return edge;
  edge.strain = length / spacing - 1.0;
  edge.direction = d / length;
  edge.valid = true;
  return edge;
}

CellMeasure measure_cell(const ClothModel& model, std::span<const Vec3> x, std::size_t slot) noexcept {
  const auto up = static_cast<std::size_t>(model.columns);
  const Vec3 &x00 = x[slot], &x10 = x[slot + 1], &x01 = x[slot + up], &x11 = x[slot + up + 1];
  const double scale = 0.5 / model.spacing;
  const Vec3 a = scale * (x10 + x11 - x00 - x01), b = scale * (x01 + x11 - x00 - x10);
  const double a_length = a.norm(), b_length = b.norm();
  CellMeasure cell;
  if (!(a_length > kCollapsed && b_length > kCollapsed)) return cell;
  // s = a.b / (|a||b|);  ds = (b^ - s a^).da / |a| + (a^ - s b^).db / |b|
  const Vec3 a_unit = a / a_length, b_unit = b / b_length;
  const double s = a_unit.dot(b_unit);
  const auto [angle, by_s] = shear_angle(s);
  cell.angle = angle;
  cell.by_weft = by_s / a_length * (b_unit - s * a_unit);
  cell.by_warp = by_s / b_length * (a_unit - s * b_unit);
  cell.valid = true;
  return cell;
}

Vec3 twist_vector(const ClothModel& model, std::span<const Vec3> x, std::size_t slot) noexcept {
  const auto up = static_cast<std::size_t>(model.columns);
  return x[slot + up + 1] - x[slot + 1] - x[slot + up] + x[slot];
}

BendMeasure measure_bend(const ClothModel& model, std::span<const Vec3> x, std::size_t slot) noexcept {
  BendMeasure bend;
  const std::array<double, 2> area{model.weft_bend_area[slot], model.warp_bend_area[slot]};
  const std::array<double, 2> bend_length{model.weft_bend_length[slot], model.warp_bend_length[slot]};
  for (std::size_t i = 0; i < 2; ++i) {
    bend.ends[i] = neighbours(model, slot, static_cast<int>(i));
    const auto [low, high] = bend.ends[i];
    bend.tangent[i] = x[high] - x[low];
    bend.length[i] = bend.tangent[i].norm();
    bend.bends[i] = area[i] > 0.0 && low != slot && high != slot;
    bend.second[i] = bend.bends[i] ? Vec3(x[high] - 2.0 * x[slot] + x[low]) : Vec3::Zero();
  }
  const Vec3 N = bend.tangent[0].cross(bend.tangent[1]);
  bend.normal_length = N.norm();
  const double least = kCollapsed * model.spacing;
  if (!(bend.length[0] > least && bend.length[1] > least &&
        bend.normal_length > kCollapsed * bend.length[0] * bend.length[1])) {
    return bend;
  }
  bend.normal = N / bend.normal_length;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!bend.bends[i]) continue;
    bend.slope[i] = bend.normal.dot(bend.second[i]) / bend.length[i];
    const auto [phi, by_t] = half_angle(bend.slope[i]);
    bend.curvature[i] = 2.0 / bend_length[i] * phi;
    bend.by_slope[i] = 2.0 / bend_length[i] * by_t;
  }
  bend.valid = true;
  return bend;
}

BendGradient bend_gradient(const BendMeasure& bend, const std::array<double, 2>& weights) noexcept {
  // dt_i = (n.dD_i + dn.D_i) / |T_i| - t_i T_i.dT_i / |T_i|^2, and with dn = (1 - n n^T) dN / |N|
  // dn.D_i = q_i.dN, q_i = (D_i - n (n.D_i)) / |N|.  The normal gathers q = sum c_i q_i / |T_i|, and
  // dN = dT1 x T2 + T1 x dT2 gives q.dN = dT1.(T2 x q) + dT2.(q x T1).
  BendGradient gradient;
  Vec3 q = Vec3::Zero();
  for (std::size_t i = 0; i < 2; ++i) {
    const double c = weights[i] * bend.by_slope[i];  // of t_i
    const double length = bend.length[i];
    gradient.by_second[i] = c / length * bend.normal;
    gradient.by_tangent[i] = -c * bend.slope[i] / (length * length) * bend.tangent[i];
    const Vec3 in_plane = bend.second[i] - bend.normal.dot(bend.second[i]) * bend.normal;
    q += c / (length * bend.normal_length) * in_plane;
  }
  gradient.by_tangent[0] += bend.tangent[1].cross(q);
  gradient.by_tangent[1] += q.cross(bend.tangent[0]);
  return gradient;
}

}  // namespace fuai
