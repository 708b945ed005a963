// Runs a drape.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/drape_run.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <memory>
#include <numbers>

#include "fuai/core/constants.h"
#include "fuai/core/error.h"
#include "fuai/laboratory/drape_stepper.h"

namespace fuai {
namespace {

void check(const DrapeMethod& m) {
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  if (positive(m.loading) && positive(m.dt) && m.dt <= kRestWindow && positive(m.driven_dt) &&
      positive(m.most_settling) && m.loading_drag >= 0.0 && m.settling_drag >= 0.0 && m.linger >= 0.0 &&
      m.shakes >= 0 && positive(m.shake_period))
    return;
  throw Error(ErrorKind::kUsage, "a drape needs positive times, steps of at most 0.2 s and drags from 0 up");
}

/// DC over the last moments.
class RestWatch {
 public:
  void add(double time, double coefficient) {
    seen_.push_back({time, coefficient});
    while (seen_.size() > 1 && seen_[1].time <= time - kRestWindow) seen_.pop_front();
  }
  bool still() const {
    const auto less = [](const Moment& a, const Moment& b) { return a.coefficient < b.coefficient; };
    const auto [low, high] = std::minmax_element(seen_.begin(), seen_.end(), less);
    return seen_.back().time - seen_.front().time >= kRestWindow &&
           high->coefficient - low->coefficient < kRestSpread;
  }

 private:
  struct Moment {
    double time, coefficient;
  };
  std::deque<Moment> seen_;
};

/// A drape under way: stage after stage from one state.
class Drape {
 public:
  Drape(const DrapeGeometry& geometry, const ClothModel& model, const ClothMaterial& material,
        const DrapeMethod& method, const Progress& progress)
      : geometry_(geometry), model_(model), material_(material), method_(method), progress_(progress) {
    for (std::size_t i = 0; i < model.live.size(); ++i)
      if (model.live[i] != 0 && model.fixed[i] == 0) mobile_.push_back(static_cast<int>(i));
  }

  /// Something moves the cloth for `seconds`. @param moment of the time since the stage began [s]
  void move(DrapeStage stage, double seconds, const std::function<DrapeMoment(double)>& moment,
            DrapeRun& run) {
    begin(stage, method_.loading_drag, run);
    const auto steps = static_cast<int>(std::lround(seconds / stepper_->dt()));
    for (int i = 1; i <= steps; ++i) {
      step(moment(seconds * i / steps), run);
      report(0.8 * i / steps);
    }
    end(run);
  }

  /// Until it rests, or for `most_settling`.
  void settle(DrapeRun& run) {
    begin(DrapeStage::kSettling, method_.settling_drag, run);
    RestWatch watch;
    const double dt = stepper_->dt();
    run.at_rest = false;
    for (int i = 1; i * dt <= method_.most_settling && !run.at_rest; ++i) {
      step({}, run);
      watch.add(i * dt,
                border_coefficient(geometry_, model_, [&](int slot) { return stepper_->position(slot); }));
      report(0.8);
      if (i * dt < kLeastSettling || !watch.still() || rms_speed() >= kRestSpeed) continue;
      run.residual = residual();
      run.at_rest = run.residual < kRestResidual;
    }
    run.residual = residual();
    run.seconds = time_;
    for (int i = 1; i * dt <= method_.linger; ++i) step({}, run);
    end(run);
  }

 private:
  void begin(DrapeStage stage, double drag, const DrapeRun& run) {
    material_.mass_drag = drag;
    stepper_ = make_drape_stepper(model_, material_, run.state, method_, stage);
  }
  void step(const DrapeMoment& moment, DrapeRun& run) {
    const int iterations = stepper_->step(moment);
    if (iterations < 0) {
      throw Error(ErrorKind::kCheckFailed, "a drape went wrong: a number is not finite any more", {},
                  "take another spacing");
    }
    time_ += stepper_->dt();
    run.iterations += iterations;
    ++run.steps;
  }
  void end(DrapeRun& run) {
    stepper_->save(run.state);
    stepper_.reset();
  }
  void report(double fraction) const {
    if (progress_) progress_("drape", fraction);
  }
  double rms_speed() const {
    double square = 0.0;
    for (int slot : mobile_) square += stepper_->velocity(slot).squaredNorm();
    return std::sqrt(square / static_cast<double>(mobile_.size()));
  }
  double residual() {
    const double weight = model_.areal_mass * model_.spacing * model_.spacing * kStandardGravity;
    return stepper_->out_of_balance() / (weight * std::sqrt(static_cast<double>(mobile_.size())));
  }

  const DrapeGeometry& geometry_;
  const ClothModel& model_;
  ClothMaterial material_;
  const DrapeMethod& method_;
  const Progress& progress_;
  std::vector<int> mobile_;
  std::unique_ptr<DrapeStepper> stepper_;
  double time_ = 0.0;
};

/// From 0 to 1 without a jolt.
double smooth(double s) { return s * s * (3.0 - 2.0 * s); }

}  // namespace

DrapeRun run_drape(const DrapeGeometry& geometry, const ClothModel& model, const ClothMaterial& material,
                   const ClothState& start, const DrapeMethod& method, const Progress& progress) {
  check(method);
  DrapeRun run;
  run.state = start;
  Drape drape(geometry, model, material, method, progress);
  const double loading = method.loading;
  switch (method.path) {
    case DrapePath::kRamp:
    case DrapePath::kShakes:
      drape.move(
          DrapeStage::kGrowing, loading, [&](double t) { return DrapeMoment{smooth(t / loading)}; }, run);
      break;
    case DrapePath::kRelease:
      drape.move(
          DrapeStage::kDriven, loading, [](double) { return DrapeMoment{}; }, run);
      break;
    case DrapePath::kSupport: {
      const double lowest = -1.05 * geometry.overhang();  // where the cloth cannot reach
      drape.move(
          DrapeStage::kDriven, loading,
          [&](double t) {
            return DrapeMoment{1.0, 0.0, lowest * smooth(t / loading)};
          },
          run);
      break;
    }
  }
  drape.settle(run);
  if (method.path == DrapePath::kShakes && method.shakes > 0) {
    const double turns = 2.0 * std::numbers::pi / method.shake_period, half = 0.5 * method.shake_height;
    drape.move(
        DrapeStage::kDriven, method.shakes * method.shake_period,
        [&](double t) {
          return DrapeMoment{1.0, half * (1.0 - std::cos(turns * t))};
        },
        run);
    drape.settle(run);
  }
  run.shadow = cast_shadow(geometry, model, run.state.positions);
  return run;
}

}  // namespace fuai
