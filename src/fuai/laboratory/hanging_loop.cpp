// Forms a loop and hangs it.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/hanging_loop.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "fuai/core/constants.h"
#include "fuai/core/error.h"
#include "fuai/experiments/cantilever.h"
#include "fuai/laboratory/kes_drive.h"
#include "fuai/laboratory/specimen.h"
#include "fuai/solver/cloth_material.h"

namespace fuai {
namespace {

constexpr double kSimulatedSpacings = 4.0;  ///< of the width, across which the strip is even
constexpr int kTurnSteps = 60, kCloseSteps = 60;

/// Half turns of the moving clamp against the fixed one.
int half_turns(LoopKind kind) { return kind == LoopKind::kPear ? 1 : (kind == LoopKind::kRing ? 2 : 3); }

/// Down in the frame of the strip: the yarns leave the fixed clamp downward, level or upward.
Vec3 down_of(LoopKind kind, const Specimen& specimen) {
  if (kind == LoopKind::kRing) return Vec3::UnitZ();
  return kind == LoopKind::kPear ? specimen.along() : Vec3(-specimen.along());
}

void check(const HangingLoopOptions& o) {
  if (!(o.length > 0.0) || !std::isfinite(o.length) || o.segments < 16 || o.segments > 1000 ||
      o.load_steps < 1) {
    throw Error(
        ErrorKind::kUsage,
        "a loop needs a length, 16 to 1000 spacings along the strip and at least one step of the weight", {},
        "give a length such as 20cm");
  }
}

/// The strip on its way into the loop.
class Former {
 public:
  Former(const FabricLaws& laws, const SpecimenSpec& spec, LoopKind kind)
      : specimen_(laws, spec), kind_(kind) {}

  void bend() {
    specimen_.pull(specimen_.along(), 0.0);
    specimen_.pull(Vec3::UnitZ(), 0.0);
    const double whole = half_turns(kind_) * std::numbers::pi;
    for (int i = 1; i <= kTurnSteps; ++i) {
      go(whole * (i - 1) / kTurnSteps, whole * i / kTurnSteps, [&](double angle, CurveSample&) {
        const bool at_rest = specimen_.settle_turned(turn(angle), angle - angle_).converged;
        return accept(at_rest, [&] { angle_ = angle; });
      });
    }
  }
  void close() {
    specimen_.hold();
    const Vec3 from = specimen_.moving().shift, to = -specimen_.spec().length * specimen_.along();
    for (int i = 1; i <= kCloseSteps; ++i) {
      go((i - 1.0) / kCloseSteps, static_cast<double>(i) / kCloseSteps, [&](double share, CurveSample&) {
        shift_ = from + share * (to - from);
        return accept(specimen_.settle(turn(angle_), shift_).converged, [] {});
      });
    }
  }
  void hang(int steps, const Progress& progress) {
    for (int i = 1; i <= steps; ++i) {
      go((i - 1.0) / steps, static_cast<double>(i) / steps, [&](double share, CurveSample&) {
        specimen_.set_gravity(share * kStandardGravity * down_of(kind_, specimen_));
        return accept(specimen_.settle(turn(angle_), shift_).converged, [] {});
      });
      if (progress) progress("hanging loop", static_cast<double>(i) / steps);
    }
  }
  const Specimen& specimen() const { return specimen_; }

 private:
  Mat3 turn(double angle) const { return Eigen::AngleAxisd(angle, specimen_.bend_axis()).toRotationMatrix(); }
  void go(double from, double to, const KesMove& move) {
    CurveSample unused;
    move_in_parts(from, to, move, unused);
  }
  template <class Then>
  bool accept(bool at_rest, const Then& then) {
    if (!at_rest) {
      specimen_.roll_back();
      return false;
    }
    specimen_.commit();
    then();
    return true;
  }

  Specimen specimen_;
  LoopKind kind_;
  double angle_ = 0.0;
  Vec3 shift_ = Vec3::Zero();
};

}  // namespace

HangingLoopResult run_hanging_loop(const FabricLaws& laws, const HangingLoopOptions& options,
                                   const Progress& progress) {
  check(options);
  SpecimenSpec spec;
  spec.along = options.direction;
  spec.length = options.length;
  spec.spacing = options.length / options.segments;
  spec.width = kSimulatedSpacings * spec.spacing;
  spec.bends = true;
  Former former(options.elastic ? without_friction(laws) : laws, spec, options.kind);
  former.bend();
  former.close();
  former.hang(options.load_steps, progress);
  const Specimen& specimen = former.specimen();
  HangingLoopResult result;
  result.spacing = spec.spacing;
  result.iterations = specimen.iterations();
  result.model = specimen.model();
  result.state = specimen.state();
  result.down = down_of(options.kind, specimen);
  for (std::size_t slot = 0; slot < result.state.positions.size(); ++slot) {
    // Depth below the clamp, which is where the strip begins.
    const Vec3& x = result.state.positions[slot];
    result.height =
        std::max(result.height, result.down.dot(x - x.dot(specimen.across()) * specimen.across()));
  }
  result.bending_length = result.bending_rigidity = std::numeric_limits<double>::quiet_NaN();
  const double relative = result.height / options.length;
  if (relative > elastica_loop(options.kind, 0.0).height &&
      relative < elastica_loop(options.kind, kMostLoopLoad).height) {
    const double load = elastica_loop_load(options.kind, relative);
    result.bending_length = options.length / std::cbrt(load);
    result.bending_rigidity = laws.areal_mass * kStandardGravity * std::pow(result.bending_length, 3);
  }
  result.assumptions.emplace_back("the strip is formed face inward, from flat and without a past");
  if (options.elastic) result.assumptions.emplace_back("friction was left out");
  std::ranges::move(assumptions_of(laws), std::back_inserter(result.assumptions));
  return result;
}

}  // namespace fuai
