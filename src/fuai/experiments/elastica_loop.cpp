// Shoots from the lowest point, following the loop from the ring and from no weight.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/elastica_loop.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fuai/core/error.h"
#include "fuai/core/types.h"

namespace fuai {
namespace {

constexpr double kPi = std::numbers::pi;
/// Runge-Kutta steps over half the strip: errors below 1e-9 up to the largest load.
constexpr int kSteps = 800;
constexpr int kNewtonSteps = 30;
constexpr double kClosed = 1e-11;   ///< angle [rad] and place [-] at the clamp
constexpr int kAngleSteps = 8;      ///< from the ring to the kind of loop
constexpr double kLoadStep = 10.0;  ///< of the path from no weight
constexpr int kBisections = 60;

/// theta, theta', x, y.
using Shape = std::array<double, 4>;

/// @param unknowns curvature at the lowest point and level force
Shape shoot(const Vec2& unknowns, double load) {
  const auto rate = [&](double s, const Shape& y) -> Shape {
    const double sine = std::sin(y[0]), cosine = std::cos(y[0]);
    return {y[1], unknowns[1] * sine - load * s * cosine, cosine, sine};
  };
  const auto along = [](const Shape& y, double h, const Shape& k) {
    Shape moved = y;
    for (std::size_t i = 0; i < y.size(); ++i) moved[i] += h * k[i];
    return moved;
  };
  const double h = 0.5 / kSteps;
  Shape y{0.0, unknowns[0], 0.0, 0.0};
  for (int i = 0; i < kSteps; ++i) {
    const double s = i * h;
    const Shape a = rate(s, y), b = rate(s + 0.5 * h, along(y, 0.5 * h, a));
    const Shape c = rate(s + 0.5 * h, along(y, 0.5 * h, b)), d = rate(s + h, along(y, h, c));
    for (std::size_t j = 0; j < y.size(); ++j) y[j] += h / 6.0 * (a[j] + 2.0 * b[j] + 2.0 * c[j] + d[j]);
  }
  return y;
}

/// Newton's method on angle and place at the clamp, from a shape nearby.
void close_loop(double angle, double load, Vec2& unknowns) {
  const auto gap = [&](const Vec2& u) {
    const Shape end = shoot(u, load);
    return Vec2(end[0] - angle, end[2]);
  };
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Vec2 now = gap(unknowns);
    if (now.norm() < kClosed) return;
    Eigen::Matrix2d slope;
    for (int j = 0; j < 2; ++j) {
      const double step = 1e-6 * std::max(1.0, std::abs(unknowns[j]));
      Vec2 ahead = unknowns, behind = unknowns;
      ahead[j] += step, behind[j] -= step;
      slope.col(j) = (gap(ahead) - gap(behind)) / (2.0 * step);
    }
    unknowns -= slope.inverse() * now;
  }
  // What is left is rounding of the long integration, or the loop was lost.
  if (!(gap(unknowns).norm() < 1e3 * kClosed))
    throw Error(ErrorKind::kCheckFailed, "the exact loop was not found");
}

double clamp_angle(LoopKind kind) {
  return kind == LoopKind::kPear ? 0.5 * kPi : (kind == LoopKind::kRing ? kPi : 1.5 * kPi);
}

/// A loop and its load, from which others are followed.
struct Followed {
  Vec2 unknowns;
  double load;
};

/// The weightless ring is a circle; from it to the other angle.
Followed weightless(LoopKind kind) {
  Followed loop{Vec2(2.0 * kPi, 0.0), 0.0};
  const double end = clamp_angle(kind);
  for (int i = 1; i <= kAngleSteps; ++i) close_loop(kPi + (end - kPi) * i / kAngleSteps, 0.0, loop.unknowns);
  return loop;
}

Followed follow(LoopKind kind, Followed loop, double load) {
  const double from = loop.load;
  const int steps = static_cast<int>(std::ceil(std::abs(load - from) / kLoadStep));
  for (int i = 1; i <= steps; ++i)
    close_loop(clamp_angle(kind), from + (load - from) * i / steps, loop.unknowns);
  loop.load = load;
  return loop;
}

double height_of(const Followed& loop) { return shoot(loop.unknowns, loop.load)[3]; }

}  // namespace

ElasticaLoop elastica_loop(LoopKind kind, double load) {
  if (!(load >= 0.0 && load <= kMostLoopLoad))
    throw Error(ErrorKind::kUsage, "a loop needs a load w L^3 / B of 0 to 1000");
  const Followed loop = follow(kind, weightless(kind), load);
  const Shape top = shoot(loop.unknowns, load);
  return {top[3], loop.unknowns[0], top[1], loop.unknowns[1]};
}

double elastica_loop_load(LoopKind kind, double height) {
  Followed low = weightless(kind);
  double high = kMostLoopLoad;
  if (!(height > height_of(low) && height < height_of(follow(kind, low, high)))) {
    throw Error(ErrorKind::kUsage, "no loop of this height hangs under its own weight", {},
                "take a longer strip if the loop is stiffer than its weight, a shorter one if it is limp");
  }
  for (int i = 0; i < kBisections && high - low.load > 1e-9 * high; ++i) {
    const Followed middle = follow(kind, low, 0.5 * (low.load + high));
    if (height_of(middle) < height) {
      low = middle;
    } else {
      high = middle.load;
    }
  }
  return 0.5 * (low.load + high);
}

}  // namespace fuai
