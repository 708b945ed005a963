// KES-FB1: shear under constant tension.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "fuai/core/error.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/laboratory/kes_instruments.h"
#include "fuai/laboratory/specimen.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

constexpr double kLength = 0.05;    ///< between the clamps [m]
constexpr double kSpacing = 0.005;  ///< h [m]; with the edges out of it, the reading does not depend on it
constexpr double kStep = 0.5 * unit::kDegree;  ///< longest
constexpr int kTensionSteps = 10;              ///< in which the tension is put on
constexpr double kSteepest = 60.0 * unit::kDegree;
/// An angle is met to this part of a step; a few rounds, since the clamp comes nearer as it is shifted.
constexpr double kAngleTolerance = 1e-4;
constexpr int kRounds = 6;

/// The instrument: a shift across, free along under the tension.
class ShearTester {
 public:
  ShearTester(const FabricLaws& laws, const SpecimenSpec& spec) : specimen_(laws, spec) {}

  void put_tension_on(double per_width) {
    for (int i = 1; i <= kTensionSteps; ++i) {
      const double share = static_cast<double>(i) / kTensionSteps;
      specimen_.pull(specimen_.along(), share * per_width * specimen_.spec().width);
      if (!specimen_.settle(Mat3::Identity(), Vec3::Zero()).converged)
        throw Error(ErrorKind::kCheckFailed, "the specimen did not come to rest under the tension alone", {},
                    "take another spacing");
      specimen_.commit();
    }
    distance_ = distance();
  }

  /// Comes to rest at an angle, without committing. @return whether it did
  bool try_angle(double angle, double tolerance) {
    // Yarns that only turn bring the clamps nearer by the ratio of the cosines.
    distance_ *= std::cos(angle) / std::cos(reached());
    for (int round = 0; round < kRounds; ++round) {
      shift_ = distance_ * std::tan(angle);
      if (!specimen_.settle(Mat3::Identity(), shift_ * specimen_.across()).converged) return false;
      distance_ = distance();
      if (std::abs(reached() - angle) < tolerance) break;
    }
    return true;
  }
  void commit() {
    specimen_.commit();
    committed_shift_ = shift_;
  }
  void roll_back() {
    specimen_.roll_back();
    distance_ = distance();
    shift_ = committed_shift_;
  }

  double reached() const { return std::atan2(shift_, distance_); }
  /// Of the whole clamp [N].
  double force() const { return -specimen_.moving().force.dot(specimen_.across()); }
  double width() const { return specimen_.spec().width; }
  /// Distance of the clamps over the length of the cloth.
  double opening() const { return distance_ / specimen_.spec().length; }
  int iterations() const { return specimen_.iterations(); }

 private:
  double distance() const {
    return specimen_.spec().length + specimen_.moving().shift.dot(specimen_.along());
  }

  Specimen specimen_;
  double distance_ = 0.0;                       // between the clamps [m]
  double shift_ = 0.0, committed_shift_ = 0.0;  // [m]
};

/// The specimen and one of twice its width, sheared alike. At the free edges the shear stress runs out; both
/// lose the same there, so that the difference of the forces belongs to cloth without edges. (With one of
/// half the width the edges of a stiff fabric are too near to each other: 2HG5 of a denim came out 4 % off.)
class ShearPair {
 public:
  ShearPair(const FabricLaws& laws, const SpecimenSpec& spec)
      : specimen_(laws, spec), wide_(laws, twice_as_wide(spec)) {}

  void put_tension_on(double per_width) {
    specimen_.put_tension_on(per_width);
    wide_.put_tension_on(per_width);
  }
  bool move(double angle, double tolerance, CurveSample& sample) {
    if (!specimen_.try_angle(angle, tolerance) || !wide_.try_angle(angle, tolerance)) {
      specimen_.roll_back();
      wide_.roll_back();
      return false;
    }
    specimen_.commit();
    wide_.commit();
    sample = {specimen_.reached(), force()};
    return true;
  }
  /// Per width, without the edges [N/m].
  double force() const { return (wide_.force() - specimen_.force()) / (wide_.width() - specimen_.width()); }
  /// By how much the specimen reads less than that.
  double edge_share() const { return 1.0 - specimen_.force() / specimen_.width() / force(); }
  double opening() const { return wide_.opening(); }
  int iterations() const { return specimen_.iterations() + wide_.iterations(); }

 private:
  static SpecimenSpec twice_as_wide(SpecimenSpec spec) {
    spec.width *= 2.0;
    return spec;
  }
  ShearTester specimen_, wide_;
};

}  // namespace

KesRecord run_kes_shear(const FabricLaws& laws, const KesOptions& options, const Progress& progress) {
  SpecimenSpec spec;
  spec.along = options.direction;
  spec.length = kLength;
  spec.width = options.width;
  spec.spacing = options.spacing > 0.0 ? options.spacing : kSpacing;
  const double high = options.high > 0.0 ? options.high : kes_shear_range();
  const double low = options.high > 0.0 ? options.low : -kes_shear_range();
  if (!(low <= 0.0) || !(std::max(high, -low) < kSteepest))
    throw Error(ErrorKind::kUsage, "a shear test goes from 0 to an angle of less than 60 degrees either way");
  if (!(options.tension > 0.0))
    throw Error(ErrorKind::kUsage, "a shear test needs a tension: without it the cloth goes slack", {},
                "take the 10 gf/cm of KES-FB1");
  ShearPair tester(laws, spec);
  tester.put_tension_on(options.tension);
  const KesMove move = [&](double angle, CurveSample& sample) {
    if (!tester.move(angle, kAngleTolerance * kStep, sample)) return false;
    if (options.stress)
      sample.stress = (sample.stress - options.tension * std::tan(sample.strain)) * tester.opening();
    return true;
  };
  const std::array<double, 3> stops{high, low, 0.0};
  if (options.conditioned) {
    KesRecorder unrecorded(CurveSample{});
    drive(stops, kStep, move, unrecorded);
  }
  KesRecord record;
  double farthest = 0.0;
  const KesMove watched = [&](double angle, CurveSample& sample) {
    if (!move(angle, sample)) return false;
    if (sample.strain > farthest) {
      farthest = sample.strain;
      record.edge_share = tester.edge_share();
    }
    return true;
  };
  CurveSample start;
  move_in_parts(0.0, 0.0, move, start);
  start.strain = 0.0;
  KesRecorder recorder(start);
  drive(turning_points(options.reversals, stops), kStep, watched, recorder, progress);
  record.curve = recorder.take(Test::kShear, options.direction);
  record.stretch = tester.opening();
  record.spacing = spec.spacing;
  record.iterations = tester.iterations();
  return record;
}

}  // namespace fuai
