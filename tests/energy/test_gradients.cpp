// Gradients of one stencil against finite differences, and what they do to momentum.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "fuai/energy/bend.h"
#include "fuai/energy/curvature.h"
#include "fuai/energy/stretch.h"

using namespace fuai;

namespace {

/// Largest difference of a stencil's gradient from central differences of `value`, over a sweep of steps: the
/// best step counts, since large ones truncate and small ones round.
template <std::size_t N, typename Value>
double best_error(const std::array<Vec3, N>& x, const std::array<Vec3, N>& gradient, const Value& value) {
  double best = 1e300;
  for (double h : {1e-4, 1e-5, 1e-6}) {
    double worst = 0.0;
    for (std::size_t node = 0; node < N; ++node) {
      for (int c = 0; c < 3; ++c) {
        auto up = x, down = x;
        up[node][c] += h;
        down[node][c] -= h;
        worst = std::max(worst, std::abs((value(up) - value(down)) / (2 * h) - gradient[node][c]));
      }
    }
    best = std::min(best, worst);
  }
  return best;
}

}  // namespace

TEST_SUITE("derivative") {
  TEST_CASE("Eq. (1): the gradient of a spring") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int trial = 0; trial < 200; ++trial) {
      std::array<Vec3, 2> x{Vec3(uniform(random), uniform(random), uniform(random)),
                            Vec3(2 + uniform(random), uniform(random), uniform(random))};
      const Vec3 g = evaluate_stretch(x[0], x[1], 1.1, 2.0).gradient_first;
      const auto value = [](const auto& y) { return evaluate_stretch(y[0], y[1], 1.1, 2.0).energy; };
      // Truncation h^2 E''' / 6 and rounding 1e-15 / h meet below 1e-9; everything is of order 1.
      CHECK(best_error<2>(x, {g, Vec3(-g)}, value) < 1e-8);
    }
    CHECK(evaluate_stretch(Vec3::Zero(), Vec3::Zero(), 1.0, 2.0).gradient_first.norm() == 0.0);
  }

  TEST_CASE("Eq. (2): the gradient of the curvature, in both branches, creates no force and no moment") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    int sharp = 0;
    for (int trial = 0; trial < 400; ++trial) {
      const Vec3 m(uniform(random), uniform(random), uniform(random));
      const auto leg = [&] { return Vec3(uniform(random), uniform(random), uniform(random)).normalized(); };
      const std::array<Vec3, 3> x{m + 0.9 * leg(), m, m + 1.2 * leg()};
      const Vec3 normal = leg();
      const TripleCurvature c = evaluate_curvature(x[0], x[1], x[2], 1.0, normal, CurvatureForm::kC1);
      const double theta = std::acos((x[0] - m).normalized().dot((x[2] - m).normalized()));
      // Away from the exact flat state, the switch and the closed fold, where differences straddle a kink.
      if (theta > 3.0 || theta < 0.3 || std::abs(theta - std::numbers::pi / 4.0) < 0.01) continue;
      sharp += theta < std::numbers::pi / 4.0 ? 1 : 0;
      const Vec3 middle = -(c.gradient_p + c.gradient_r);
      const auto value = [&](const auto& y) {
        return evaluate_curvature(y[0], y[1], y[2], 1.0, normal, CurvatureForm::kC1).curvature;
      };
      CHECK(best_error<3>(x, {c.gradient_p, middle, c.gradient_r}, value) < 1e-8);  // as above
      // Net force is zero by construction; net moment to rounding.
      const Vec3 moment = (x[0] - m).cross(c.gradient_p) + (x[2] - m).cross(c.gradient_r);
      CHECK(moment.norm() < 1e-12);
    }
    CHECK(sharp > 10);
  }

  TEST_CASE("the curvature gradient is regular through the flat state") {
    // K = (2/l) sin(turn / 2) with the end P lifted: dK/dz is 1/l^2 on both sides and at zero.
    for (double lift : {-1e-6, -1e-9, 0.0, 1e-9, 1e-6}) {
      const TripleCurvature c = evaluate_curvature(Vec3(-1, 0, lift), Vec3::Zero(), Vec3(1, 0, 0), 1.0,
                                                   Vec3::UnitZ(), CurvatureForm::kC1);
      CHECK(c.gradient_p.z() == doctest::Approx(1.0).epsilon(1e-6));
      CHECK(c.gradient_r.z() == doctest::Approx(1.0).epsilon(1e-6));
      CHECK(c.curvature == doctest::Approx(lift).epsilon(1e-6));
    }
  }
}
