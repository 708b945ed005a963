// Runs the inner loop of the relaxation. Plain loops over arrays: the compiler vectorises them.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/relaxation_kernel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fuai/core/assertion.h"

// The arrays of one loop never overlap; told to the compiler, this saves its checks.
#if defined(__clang__)
#define FUAI_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define FUAI_INDEPENDENT _Pragma("GCC ivdep")
#else
#define FUAI_INDEPENDENT
#endif

namespace fuai {
namespace {

/// Shorter edges count as this long [m]: coincident nodes give no force instead of a division by zero.
constexpr double kShortestLength = 1e-30;
/// |a + b| at theta = pi/4: beyond it Eq. (2) leaves the circle.
const double kSharpSum = 2.0 * std::cos(std::numbers::pi / 8.0);

inline Vec3 at(const KernelVectors& v, std::size_t i) { return {v.x[i], v.y[i], v.z[i]}; }

inline void add(KernelVectors& v, std::size_t i, const Vec3& value) {
  v.x[i] += value.x();
  v.y[i] += value.y();
  v.z[i] += value.z();
}

inline double larger(double a, double b) { return a > b ? a : b; }

}  // namespace

void RelaxationKernel::prepare(const LatticeModel& model, const SetUp& set_up) {
  nodes_ = model.rest_positions.size();
  pad_ = static_cast<std::size_t>(model.columns) + 1;
  const std::size_t size = nodes_ + 2 * pad_;
  leg_ = model.spacing;
  inverse_leg_ = 1.0 / leg_;
  as_printed_ = set_up.as_printed;
  for (KernelVectors* v : {&position_, &force_, &weight_, &normal_}) v->assign(size);
  mobility_.assign(size, 0.0);
  for (int node = 0; node < model.node_count(); ++node) {
    const auto n = static_cast<std::size_t>(node);
    const Vec3 weight = set_up.weight * (set_up.weigh_nodes ? model.tributary_factors[n] : 1.0);
    weight_.x[pad_ + n] = weight.x();
    weight_.y[pad_ + n] = weight.y();
    weight_.z[pad_ + n] = weight.z();
    mobility_[pad_ + n] = model.fixed[n] != 0 ? 0.0 : set_up.mobility;
  }
  const auto columns = static_cast<std::size_t>(model.columns);
  const std::array<std::size_t, 4> strides{1, columns, columns + 1, columns - 1};
  for (std::size_t g = 0; g < springs_.size(); ++g) {
    KernelSprings& springs = springs_[g];
    springs.stride = strides[g];
    springs.stiffness.assign(size, 0.0);
    springs.mask.assign(size, 0.0);
    springs.tension.assign(size);
  }
  for (const LatticeEdge& edge : model.edges) {
    const bool diagonal = edge.direction == Direction::kBias;
    std::size_t g = edge.direction == Direction::kWeft ? 0 : 1;
    if (diagonal) g = static_cast<std::size_t>(edge.second - edge.first) == columns + 1 ? 2 : 3;
    KernelSprings& springs = springs_[g];
    springs.rest_length = edge.rest_length;
    const double factor = set_up.weigh_stencils ? edge.tributary_factor : 1.0;
    springs.stiffness[padded(edge.first)] = factor * set_up.spring_stiffness;
    springs.mask[padded(edge.first)] = 1.0;
  }
  for (std::size_t d = 0; d < threads_.size(); ++d) {
    KernelThread& thread = threads_[d];
    thread = KernelThread{};
    for (KernelVectors* v :
         {&thread.unit, &thread.sum, &thread.bend, &thread.turn, &thread.gradient_p, &thread.gradient_r}) {
      v->assign(size);
    }
    for (auto* v : {&thread.inverse_length, &thread.sum_norm, &thread.on_face}) v->assign(size, 0.0);
    const Direction direction = d == 0 ? Direction::kWeft : Direction::kWarp;
    thread.table = BendTable(*set_up.laws[static_cast<std::size_t>(direction)]);
    for (const LatticeTriple& triple : model.triples) {
      if (triple.direction != direction) continue;
      thread.middle.push_back(padded(triple.middle));
      thread.weight.push_back(leg_ * leg_ * (set_up.weigh_stencils ? triple.tributary_factor : 1.0));
    }
    thread.memory.resize(thread.middle.size());
  }
}

void RelaxationKernel::load(const LatticeState& state) noexcept {
  FUAI_ASSERT(state.positions.size() == nodes_);
  FUAI_ASSERT(state.memory.size() == threads_[0].memory.size() + threads_[1].memory.size());
  for (std::size_t n = 0; n < nodes_; ++n) {
    position_.x[pad_ + n] = state.positions[n].x();
    position_.y[pad_ + n] = state.positions[n].y();
    position_.z[pad_ + n] = state.positions[n].z();
  }
  auto from = state.memory.begin();
  for (KernelThread& thread : threads_) {
    for (PlayState& memory : thread.memory) memory = *from++;
  }
}

void RelaxationKernel::store(LatticeState& state) const noexcept {
  for (std::size_t n = 0; n < nodes_; ++n) {
    state.positions[n] = {position_.x[pad_ + n], position_.y[pad_ + n], position_.z[pad_ + n]};
  }
  auto to = state.memory.begin();
  for (const KernelThread& thread : threads_) {
    for (const PlayState& memory : thread.memory) *to++ = memory;
  }
}

void RelaxationKernel::compute_springs(KernelSprings& springs, KernelThread* thread) noexcept {
  const std::size_t s = springs.stride, n = nodes_ - s;
  const double L = springs.rest_length;
  const double *x = position_.x.data() + pad_, *y = position_.y.data() + pad_, *z = position_.z.data() + pad_;
  const double* k = springs.stiffness.data() + pad_;
  double *tx = springs.tension.x.data() + pad_, *ty = springs.tension.y.data() + pad_,
         *tz = springs.tension.z.data() + pad_;
  if (thread == nullptr) {
    FUAI_INDEPENDENT
    for (std::size_t i = 0; i < n; ++i) {
      const double dx = x[i + s] - x[i], dy = y[i + s] - y[i], dz = z[i + s] - z[i];
      const double length = larger(std::sqrt(dx * dx + dy * dy + dz * dz), kShortestLength);
      const double t = k[i] * (length - L) / length;
      tx[i] = t * dx;
      ty[i] = t * dy;
      tz[i] = t * dz;
    }
    return;
  }
  const double* mask = springs.mask.data() + pad_;
  double *ux = thread->unit.x.data() + pad_, *uy = thread->unit.y.data() + pad_,
         *uz = thread->unit.z.data() + pad_;
  double* inverse = thread->inverse_length.data() + pad_;
  FUAI_INDEPENDENT
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = x[i + s] - x[i], dy = y[i + s] - y[i], dz = z[i + s] - z[i];
    const double length = larger(std::sqrt(dx * dx + dy * dy + dz * dz), kShortestLength);
    const double v = 1.0 / length, t = k[i] * (length - L), w = mask[i] * v;
    inverse[i] = v;
    ux[i] = w * dx;
    uy[i] = w * dy;
    uz[i] = w * dz;
    tx[i] = t * ux[i];
    ty[i] = t * uy[i];
    tz[i] = t * uz[i];
  }
}

void RelaxationKernel::compute_sums(KernelThread& thread, std::size_t stride) noexcept {
  const std::size_t s = stride, end = nodes_ - stride;
  const double *ux = thread.unit.x.data() + pad_, *uy = thread.unit.y.data() + pad_,
               *uz = thread.unit.z.data() + pad_;
  const double *nx = normal_.x.data() + pad_, *ny = normal_.y.data() + pad_, *nz = normal_.z.data() + pad_;
  double *ex = thread.sum.x.data() + pad_, *ey = thread.sum.y.data() + pad_, *ez = thread.sum.z.data() + pad_;
  double *norm = thread.sum_norm.data() + pad_, *face = thread.on_face.data() + pad_;
  FUAI_INDEPENDENT
  for (std::size_t i = s; i < end; ++i) {
    // a = -U[i-s], b = U[i]
    const double sx = ux[i] - ux[i - s], sy = uy[i] - uy[i - s], sz = uz[i] - uz[i - s];
    const double square = sx * sx + sy * sy + sz * sz;
    ex[i] = sx;
    ey[i] = sy;
    ez[i] = sz;
    norm[i] = std::sqrt(square);
    face[i] = sx * nx[i] + sy * ny[i] + sz * nz[i];
  }
}

Vec3 RelaxationKernel::energy_slope_as_printed(const KernelThread& thread, std::size_t triple) noexcept {
  const std::size_t i = thread.middle[triple];
  const double norm = thread.sum_norm[i], sign = thread.on_face[i] < 0.0 ? -1.0 : 1.0;
  const FoldFactor f = norm >= kSharpSum ? evaluate_fold_factor(norm) : FoldFactor{};
  const double moment = thread.table.as_printed(sign * norm * f.value * inverse_leg_);
  const double scale = moment * thread.weight[triple] * inverse_leg_ * (f.value + f.slope * norm);
  if (norm > kFlatSum) return sign * scale / norm * at(thread.sum, i);
  // Flat: the direction is the normal's.
  return scale * at(normal_, i).normalized();
}

Vec3 RelaxationKernel::energy_slope(KernelThread& thread, std::size_t triple) noexcept {
  // The algebra of evaluate_normal_gradient(), with N and e at hand.
  const std::size_t i = thread.middle[triple];
  const Vec3 e = at(thread.sum, i), N = at(normal_, i);
  const double norm = thread.sum_norm[i], length = std::sqrt(N.squaredNorm());
  const FoldFactor f = norm >= kSharpSum ? evaluate_fold_factor(norm) : FoldFactor{};
  const double inverse = length > kParallelTangents ? 1.0 / length : 0.0;
  const double area = thread.weight[triple], B = thread.table.in_plane_stiffness();
  const double kappa = f.value * thread.on_face[i] * inverse * inverse_leg_;
  const double c = inverse > 0.0 ? thread.table.advance(kappa, thread.memory[triple]) - B * kappa : 0.0;
  const Vec3 k = f.value * inverse_leg_ * e;
  const Vec3 V = B * k + (c * inverse) * N;
  Vec3 G = (area * f.value * inverse_leg_) * V;
  if (f.slope != 0.0) G += area * f.slope * inverse_leg_ * e.dot(V) / norm * e;
  // What turns the normal pulls at the four edges of the node.
  const Vec3 turn = (area * c * inverse) * (k - (kappa * inverse) * N);
  add(threads_[0].turn, i,
      (at(threads_[1].unit, i) + at(threads_[1].unit, i - springs_[1].stride)).cross(turn));
  add(threads_[1].turn, i, turn.cross((at(threads_[0].unit, i) + at(threads_[0].unit, i - 1))));
  return G;
}

void RelaxationKernel::compute_moments(KernelThread& thread) noexcept {
  const bool linear = !as_printed_ && thread.table.linear();
  const double stiffness = thread.table.in_plane_stiffness() * inverse_leg_ * inverse_leg_;
  const std::size_t count = thread.middle.size();
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t i = thread.middle[t];
    const bool sharp = thread.sum_norm[i] >= kSharpSum;
    sharp_fold_ = sharp_fold_ || sharp;
    if (linear && !sharp) {
      // dE/de of B K^2 / 2
      const double q = thread.weight[t] * stiffness;
      thread.bend.x[i] = q * thread.sum.x[i];
      thread.bend.y[i] = q * thread.sum.y[i];
      thread.bend.z[i] = q * thread.sum.z[i];
      continue;
    }
    const Vec3 slope = as_printed_ ? energy_slope_as_printed(thread, t) : energy_slope(thread, t);
    thread.bend.x[i] = slope.x();
    thread.bend.y[i] = slope.y();
    thread.bend.z[i] = slope.z();
  }
}

void RelaxationKernel::turn_edges(KernelThread& thread, KernelSprings& springs) noexcept {
  const std::size_t s = springs.stride, end = nodes_ - s;
  const double *qx = thread.turn.x.data() + pad_, *qy = thread.turn.y.data() + pad_,
               *qz = thread.turn.z.data() + pad_;
  const double *ux = thread.unit.x.data() + pad_, *uy = thread.unit.y.data() + pad_,
               *uz = thread.unit.z.data() + pad_;
  const double *inverse = thread.inverse_length.data() + pad_, *mask = springs.mask.data() + pad_;
  double *tx = springs.tension.x.data() + pad_, *ty = springs.tension.y.data() + pad_,
         *tz = springs.tension.z.data() + pad_;
  FUAI_INDEPENDENT
  for (std::size_t i = 0; i < end; ++i) {
    const double x = qx[i] + qx[i + s], y = qy[i] + qy[i + s], z = qz[i] + qz[i + s];
    const double along = x * ux[i] + y * uy[i] + z * uz[i], w = mask[i] * inverse[i];
    tx[i] += w * (x - along * ux[i]);
    ty[i] += w * (y - along * uy[i]);
    tz[i] += w * (z - along * uz[i]);
  }
}

void RelaxationKernel::compute_gradients(KernelThread& thread, std::size_t stride) noexcept {
  const std::size_t s = stride, end = nodes_ - stride;
  const double *gx = thread.bend.x.data() + pad_, *gy = thread.bend.y.data() + pad_,
               *gz = thread.bend.z.data() + pad_;
  const double *ux = thread.unit.x.data() + pad_, *uy = thread.unit.y.data() + pad_,
               *uz = thread.unit.z.data() + pad_;
  const double* inverse = thread.inverse_length.data() + pad_;
  double *px = thread.gradient_p.x.data() + pad_, *py = thread.gradient_p.y.data() + pad_,
         *pz = thread.gradient_p.z.data() + pad_;
  double *rx = thread.gradient_r.x.data() + pad_, *ry = thread.gradient_r.y.data() + pad_,
         *rz = thread.gradient_r.z.data() + pad_;
  // a = -U[i-s], b = U[i];  GP = (G - (G.a) a) / |PM|,  GR = (G - (G.b) b) / |MR|
  FUAI_INDEPENDENT
  for (std::size_t i = s; i < end; ++i) {
    const double a = gx[i] * ux[i - s] + gy[i] * uy[i - s] + gz[i] * uz[i - s];
    const double b = gx[i] * ux[i] + gy[i] * uy[i] + gz[i] * uz[i];
    px[i] = inverse[i - s] * (gx[i] - a * ux[i - s]);
    py[i] = inverse[i - s] * (gy[i] - a * uy[i - s]);
    pz[i] = inverse[i - s] * (gz[i] - a * uz[i - s]);
    rx[i] = inverse[i] * (gx[i] - b * ux[i]);
    ry[i] = inverse[i] * (gy[i] - b * uy[i]);
    rz[i] = inverse[i] * (gz[i] - b * uz[i]);
  }
}

void RelaxationKernel::gather() noexcept {
  // As printed the middle particle of a triple gets no reaction.
  const double reaction = as_printed_ ? 0.0 : 1.0;
  const auto component = [&](std::vector<double> KernelVectors::*c) {
    const auto data = [&](const KernelVectors& v) { return (v.*c).data() + pad_; };
    const double* weight = data(weight_);
    const double *t0 = data(springs_[0].tension), *t1 = data(springs_[1].tension),
                 *t2 = data(springs_[2].tension), *t3 = data(springs_[3].tension);
    const double *p0 = data(threads_[0].gradient_p), *r0 = data(threads_[0].gradient_r),
                 *p1 = data(threads_[1].gradient_p), *r1 = data(threads_[1].gradient_r);
    const std::ptrdiff_t s1 = static_cast<std::ptrdiff_t>(springs_[1].stride);
    double* f = (force_.*c).data() + pad_;
    const std::ptrdiff_t n = static_cast<std::ptrdiff_t>(nodes_);
    FUAI_INDEPENDENT
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const double spring =
          t0[i] - t0[i - 1] + (t1[i] - t1[i - s1]) + (t2[i] - t2[i - s1 - 1]) + (t3[i] - t3[i - s1 + 1]);
      const double ends = p0[i + 1] + r0[i - 1] + (p1[i + s1] + r1[i - s1]);
      f[i] = weight[i] + spring + (reaction * (p0[i] + r0[i] + (p1[i] + r1[i])) - ends);
    }
  };
  component(&KernelVectors::x);
  component(&KernelVectors::y);
  component(&KernelVectors::z);
}

void RelaxationKernel::compute_normals() noexcept {
  // Oriented: (sum of the two weft units) x (sum of the two warp units).
  const KernelVectors &u = threads_[0].unit, &v = threads_[1].unit;
  const std::size_t s = springs_[1].stride, begin = pad_, end = pad_ + nodes_;
  double *nx = normal_.x.data(), *ny = normal_.y.data(), *nz = normal_.z.data();
  FUAI_INDEPENDENT
  for (std::size_t i = begin; i < end; ++i) {
    const double ax = u.x[i] + u.x[i - 1], ay = u.y[i] + u.y[i - 1], az = u.z[i] + u.z[i - 1];
    const double bx = v.x[i] + v.x[i - s], by = v.y[i] + v.y[i - s], bz = v.z[i] + v.z[i - s];
    nx[i] = ay * bz - az * by;
    ny[i] = az * bx - ax * bz;
    nz[i] = ax * by - ay * bx;
  }
}

void RelaxationKernel::compute_forces() noexcept {
  sharp_fold_ = false;
  compute_springs(springs_[0], &threads_[0]);
  compute_springs(springs_[1], &threads_[1]);
  compute_springs(springs_[2], nullptr);
  compute_springs(springs_[3], nullptr);
  // Linear laws without friction need no normal.
  const bool turning = !as_printed_ && !(threads_[0].table.linear() && threads_[1].table.linear());
  if (turning || as_printed_) compute_normals();
  if (turning) {
    for (KernelThread& thread : threads_) {
      for (auto* q : {&thread.turn.x, &thread.turn.y, &thread.turn.z}) std::fill(q->begin(), q->end(), 0.0);
    }
  }
  for (std::size_t d = 0; d < threads_.size(); ++d) {
    compute_sums(threads_[d], springs_[d].stride);
    compute_moments(threads_[d]);
    compute_gradients(threads_[d], springs_[d].stride);
  }
  if (turning) {
    for (std::size_t d = 0; d < threads_.size(); ++d) turn_edges(threads_[d], springs_[d]);
  }
  gather();
}

void RelaxationKernel::move() noexcept {
  const std::size_t begin = pad_, end = pad_ + nodes_;
  const auto component = [&](std::vector<double>& position, const std::vector<double>& force) {
    double* x = position.data();
    const double *f = force.data(), *m = mobility_.data();
    FUAI_INDEPENDENT
    for (std::size_t i = begin; i < end; ++i) x[i] += m[i] * f[i];
  };
  component(position_.x, force_.x);
  component(position_.y, force_.y);
  component(position_.z, force_.z);
}

double RelaxationKernel::largest_force_squared() const noexcept {
  double largest = 0.0;
  for (std::size_t i = pad_; i < pad_ + nodes_; ++i) {
    const double square = force_.x[i] * force_.x[i] + force_.y[i] * force_.y[i] + force_.z[i] * force_.z[i];
    // Written so that a NaN comes through.
    if (mobility_[i] > 0.0 && !(square <= largest)) largest = square;
  }
  return largest;
}

Vec3 RelaxationKernel::force(int node) const noexcept {
  const std::size_t i = padded(node);
  return {force_.x[i], force_.y[i], force_.z[i]};
}

}  // namespace fuai
