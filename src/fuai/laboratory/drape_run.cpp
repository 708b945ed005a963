// Runs a drape.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/drape_run.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "fuai/core/constants.h"
#include "fuai/core/error.h"
#include "fuai/solver/cloth_energy.h"
#include "fuai/solver/implicit.h"

namespace fuai {
namespace {

/// DC over the last moments.
class RestWatch {
 public:
  void add(double time, double coefficient) {
    seen_.push_back({time, coefficient});
    while (seen_.size() > 2 && seen_[1].time <= time - kRestWindow) seen_.pop_front();
  }
  double spread() const {
    double low = 1e300, high = -1e300;
    for (const Moment& m : seen_) {
      low = std::min(low, m.coefficient);
      high = std::max(high, m.coefficient);
    }
    return high - low;
  }
  bool full(double time) const { return !seen_.empty() && seen_.front().time <= time - kRestWindow + 1e-9; }

 private:
  struct Moment {
    double time, coefficient;
  };
  std::deque<Moment> seen_;
};

ClothMaterial with_drag(const ClothMaterial& material, double drag) {
  ClothMaterial result = material;
  result.mass_drag = drag;
  return result;
}

}  // namespace

/// Force out of balance, rms over the mobile slots [node weights]. Stops the cloth: restore it to go on.
double node_residual(const ClothModel& model, SolverImplicit<double>& solver) {
  int count = 0;
  for (std::size_t i = 0; i < model.live.size(); ++i) count += model.live[i] != 0 && model.fixed[i] == 0;
  const double weight = model.areal_mass * model.spacing * model.spacing * kStandardGravity;
  return solver.out_of_balance() / (std::sqrt(std::max(count, 1)) * weight);
}

DrapeRun run_drape(const DrapeGeometry& geometry, const ClothModel& model, const ClothMaterial& material,
                   const ClothState& start, const DrapeMethod& method, const Progress& progress) {
  ImplicitOptions implicit;
  implicit.iterations = method.iterations;
  implicit.linearisations = method.linearisations;
  DrapeRun run;
  run.state = start;
  const double loading = method.path == DrapePath::kRamp ? method.ramp : 0.0;
  const auto steps = static_cast<int>(std::lround(loading / method.dt));
  {
    SolverImplicit<double> solver(model, with_drag(material, method.loading_drag), implicit);
    solver.restore(run.state);
    for (int i = 1; i <= steps; ++i) {
      const double s = static_cast<double>(i) / steps;
      solver.set_load(s * s * (3.0 - 2.0 * s));
      const StepReport report = solver.step(method.dt);
      run.iterations += report.iterations;
      ++run.steps;
    }
    solver.save(run.state);
  }
  SolverImplicit<double> solver(model, with_drag(material, method.settling_drag), implicit);
  solver.restore(run.state);
  RestWatch watch;
  const auto position = [&](int slot) { return solver.position(slot); };
  for (double settled = method.dt; settled <= method.most_settling; settled += method.dt) {
    const StepReport report = solver.step(method.dt);
    run.iterations += report.iterations;
    ++run.steps;
    if (progress) progress("drape", 0.5);
    watch.add(settled, border_coefficient(geometry, model, position));
    if (settled < kLeastSettling || !watch.full(settled) || watch.spread() > kRestSpread) continue;
    solver.save(run.state);
    run.residual = node_residual(model, solver);
    solver.restore(run.state);
    if (run.residual > kRestResidual) continue;
    run.at_rest = true;
    break;
  }
  solver.save(run.state);
  run.residual = node_residual(model, solver);
  run.seconds = solver.time();
  run.shadow = cast_shadow(geometry, model, run.state.positions);
  return run;
}

}  // namespace fuai
