// Levenberg-Marquardt on log B, log HB and the clamps' tilt; offsets and drifts are eliminated in each
// evaluation.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/buckling_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "fuai/core/error.h"
#include "fuai/fabric/buckling.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/units/constants.h"

namespace fuai {

namespace {

constexpr double kTautMargin = 5e-4;       // samples closer to the free length are left out [free lengths]
constexpr std::size_t kFewestSamples = 8;  // two offsets, two parameters, and something to judge them by
constexpr double kHuber = 1.345;           // in robust standard deviations: 95 % efficiency for normal noise
constexpr double kStep = 1e-2;  // of the logarithms and the tilt: above the noise of kinks in the path
const Eigen::Vector3d kLargestStep(1.0, 1.0, 0.05);
constexpr int kMaxIterations = 25;

/// One test ready to simulate.
struct Task {
  FabTest test;
  BucklingStrip strip;
  double width;
  std::vector<double> distance;
  Eigen::VectorXd force;
  Eigen::VectorXd counts;  ///< 0 in the first branch (unknown history), 1 after
};

using Tasks = std::vector<Task>;

/// The model of a task: force without offset, and the best offset and drift.
struct Projected {
  Eigen::VectorXd model, residual;
  double offset, drift;
};

Task make_task(const FabRecord& record, Direction direction, FabTest test) {
  const FabStripTest& strip = record.strip(direction, test);
  Task task{test, {}, strip.width, {}, {}, {}};
  task.strip.free_length = strip.length;
  task.strip.areal_mass = record.areal_mass;
  task.strip.upwards = test == FabTest::kU1;
  task.strip.half_segments = test == FabTest::kD2 ? 40 : 20;
  std::vector<double> force, counts;
  for (const auto& branch : strip.branches) {
    for (const FabSample& s : branch) {
      if (!(s.clamp_distance < strip.length * (1.0 - kTautMargin))) continue;
      task.distance.push_back(s.clamp_distance);
      force.push_back(s.force);
      counts.push_back(&branch == &strip.branches.front() ? 0.0 : 1.0);
    }
  }
  task.force = Eigen::Map<Eigen::VectorXd>(force.data(), static_cast<Eigen::Index>(force.size()));
  task.counts = Eigen::Map<Eigen::VectorXd>(counts.data(), static_cast<Eigen::Index>(counts.size()));
  return task;
}

/// Simulates a task and takes the weighted best offset and drift off.
Projected project(const Task& task, double B, double HB, double clamp_tilt, const Eigen::VectorXd& weight) {
  BucklingStrip strip = task.strip;
  strip.clamp_angle = strip.upwards ? clamp_tilt : -clamp_tilt;
  const BucklingPath path =
      simulate_buckling(strip, make_bending_law(B, 2.0 * HB, kNoJamming), task.distance);
  const Eigen::Index n = task.force.size();
  Projected p;
  p.model = task.width * Eigen::Map<const Eigen::VectorXd>(path.force.data(), n);
  const Eigen::VectorXd tau = Eigen::VectorXd::LinSpaced(n, 0.0, 1.0);
  const Eigen::VectorXd left = task.force - p.model;
  Eigen::Matrix2d normal;
  normal << weight.sum(), weight.dot(tau), weight.dot(tau), weight.dot(tau.cwiseAbs2());
  const Eigen::Vector2d right(weight.dot(left), weight.cwiseProduct(tau).dot(left));
  const Eigen::Vector2d solution = normal.inverse() * right;
  p.offset = solution[0];
  p.drift = solution[1];
  p.residual = left - Eigen::VectorXd::Constant(n, p.offset) - p.drift * tau;
  return p;
}

/// All residuals one after the other, each times the root of its weight.
Eigen::VectorXd residuals(const Tasks& tasks, const Eigen::Vector3d& parameters,
                          const std::vector<Eigen::VectorXd>& weights,
                          std::vector<Projected>* parts = nullptr) {
  Eigen::Index total = 0, at = 0;
  for (const Task& t : tasks) total += t.force.size();
  Eigen::VectorXd all(total);
  if (parts) parts->clear();
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    Projected p =
        project(tasks[k], std::exp(parameters[0]), std::exp(parameters[1]), parameters[2], weights[k]);
    all.segment(at, p.residual.size()) = p.residual.cwiseProduct(weights[k].cwiseSqrt());
    at += p.residual.size();
    if (parts) parts->push_back(std::move(p));
  }
  return all;
}

/// Huber weights from the residuals of each test, scaled by their median magnitude.
std::vector<Eigen::VectorXd> huber_weights(const Tasks& tasks, const std::vector<Projected>& parts) {
  std::vector<Eigen::VectorXd> weights;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Projected& p = parts[k];
    std::vector<double> size;
    for (Eigen::Index i = 0; i < p.residual.size(); ++i) {
      if (tasks[k].counts[i] > 0.0) size.push_back(std::abs(p.residual[i]));
    }
    std::nth_element(size.begin(), size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2), size.end());
    const double limit = kHuber * 1.4826 * size[size.size() / 2];  // 1.4826: median to standard deviation
    weights.push_back(
        p.residual.unaryExpr([limit](double r) { return std::abs(r) <= limit ? 1.0 : limit / std::abs(r); })
            .cwiseProduct(tasks[k].counts));
  }
  return weights;
}

/// Sum of squares; infinite where the strip cannot be simulated, so that a step goes elsewhere.
double cost(const Tasks& tasks, const Eigen::Vector3d& parameters,
            const std::vector<Eigen::VectorXd>& weights) {
  try {
    return residuals(tasks, parameters, weights).squaredNorm();
  } catch (const Error&) {
    return std::numeric_limits<double>::infinity();
  }
}

struct Solution {
  Eigen::Vector3d parameters;
  Eigen::Vector3d errors;
  std::vector<Projected> parts;
  double squares = 0.0;  ///< of the residuals that count, all weights one [N2]
};

/// Levenberg-Marquardt with reweighting in each iteration, from a start (log B, log HB, tilt).
Solution fit_tasks(const Tasks& tasks, const Eigen::Vector3d& start) {
  std::vector<Eigen::VectorXd> weights;
  double degrees = -3.0;
  for (const Task& t : tasks) {
    weights.push_back(t.counts);
    degrees += t.counts.sum() - 2.0;
  }
  Solution s;
  s.parameters = start;
  double damping = 1e-2;
  Eigen::Matrix3d normal;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Eigen::VectorXd r = residuals(tasks, s.parameters, weights, &s.parts);
    Eigen::MatrixXd jacobian(r.size(), 3);
    for (int j = 0; j < 3; ++j) {
      Eigen::Vector3d moved = s.parameters;
      moved[j] += kStep;
      jacobian.col(j) = (residuals(tasks, moved, weights) - r) / kStep;
    }
    normal = jacobian.transpose() * jacobian;
    const Eigen::Vector3d slope = jacobian.transpose() * r;
    bool better = false;
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    for (int k = 0; k < 8 && !better; ++k) {
      Eigen::Matrix3d damped = normal;
      damped.diagonal() *= 1.0 + damping;
      step = -(damped.inverse() * slope).cwiseMax(-kLargestStep).cwiseMin(kLargestStep);
      better = cost(tasks, s.parameters + step, weights) < r.squaredNorm();
      damping = better ? 0.3 * damping : 8.0 * damping;
    }
    if (better) s.parameters += step;
    residuals(tasks, s.parameters, weights, &s.parts);
    const double variance = r.squaredNorm() / std::max(degrees, 1.0);
    s.errors = (variance * normal.inverse()).diagonal().cwiseSqrt();
    if (!better || step.norm() < 1e-4) break;
    weights = huber_weights(tasks, s.parts);
  }
  s.squares = 0.0;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    s.squares += s.parts[k].residual.cwiseProduct(tasks[k].counts).squaredNorm();
  }
  return s;
}

BucklingTestFit describe(const Task& task, const Projected& p, bool fitted) {
  BucklingTestFit fit;
  fit.test = task.test;
  fit.fitted = fitted;
  fit.offset = p.offset;
  fit.drift = p.drift;
  fit.rms = std::sqrt(p.residual.cwiseProduct(task.counts).squaredNorm() / task.counts.sum());
  fit.clamp_distance = task.distance;
  const Eigen::VectorXd measured = p.model + p.residual;
  fit.measured.assign(measured.begin(), measured.end());
  fit.model.assign(p.model.begin(), p.model.end());
  fit.span = measured.maxCoeff() - measured.minCoeff();
  return fit;
}

/// The verdict in words, by the thresholds of buckling_fit.h.
std::string judge(const BucklingFit& fit) {
  const double spread = std::max(std::abs(fit.B_alone[0] - fit.B), std::abs(fit.B_alone[1] - fit.B)) / fit.B;
  const char* word = fit.rms_fraction <= 0.05 && spread <= 0.25   ? "good"
                     : fit.rms_fraction <= 0.10 && spread <= 0.50 ? "fair"
                                                                  : "poor";
  char text[200];
  std::snprintf(
      text, sizeof text,
      "%s: residual %.1f %% of the force span; B of the downward test alone %.4f, of the upward test "
      "alone %.4f gf cm2/cm",
      word, 100.0 * fit.rms_fraction, fit.B_alone[0] / unit::kGfCm2PerCm, fit.B_alone[1] / unit::kGfCm2PerCm);
  return text;
}

}  // namespace

BucklingFit fit_buckling(const FabRecord& record, Direction direction) {
  const Tasks tasks{make_task(record, direction, FabTest::kD1), make_task(record, direction, FabTest::kU1)};
  for (const Task& task : tasks) {
    if (task.distance.size() < kFewestSamples) {
      throw Error(ErrorKind::kBadInput,
                  std::string("the buckling test ") + to_string(task.test) + " in " + to_string(direction) +
                      " has too few samples to fit",
                  {record.source, 0, 0, "raw_data"});
    }
  }
  // Start: a thin woven cloth, residual curvature 0.3 1/cm, straight clamps. Starts with +-0.1 rad of tilt
  // ended in the same place for all strips at hand.
  const Solution both =
      fit_tasks(tasks, {std::log(0.04 * unit::kGfCm2PerCm), std::log(0.012 * unit::kGfCmPerCm), 0.0});
  BucklingFit fit;
  fit.direction = direction;
  fit.B = std::exp(both.parameters[0]);
  fit.hysteresis_2HB = 2.0 * std::exp(both.parameters[1]);
  fit.B_error = fit.B * both.errors[0];
  fit.hysteresis_2HB_error = fit.hysteresis_2HB * both.errors[1];
  fit.clamp_tilt = both.parameters[2];
  fit.clamp_tilt_error = both.errors[2];
  double samples = 0.0, span = 0.0;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const Solution alone = fit_tasks({tasks[k]}, both.parameters);
    fit.B_alone[k] = std::exp(alone.parameters[0]);
    fit.hysteresis_alone[k] = 2.0 * std::exp(alone.parameters[1]);
    fit.tests.push_back(describe(tasks[k], both.parts[k], true));
    samples += tasks[k].counts.sum();
    span += 0.5 * fit.tests.back().span;
  }
  fit.rms = std::sqrt(both.squares / samples);
  fit.rms_fraction = fit.rms / span;
  const Task hanging = make_task(record, direction, FabTest::kD2);
  if (hanging.distance.size() >= kFewestSamples) {
    fit.tests.push_back(describe(
        hanging, project(hanging, fit.B, 0.5 * fit.hysteresis_2HB, both.parameters[2], hanging.counts),
        false));
  }
  fit.quality = judge(fit);
  return fit;
}

}  // namespace fuai
